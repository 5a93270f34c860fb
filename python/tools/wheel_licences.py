"""wheel_licences.py WHEEL: states in a wheel with bundled libraries under which licences it is.

Each library below placegraph.libs comes from a package of Debian, whose file `copyright` is added to
the licence files of the wheel. SuiteSparse's SPQR and parts of CHOLMOD are under the GPL: the wheel
as a whole is then, too, whatever the package itself calls of them.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile

EXPRESSION = "BSD-3-Clause AND GPL-2.0-or-later AND LGPL-2.1-or-later AND Apache-2.0"
WHOLE = """The package placegraph is under the BSD 3-Clause licence. This wheel holds the libraries that
it links, as Debian 12 packages them, each under its own licence (the files beside this one). Among
them are SPQR and CHOLMOD of SuiteSparse, which are partly under the GNU General Public License,
version 2 or later: the wheel as a whole may be distributed under its terms (version 3 together with
what is under the Apache License). A package without them is built from source:

    pip install . --config-settings=cmake.define.PLACEGRAPH_GPL=OFF

uses a SuiteSparse of the system instead of one inside.

"""
# Made by scripts/wheel, see there.
OWN = ("libGLX",)


def debian_package(library: str) -> str:
    """The package that has a library of this name, such as libpng16-78a1c2d3.so.16.39.0."""
    name = re.sub(r"-[0-9a-f]{8}(?=\.)", "", library)
    folder = pathlib.Path("/usr/lib", sysconfig.get_config_var("MULTIARCH"))
    # Behind links such as liblapack.so.3 stand several packages, of which the system uses one.
    file = (folder / name).resolve()
    pattern = f"*/{file.parent.name}/{file.name}" if file.exists() else f"*/{name}"
    found = subprocess.run(["dpkg-query", "-S", pattern], capture_output=True, text=True)
    if found.returncode != 0:
        sys.exit(f"wheel_licences: no package has {name}")
    return re.split(r"[:,]", found.stdout, maxsplit=1)[0]


def add_licences(folder: pathlib.Path) -> None:
    """Adds the licences of the libraries to an unpacked wheel."""
    (information,) = folder.glob("*.dist-info")
    licences = information / "licenses" / "libraries"
    licences.mkdir(parents=True)
    text = WHOLE
    names = []
    for library in sorted(path.name for path in folder.glob("*.libs/*")):
        if library.startswith(OWN):
            continue
        package = debian_package(library)
        text += f"{library}: {package}\n"
        if package not in names:
            names.append(package)
            shutil.copy(f"/usr/share/doc/{package}/copyright", licences / f"{package}.txt")
    (licences / "README.txt").write_text(text, encoding="utf-8")
    metadata = information / "METADATA"
    stated = metadata.read_text(encoding="utf-8")
    files = "".join(f"License-File: libraries/{name}.txt\n" for name in ["README", *names])
    changed = re.sub(r"^License-Expression: .*\n", f"License-Expression: {EXPRESSION}\n{files}", stated,
                     count=1, flags=re.MULTILINE)
    if changed == stated:
        sys.exit("wheel_licences: the wheel states no licence")
    metadata.write_text(changed, encoding="utf-8")


def main() -> None:
    wheel = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as work:
        subprocess.run([sys.executable, "-m", "wheel", "unpack", str(wheel), "-d", work], check=True)
        (folder,) = pathlib.Path(work).iterdir()
        add_licences(folder)
        wheel.unlink()
        subprocess.run(
            [sys.executable, "-m", "wheel", "pack", str(folder), "-d", str(wheel.parent)], check=True)


if __name__ == "__main__":
    main()
