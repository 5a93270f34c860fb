"""option_types.py OUTPUT: writes the stub of a class for each kind of options of the built module.

An option is an attribute of its type, a group a property of a class of its own; the docstring of
each is its meaning, with the range.
"""

import math
import pathlib
import sys
import textwrap

from placegraph import _core

TYPES = {"bool": "bool", "int": "int", "uint": "int", "double": "float", "string": "str",
         "list": "list[float]"}
HEAD = '''"""The options of each kind with their types. Made of the library's options by a build."""

from typing import Literal

from ._option_group import OptionGroup, Options
'''


def class_name(kind: str, group: str) -> str:
    """RunOptions, and RunOptions_odometry_window of its group odometry.window."""
    return "_".join([kind, *group.split(".")]) if group else kind


def documented(text: str) -> str:
    """A docstring in a class, in lines of at most 100 characters."""
    text = text.replace("\\", "\\\\").replace('"""', "'''")
    text = text[:1].upper() + text[1:] + ("" if text.endswith(".") else ".")
    return textwrap.fill(f'"""{text}"""', 96, initial_indent="    ", subsequent_indent="    ",
                         break_long_words=False, break_on_hyphens=False)


def attribute(kind: str, entry: _core.OptionEntry) -> str:
    """The declaration of an option or a group of options."""
    name = entry.path.rpartition(".")[2]
    if entry.type == "group":
        declared = textwrap.indent(documented(entry.doc), "    ")
        return (f"    @property\n    def {name}(self) -> {class_name(kind, entry.path)}:\n"
                f"{declared}\n")
    low, high = entry.range
    text = entry.doc
    if not (math.isinf(low) and math.isinf(high)):
        text += f"; in [{low:g}, {high:g}]"
    if entry.type == "choice":
        names = ", ".join(repr(choice) for choice in entry.choices)
        declared = textwrap.fill(f"{name}: Literal[{names}]", 96, initial_indent="    ",
                                 subsequent_indent="        ", break_on_hyphens=False)
        return f"{declared}\n{documented(text)}\n"
    return f"    {name}: {TYPES[entry.type]}\n{documented(text)}\n"


def classes_of(kind: str, entries: list[_core.OptionEntry]) -> str:
    """The class of a kind of options, after those of its groups."""
    groups: dict[str, tuple[str, list[str]]] = {"": ("Every option of one kind", [])}
    for entry in entries:
        if entry.type == "group":
            groups[entry.path] = entry.doc, []
        groups[entry.path.rpartition(".")[0]][1].append(attribute(kind, entry))
    text = ""
    for path, (doc, attributes) in groups.items():
        base = "OptionGroup" if path else "Options"
        text += f"\nclass {class_name(kind, path)}({base}):\n{documented(doc)}\n"
        text += "".join(attributes)
    return text


def stub() -> str:
    """The whole stub."""
    kinds = {name.removesuffix("Set") + "s": kind for name, kind in vars(_core).items()
             if isinstance(kind, type) and issubclass(kind, _core.OptionSet)}
    del kinds["Options"]
    return HEAD + "".join(classes_of(name, kind().entries())
                          for name, kind in sorted(kinds.items()))


if __name__ == "__main__":
    pathlib.Path(sys.argv[1]).write_text(stub(), encoding="utf-8")
