"""The folders of the sources as a graph: an arrow leads from a folder to one that it includes."""
import collections

from include_table import read_table
from source_includes import ALL_DOORS, folder_of, layer_of, project_includes, source_files


class FolderGraph:
    """Folders in the order of the table, bottom up; arrows[a] are the folders that a includes."""

    def __init__(self, root):
        files = source_files(root)
        self.files = collections.Counter(folder_of(file) for file in files)
        table = read_table(root)
        known = [folder for folder in table.line_of if folder in self.files]
        self.folders = known + sorted(set(self.files) - set(known))
        self.layers = list(dict.fromkeys(layer_of(folder) for folder in self.folders))
        self.rank = {folder: place for place, folder in enumerate(self.folders)}
        self.arrows = {folder: set() for folder in self.folders}
        self.pairs = collections.defaultdict(lambda: collections.defaultdict(set))
        for include in project_includes(root, [file for file in files if file != ALL_DOORS]):
            here, there = folder_of(include.file), folder_of(include.target)
            if here == there:
                self.pairs[here][pair_of(include.file)].add(pair_of(include.target))
            elif there in self.arrows:
                self.arrows[here].add(there)

    def inside(self, layer):
        return [folder for folder in self.folders if layer_of(folder) == layer]

    def upward(self):
        return [(a, b) for a in self.folders for b in sorted(self.arrows[a])
                if self.rank[b] > self.rank[a]]


def pair_of(file):
    """A header and its source file count as one."""
    return file.rsplit(".", 1)[0]


def reachable(arrows, start):
    seen, todo = set(), list(arrows.get(start, ()))
    while todo:
        node = todo.pop()
        if node not in seen:
            seen.add(node)
            todo += arrows.get(node, ())
    return seen


def circles(arrows):
    """The largest sets of nodes that reach each other, each sorted, of more than one node."""
    reach = {node: reachable(arrows, node) for node in arrows}
    found = set()
    for node in arrows:
        circle = {other for other in reach[node] if node in reach.get(other, ())} | {node}
        if len(circle) > 1:
            found.add(tuple(sorted(circle)))
    return sorted(found)


def reduced(arrows):
    """The arrows (a, b) that do not follow from a longer way from a to b."""
    return [(a, b) for a in arrows for b in sorted(arrows[a])
            if not any(b in reachable(arrows, c) for c in arrows[a] if c != b)]


def figures(graph):
    """The lines that scripts/draw_folders prints."""
    largest = max(graph.folders, key=lambda folder: graph.files[folder])
    count = sum(len(there) for there in graph.arrows.values())
    lines = [f"folders: {len(graph.folders)}",
             f"files: {sum(graph.files.values())}",
             f"largest folder: {largest}, {graph.files[largest]} files",
             f"arrows: {count}"]
    for layer in graph.layers:
        arrows = [(a, b) for a in graph.inside(layer) for b in graph.arrows[a]]
        within = sum(layer_of(b) == layer for _, b in arrows)
        lines.append(f"  {layer}: {len(graph.inside(layer))} folders, {within} arrows inside, "
                     f"{len(arrows) - within} to other layers")
    upward = graph.upward()
    between = circles(graph.arrows)
    inside = [circle for folder in graph.folders for circle in circles(graph.pairs[folder])]
    lines.append(f"arrows upward: {len(upward)}")
    lines += [f"  {a} -> {b}" for a, b in upward]
    lines.append(f"circles between folders: {len(between)}")
    lines += ["  " + ", ".join(circle) for circle in between]
    lines.append(f"circles inside folders (pairs of .h and .cpp): {len(inside)}")
    lines += ["  " + ", ".join(circle) for circle in inside]
    return lines
