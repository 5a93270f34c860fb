"""public_headers.py ROOT: what is installed is what may be used, and no more than can be read.

A header of a layer is public, and installed, unless it lies below the layer's folder `internal`.
Prints one line for each violation, as file:line where there is one, and fails if there is one:
  a public folder holds a source, which belongs below `internal`,
  a public header includes one that is not installed,
  a public header includes one of another project but Eigen, and graph/image/image.h OpenCV's cv::Mat,
  a public header opens the namespace without its visibility, so that a shared library would hide it,
  more than 280 public headers; more than 40 behind pipeline/slam.h.
"""
import os
import re
import sys

from source_includes import includes_of, layer_of, source_files

MOST_HEADERS, MOST_BEHIND_SLAM = 280, 40
SLAM = "pipeline/slam.h"
FOREIGN = re.compile(r"[a-z_]+$|Eigen/")  # the standard library's and Eigen's
OPENCV = ("graph/image/image.h", "opencv2/core/mat.hpp")
HIDDEN = re.compile(r"^namespace placegraph\b")


def is_public(path):
    return path.endswith(".h") and "internal" not in path.split("/") and layer_of(path) != "apps"


def faults_of(root, header):
    found = [f"{header}:{include.line}: includes {include.target}, which is not installed"
             for include in includes_of(root, header)
             if include.target and not is_public(include.target)]
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


def check(root):
    files = [file for file in source_files(root) if layer_of(file) != "apps"]
    found = [f"{file}: a source among public headers, below internal is its place"
             for file in files if file.endswith(".cpp") and "internal" not in file.split("/")]
    headers = [file for file in files if is_public(file)]
    for header in headers:
        found += faults_of(root, header)
    if len(headers) > MOST_HEADERS:
        found.append(f"{len(headers)} public headers, {MOST_HEADERS} are allowed")
    if SLAM in headers and len(behind(root, SLAM)) > MOST_BEHIND_SLAM:
        found.append(f"{SLAM}: {len(behind(root, SLAM))} headers behind it, "
                     f"{MOST_BEHIND_SLAM} are allowed")
    return found, len(headers)


if __name__ == "__main__":
    faults, count = check(sys.argv[1])
    print("\n".join(faults) or f"public_headers: {count} headers, all fit to be installed")
    sys.exit(1 if faults else 0)
