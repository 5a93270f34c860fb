"""Figures of the library as figures of matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _core
from ._optional import optional

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PX_PER_INCH = 100


def pyplot() -> Any:
    """matplotlib.pyplot; says what to install if it is missing."""
    return optional("matplotlib.pyplot", "plot")


def _colour(rgb: tuple[int, int, int]) -> tuple[float, float, float]:
    return (rgb[0] / 255, rgb[1] / 255, rgb[2] / 255)


def _points(pixels: float) -> float:
    """Width or height of a mark in points of a font."""
    return 72 * pixels / PX_PER_INCH


def _line_style(stroke: dict[str, Any]) -> Any:
    dashes = [_points(float(part)) for part in stroke["dash"].split()]
    return (0, dashes) if dashes else "-"


def _draw_line(axes: Axes, line: dict[str, Any]) -> None:
    points, width = line["points"], _points(line["width_px"])
    if line["colours"] is None:
        # Dashes are in multiples of the width there.
        style = _line_style(line)
        if style != "-":
            style = (0, [part / width for part in style[1]])
        axes.plot(points[:, 0], points[:, 1], color=_colour(line["colour"]), linewidth=width,
                  alpha=line["opacity"], linestyle=style)
        return
    from matplotlib.collections import LineCollection

    parts = [points[i:i + 2] for i in range(len(points) - 1)]
    axes.add_collection(
        LineCollection(parts, colors=line["colours"][:-1] / 255.0, linewidths=width))


def _draw_area(axes: Axes, area: dict[str, Any]) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    rings = [ring for ring in area["rings"] if len(ring) > 2]
    if rings:
        path = Path.make_compound_path(*(Path(ring, closed=False) for ring in rings))
        axes.add_patch(PathPatch(path, facecolor=_colour(area["fill"]), edgecolor="none",
                                 alpha=area["opacity"]))


def _draw(axes: Axes, shape: dict[str, Any]) -> None:
    kind = shape["kind"]
    if kind == "line":
        _draw_line(axes, shape)
    elif kind == "area":
        _draw_area(axes, shape)
    elif kind == "text":
        x, y = shape["at"]
        axes.text(x, y, shape["text"], ha="center", va="center", fontsize=9)
    else:
        axes.plot(shape["points"][:, 0], shape["points"][:, 1], "o", linestyle="none",
                  markersize=_points(2 * shape["radius_px"]),
                  markerfacecolor=_colour(shape["fill"]), markeredgecolor=_colour(shape["edge"]))


def _set_axis(axes: Axes, which: str, axis: dict[str, Any]) -> None:
    low, high = axis["range"]
    if axis["categories"]:
        low, high = high, low  # counted from the top
        axes.set_yticks(range(len(axis["categories"])), axis["categories"])
    if axis["logarithmic"]:
        from matplotlib.ticker import FuncFormatter

        getattr(axes, f"{which}axis").set_major_formatter(
            FuncFormatter(lambda value, _: f"{10 ** value:.3g}"))
    getattr(axes, f"set_{which}label")(axis["label"])
    getattr(axes, f"set_{which}lim")(low, high)


def _add_scale(figure: Figure, axes: Axes, scale: dict[str, Any]) -> None:
    """A bar of the colours at the right of the axes."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import ListedColormap, Normalize

    colours = ListedColormap(_core.scale_colours(256) / 255.0)
    values = ScalarMappable(Normalize(*scale["range"]), colours)
    box, inch = axes.get_position(), figure.get_figwidth()
    bar = figure.add_axes((box.x1 + 0.12 / inch, box.y0, 0.14 / inch, box.height),
                          label="<colorbar>")
    figure.colorbar(values, cax=bar, label=scale["label"])


def _handle(entry: dict[str, Any]) -> Any:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    colour, width = _colour(entry["colour"]), _points(entry["width_px"])
    if entry["mark"] == "area":
        return Patch(facecolor=colour, label=entry["text"])
    if entry["mark"] in ("ring", "disc"):
        face = colour if entry["mark"] == "disc" else "white"
        return Line2D([], [], linestyle="none", marker="o", markersize=2 * width,
                      markerfacecolor=face, markeredgecolor=colour, label=entry["text"])
    return Line2D([], [], color=colour, linewidth=width, label=entry["text"],
                  linestyle="--" if entry["dash"] else "-")


def draw(figure: _core.Figure) -> Figure:
    """A figure of matplotlib with the panels of a figure of the library."""
    plot = pyplot()
    width, height = figure.size_px
    above = 90 + 20 * len(figure.notes) + 12 * len(figure.legend)
    result: Figure = plot.figure(figsize=(width / PX_PER_INCH, (height + above) / PX_PER_INCH),
                                 dpi=PX_PER_INCH)
    total = height + above
    for panel in figure.panels:
        (left, top), (wide, high) = panel["corner_px"], panel["size_px"]
        axes = result.add_axes((left / width, 1 - (above + top + high) / total, wide / width,
                                high / total))
        for shape in panel["shapes"]:
            _draw(axes, shape)
        _set_axis(axes, "x", panel["x"])
        _set_axis(axes, "y", panel["y"])
        axes.set_title(panel["heading"])
        axes.grid(True, color="0.9")
        axes.set_axisbelow(True)
        if panel["scale"]:
            _add_scale(result, axes, panel["scale"])
    result.text(0.02, 1 - 24 / total, figure.title, fontsize=13)
    for i, note in enumerate(figure.notes):
        result.text(0.02, 1 - (44 + 20 * i) / total, note, fontsize=10, color="0.4")
    if figure.legend:
        result.legend(handles=[_handle(entry) for entry in figure.legend], loc="upper left",
                      bbox_to_anchor=(0.01, 1 - (30 + 20 * len(figure.notes)) / total), ncols=2,
                      frameon=False)
    return result
