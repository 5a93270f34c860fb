"""Reads tests/lint/include_directions.txt and proves that no arrow of it points up.

    # comment
    [layer: layers it may include]
    folder: folders it may include
        more folders, on an indented line

A folder may include only folders of earlier lines, so that circles are impossible, and of another
layer only if the heading of its own layer names that layer.
"""
import os
import re

from source_includes import layer_of

TABLE = "tests/lint/include_directions.txt"
HEADING = re.compile(r"\[([^:\]]+)(?::([^\]]*))?\]$")


class Table:
    def __init__(self):
        self.layers = {}       # layer -> the layers that it may include
        self.allowed = {}      # folder -> {folder it may include: line of the table}
        self.line_of = {}      # folder -> line of the table
        self.complaints = []   # (line, text)

    def complain(self, line, text):
        self.complaints.append((line, text))

    def permits(self, here, there):
        return here == there or there in self.allowed.get(here, {})


def add_heading(table, number, layer, below):
    for name in below:
        if name not in table.layers:
            table.complain(number, f"layer {layer}: layer {name} is not above this line")
    if layer in table.layers:
        table.complain(number, f"layer {layer} stands here a second time")
    table.layers[layer] = set(below)


def add_permission(table, number, layer, folder, there):
    if there in table.allowed[folder]:
        table.complain(number, f"{folder}: {there} stands here a second time")
    elif there == folder or there not in table.line_of:
        table.complain(number, f"{folder}: {there} has no earlier line: the arrow points up")
    elif layer_of(there) != layer and layer_of(there) not in table.layers.get(layer, ()):
        table.complain(number, f"{folder}: layer {layer} may not include layer {layer_of(there)}")
    table.allowed[folder][there] = number


def read_table(root):
    """The table below `root`; its own faults are in Table.complaints."""
    table = Table()
    layer = folder = None
    with open(os.path.join(root, TABLE), encoding="utf-8") as source:
        lines = source.read().split("\n")
    for number, line in enumerate(lines, 1):
        text = line.split("#", 1)[0].rstrip()
        if not text:
            continue
        heading = HEADING.match(text)
        if heading:
            layer, folder = heading.group(1).strip(), None
            add_heading(table, number, layer, (heading.group(2) or "").split())
            continue
        permissions = text
        if not text[0].isspace():
            folder, colon, permissions = text.partition(":")
            if not colon or layer is None or layer_of(folder) != layer:
                table.complain(number, f"'{text}': not a folder of the layer of this heading")
                folder = None
                continue
            if folder in table.line_of:
                table.complain(number, f"{folder} stands here a second time")
            table.allowed.setdefault(folder, {})
        for there in permissions.split() if folder else ():
            add_permission(table, number, layer, folder, there)
        if folder:
            table.line_of.setdefault(folder, number)
    return table
