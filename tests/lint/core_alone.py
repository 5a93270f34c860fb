"""core_alone.py ROOT: the core includes nothing of the library placegraph::elements.

The sources of that library are those that the layers' CMakeLists.txt name in placegraph_elements(...); a header
belongs to it when its source does. All other sources and headers of the layers below apps are the core's, but for
headers that only sources of the elements include. Prints file:line for each include of the core that reaches a
header of the elements, and for each source that placegraph_elements() names and that does not exist, and fails if
there is one.
"""
import os
import re
import sys

from source_includes import LAYERS, includes_of, layer_of, source_files

CALL = re.compile(r"placegraph_elements\(([^)]*)\)")


def element_sources(root):
    """The sources that the layers name, and what is wrong with the lists."""
    sources, faults = set(), []
    for layer in LAYERS[:-1]:
        lists = os.path.join(layer, "CMakeLists.txt")
        with open(os.path.join(root, lists), encoding="utf-8") as text:
            content = text.read()
        for call in CALL.finditer(content):
            for name in call.group(1).split():
                source = f"{layer}/{name}"
                if not os.path.isfile(os.path.join(root, source)):
                    faults.append(f"{lists}:{content.count(chr(10), 0, call.start()) + 1}: no source {source}")
                sources.add(source)
    return sources, faults


def check(root):
    sources, faults = element_sources(root)
    headers = {source[:-len(".cpp")] + ".h" for source in sources}
    files = [file for file in source_files(root) if layer_of(file) != "apps"]
    includes = {file: [i for i in includes_of(root, file) if i.target] for file in files}
    waiting = [file for file in files if file.endswith(".cpp") and file not in sources]
    core = set(waiting)
    while waiting:
        for include in includes[waiting.pop()]:
            if include.target in headers:
                faults.append(f"{include.file}:{include.line}: {include.target} belongs to placegraph::elements, "
                              "which the core does not know")
            elif include.target in includes and include.target not in core:
                core.add(include.target)
                waiting.append(include.target)
    return sorted(faults), len(core), len(sources)


if __name__ == "__main__":
    found, kept, apart = check(sys.argv[1])
    print("\n".join(found) or f"core_alone: {kept} files of the core include none of {apart} sources apart")
    sys.exit(1 if found else 0)
