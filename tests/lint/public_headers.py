"""public_headers.py ROOT: what is installed is what may be used, and no more than can be read.

The public headers are those of the list cmake/public_headers.txt, by which CMake installs them.
Prints one line for each violation, as file:line where there is one, and fails if there is one:
  the list is not sorted, or names what is no header of a library,
  a public header includes one that is not installed,
  a public header includes one of another project but Eigen, and graph/image/image.h OpenCV's cv::Mat,
  a public header opens the namespace without its visibility, so that a shared library would hide it,
  the command line (apps) or the Python module (python/src) includes a header of a library that is not public,
  more than 315 public headers; more than 40 behind pipeline/slam.h, or 95 behind pipeline/placegraph.h.
"""
import os
import re
import sys

from source_includes import includes_of, layer_of

LIST = "cmake/public_headers.txt"
MOST_HEADERS = 315  # the header of all doors is installed besides
MOST_BEHIND = {"pipeline/slam.h": 40, "pipeline/placegraph.h": 95}
USERS = ("apps", "python/src")
FOREIGN = re.compile(r"[a-z_]+$|Eigen/")  # the standard library's and Eigen's
OPENCV = ("graph/image/image.h", "opencv2/core/mat.hpp")
HIDDEN = re.compile(r"^namespace placegraph\b")


def public_headers(root):
    """The list, one header a line."""
    with open(os.path.join(root, LIST), encoding="utf-8") as lines:
        return lines.read().split("\n")[:-1]


def faults_of(root, header, public):
    found = [f"{header}:{include.line}: includes {include.target}, which is not installed"
             for include in includes_of(root, header)
             if include.target and include.target not in public]
    found += [f"{header}:{include.line}: {include.text} is no business of who includes this"
              for include in includes_of(root, header)
              if not include.target and not FOREIGN.match(include.text)
              and (header, include.text) != OPENCV]
    with open(os.path.join(root, header), encoding="utf-8") as source:
        found += [f"{header}:{number}: hidden by a shared library: "
                  'open with namespace [[gnu::visibility("default")]] placegraph'
                  for number, line in enumerate(source, 1) if HIDDEN.match(line)]
    return found


def behind(root, header):
    """The project's headers that `header` includes, one by one or through others."""
    seen, waiting = set(), [header]
    while waiting:
        for include in includes_of(root, waiting.pop()):
            target = include.target
            if target and target not in seen and os.path.exists(os.path.join(root, target)):
                seen.add(target)
                waiting.append(target)
    return seen


def sources_of_users(root):
    """The sources of the command line and of the Python module."""
    return sorted(os.path.relpath(os.path.join(folder, name), root)
                  for top in USERS for folder, _, names in os.walk(os.path.join(root, top))
                  for name in names if name.endswith((".h", ".cpp")))


def faults_of_users(root, public):
    return [f"{user}:{include.line}: includes {include.target}, which is not public"
            for user in sources_of_users(root) for include in includes_of(root, user)
            if include.target and layer_of(include.target) != "apps" and include.target not in public]


def check(root):
    headers = public_headers(root)
    found = [f"{LIST}:{number}: {header} stands behind {before}"
             for number, (before, header) in enumerate(zip(headers, headers[1:]), 2) if before >= header]
    for number, header in enumerate(headers, 1):
        if not header.endswith(".h") or layer_of(header) == "apps" or not os.path.isfile(os.path.join(root, header)):
            found.append(f"{LIST}:{number}: {header} is no header of a library")
        else:
            found += faults_of(root, header, set(headers))
    found += faults_of_users(root, set(headers))
    if len(headers) > MOST_HEADERS:
        found.append(f"{len(headers)} public headers, {MOST_HEADERS} are allowed")
    for header, most in MOST_BEHIND.items():
        count = len(behind(root, header)) if os.path.exists(os.path.join(root, header)) else 0
        if count > most:
            found.append(f"{header}: {count} headers behind it, {most} are allowed")
    return found, len(headers)


if __name__ == "__main__":
    faults, count = check(sys.argv[1])
    print("\n".join(faults) or f"public_headers: {count} headers, all fit to be installed")
    sys.exit(1 if faults else 0)
