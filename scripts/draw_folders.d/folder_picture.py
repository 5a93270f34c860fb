"""Draws a FolderGraph as SVG: one panel a layer, one box a folder, arrows down.

The picture has no counts of files, so that it changes only when folders or their arrows do.
"""
from folder_graph import reduced
from row_layout import chain, lay_out
from source_includes import layer_of

WIDTH = 1280
MARGIN = 20
BAND_GAP = 40          # between bands of layers
PAD, TITLE = 14, 18    # inside a panel
BOX, ROW_GAP = 26, 34  # height of a box, and between rows
# The layers from the top; those of one band never include each other.
BANDS = (("apps",), ("pipeline",), ("frontend", "backend", "io", "eval"), ("graph",))
SHARES = {"frontend": 456, "backend": 300, "io": 328, "eval": 120}
FILL = {"apps": "#eceff4", "pipeline": "#e3eef9", "frontend": "#e5f3e6", "backend": "#fbeee0",
        "io": "#f3e9f5", "eval": "#f8e6e6", "graph": "#fbf6d8"}
STYLE = """<style>
text { font-family: "DejaVu Sans", Verdana, sans-serif; fill: #1f2933; text-anchor: middle; }
.title { font-size: 14px; font-weight: bold; text-anchor: start; }
.name { font-size: 12px; }
.note { font-size: 12px; text-anchor: start; fill: #3e4c59; }
.box { fill: #ffffff; stroke: #52606d; }
.arrow { fill: none; stroke: #52606d; stroke-width: 1.2; }
.layer { fill: none; stroke: #9aa5b1; stroke-width: 5; }
.upward { fill: none; stroke: #d62728; stroke-width: 2; }
</style>
<defs>
<marker id="head" markerWidth="8" markerHeight="8" refX="7" refY="4" orient="auto"
markerUnits="userSpaceOnUse">
<path d="M0,0.5 L8,4 L0,7.5 z" fill="#52606d"/></marker>
<marker id="wide" markerWidth="16" markerHeight="16" refX="12" refY="8" orient="auto"
markerUnits="userSpaceOnUse">
<path d="M0,1 L14,8 L0,15 z" fill="#9aa5b1"/></marker>
</defs>"""


def short(folder):
    return folder.split("/", 1)[1] if "/" in folder else folder + "/"


class Panel:
    """One layer: its boxes, and the rectangle around them once `place` has been called."""

    def __init__(self, graph, layer, width):
        self.graph, self.layer, self.width = graph, layer, width
        self.folders = graph.inside(layer)
        down = {a: {b for b in graph.arrows[a]
                    if layer_of(b) == layer and graph.rank[b] < graph.rank[a]}
                for a in self.folders}
        sizes = {f: max(74, 7 * len(short(f)) + 16) for f in self.folders}
        self.sizes = sizes
        self.layout, self.row_of = lay_out(self.folders, reduced(down), sizes, width - 2 * PAD)
        self.height = (TITLE + 2 * PAD + len(self.layout.rows) * BOX
                       + (len(self.layout.rows) - 1) * ROW_GAP)

    def place(self, x, y, height):
        self.x, self.y, self.height = x, y, height

    def centre(self, item):
        return self.x + PAD + self.layout.centre[item]

    def top(self, row):
        return self.y + self.height - PAD - BOX - row * (BOX + ROW_GAP)

    def ports(self, at_top):
        """Where each edge meets its box, in the order of the other ends."""
        ends = {}
        for folder in self.folders:
            edges = [e for e in self.layout.edges if e[1 if at_top else 0] == folder]

            def other_end(edge):
                items = chain(edge, self.row_of)
                return self.centre(items[-2 if at_top else 1])

            edges.sort(key=lambda edge: (other_end(edge), edge))
            for i, edge in enumerate(edges):
                step = min(14, (self.sizes[folder] - 16) // max(1, len(edges)))
                ends[edge] = self.centre(folder) + step * (2 * i - len(edges) + 1) // 2
        return ends

    def edge_path(self, edge, start, end):
        a, b = edge
        x, y = start, self.top(self.row_of[a]) + BOX
        path = [f"M{x},{y}"]
        for item in chain(edge, self.row_of)[1:]:
            last = item == b
            row = self.row_of[b] if last else item[2]
            to, low = (end if last else self.centre(item)), self.top(row)
            middle = (y + low) // 2
            path.append(f"C{x},{middle} {to},{middle} {to},{low}")
            x, y = to, low + BOX
            if not last:
                path.append(f"L{x},{y}")
        return " ".join(path)

    def draw(self):
        out = [f'<rect x="{self.x}" y="{self.y}" width="{self.width}" height="{self.height}" '
               f'rx="8" fill="{FILL.get(self.layer, "#eeeeee")}"/>',
               f'<text class="title" x="{self.x + 10}" y="{self.y + 20}">{self.layer}</text>']
        starts, ends = self.ports(False), self.ports(True)
        for edge in self.layout.edges:
            path = self.edge_path(edge, starts[edge], ends[edge])
            out.append(f'<path class="arrow" marker-end="url(#head)" d="{path}"/>')
        for folder in self.folders:
            x, y, size = self.centre(folder), self.top(self.row_of[folder]), self.sizes[folder]
            out += [f'<rect class="box" x="{x - size // 2}" y="{y}" width="{size}" height="{BOX}" '
                    f'rx="4"/>',
                    f'<text class="name" x="{x}" y="{y + 17}">{short(folder)}</text>']
        return out


def place_bands(graph, top):
    """The panels by layer, and the height of the picture."""
    panels, y = {}, top
    for band in BANDS:
        inside = [layer for layer in band if layer in graph.layers]
        spare = WIDTH - 2 * MARGIN - sum(SHARES.get(layer, 0) for layer in inside)
        gap = spare // (len(inside) - 1) if len(inside) > 1 else 0
        row = [Panel(graph, layer, SHARES[layer] if len(inside) > 1 else spare) for layer in inside]
        height, x = max((panel.height for panel in row), default=0), MARGIN
        for panel in row:
            panel.place(x, y, height)
            panels[panel.layer] = panel
            x += panel.width + gap
        y += height + BAND_GAP
    return panels, y - BAND_GAP + MARGIN


def layer_arrows(graph, panels):
    """One wide arrow for each pair of layers whose includes do not follow from those of others; it
    stands at the edge of its panel where it passes a band."""
    between = {layer: set() for layer in graph.layers}
    for a in graph.folders:
        between[layer_of(a)] |= {layer_of(b) for b in graph.arrows[a]} - {layer_of(a)}
    out = []
    for a, b in reduced(between):
        high, low = panels[a], panels[b]
        narrow = high if high.width < low.width else low
        passes = low.y - high.y - high.height > BAND_GAP
        x = narrow.x + (narrow.width - 12 if passes else narrow.width // 2)
        out.append(f'<path class="layer" marker-end="url(#wide)" '
                   f'd="M{x},{high.y + high.height} L{x},{low.y - 3}"/>')
    return out


def draw(graph):
    """The picture as the text of an SVG file."""
    panels, height = place_bands(graph, 62)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" '
           f'viewBox="0 0 {WIDTH} {height}">', STYLE,
           f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>',
           f'<text class="note" x="{MARGIN}" y="28">Folders and their includes: an arrow points '
           f'from a folder to a folder that it includes, a wide arrow from a layer to '
           f'a layer.</text>',
           f'<text class="note" x="{MARGIN}" y="48">Arrows that follow from others are left out. '
           f'Drawn from the sources by scripts/draw_folders.</text>']
    for layer in graph.layers:
        out += panels[layer].draw()
    out += layer_arrows(graph, panels)
    for a, b in graph.upward():
        high, low = panels[layer_of(a)], panels[layer_of(b)]
        out.append(f'<path class="upward" d="M{high.centre(a)},{high.top(high.row_of[a])} '
                   f'L{low.centre(b)},{low.top(low.row_of[b]) + BOX}"/>')
    return "\n".join(out + ["</svg>"]) + "\n"
