"""random_streams.py ROOT: every random stream of a seed that an object keeps has the name of its step.

`Random random(seed_, "rotation", {frame})`: a name that no other place has, and the number of the item. Prints
file:line for each fault, and exits with 1 if there is one: docs/determinism.md says why.
"""
import pathlib
import re
import sys

FOLDERS = ("graph", "frontend", "backend", "pipeline")
STREAM = re.compile(r"\bRandom\s+\w+[({]\s*seed_\s*,\s*([^,]*),?")

root = pathlib.Path(sys.argv[1])
places, faults = {}, []
for path in sorted(file for folder in FOLDERS for file in (root / folder).rglob("*") if file.suffix in (".h", ".cpp")):
    text = path.read_text(encoding="utf-8")
    at = lambda match: f"{path.relative_to(root)}:{text.count(chr(10), 0, match.start()) + 1}"
    for match in STREAM.finditer(text):
        name = match.group(1).strip()
        if not name.startswith('"'):
            faults.append(f"{at(match)}: the stream has no name")
        elif places.setdefault(name, at(match)) != at(match):
            faults.append(f"{at(match)}: {places[name]} has the name {name}, too")
print("\n".join(faults) or f"random_streams: {len(places)} streams")
sys.exit(bool(faults))
