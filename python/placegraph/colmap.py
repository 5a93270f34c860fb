"""Maps as reconstructions of COLMAP's package pycolmap, and back."""

from __future__ import annotations

import os
import tempfile
from typing import Any

from . import _core
from ._optional import optional
from ._types import Path
from .maps import Map, core_of


def to_pycolmap(map: Map, *, component: int | None = None) -> Any:
    """The pycolmap.Reconstruction of a component after a bundle adjustment.

    `component`: its number, None: the main one. It is the model of `placegraph map export
    --colmap`: ids of images and points are those of keyframes and landmarks plus one, names are
    paths within the recording, whose images must still be at `map.sequence`. FileError if they are
    not.
    """
    core_of(map)  # checks the argument
    package = optional("pycolmap", "colmap")
    with tempfile.TemporaryDirectory(prefix="placegraph-") as folder:
        map.export(colmap=folder, component=component)
        return package.Reconstruction(folder)


def from_pycolmap(
    reconstruction: Any, sequence: Path, *, metric: bool = False
) -> Map:
    """The map of a reconstruction by one pinhole camera of images of a sequence.

    `sequence`: a recording that `open_dataset` opens, in which the names of the images are paths or
    names of files; `metric`: lengths of the reconstruction are metres. Every image becomes a
    keyframe, every other frame of the sequence is lost. ArgumentError if the sequence lacks an
    image; FileError for another model of cameras.
    """
    if not callable(getattr(reconstruction, "write_binary", None)):
        raise _core.ArgumentError("reconstruction: a pycolmap.Reconstruction is needed, not "
                                  f"{type(reconstruction).__name__}")
    with tempfile.TemporaryDirectory(prefix="placegraph-") as folder:
        reconstruction.write_binary(folder)
        return Map(_core.Map.from_colmap(folder, os.fspath(sequence), metric))
