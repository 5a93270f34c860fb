"""What a notebook shows of an object: a table and a picture."""

from __future__ import annotations

from collections.abc import Sequence


def escaped(text: str) -> str:
    """Text as HTML, also between quotes."""
    import html  # its table of names takes longer than most of the package

    return html.escape(text)


def table_html(rows: Sequence[tuple[str, str]]) -> str:
    """Names and values."""
    cells = "".join(f"<tr><th style='text-align:left'>{escaped(name)}</th>"
                    f"<td style='text-align:left'>{escaped(value)}</td></tr>"
                    for name, value in rows)
    return f"<table>{cells}</table>"


def figure_html(rows: Sequence[tuple[str, str]], svg: str) -> str:
    """Names and values over a picture, which may be empty."""
    fitted = svg.replace("<svg ", "<svg style='max-width:100%;height:auto' ", 1)
    return f"<div>{table_html(rows)}{fitted}</div>"
