"""Adds many small frames to Slam in a Python loop, and tells whether references or memory grow.

    python python/bench/many_frames.py [--frames 10000]

A camera sways in a short stretch of a rendered corridor, so that the map grows slowly. The memory of
the map alone is measured at the end, by saving it and reading it again into this process.
"""

from __future__ import annotations

import argparse
import gc
import os
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import placegraph as pg


def resident_mb() -> float:
    """Memory of this process."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    return 0.0


def images_of(world: pg.synthetic.World) -> list[pg.Frame]:
    """There and back."""
    frames = list(world.frames(pg.Sensor.RGBD))
    return frames + frames[-2:0:-1]


def sway(world: pg.synthetic.World, images: list[pg.Frame], count: int) -> pg.Map:
    """One run; prints a line for each tenth of it."""
    options = pg.SlamOptions()
    options.loops.enabled = False
    slam = pg.Slam(world.calibration(pg.Sensor.RGBD), options)
    image, depth = np.empty((120, 160), np.uint8), np.empty((120, 160), np.float32)
    began = time.process_time()
    for i in range(count):
        frame = images[i % len(images)]
        np.copyto(image, frame.image)
        np.copyto(depth, np.asarray(frame.depth))
        result = slam.add_frame(image, i * 0.1, depth=depth)
        if (i + 1) % (count // 10) == 0:
            gc.collect()
            print(f"{i + 1:6d} frames, {resident_mb():7.1f} MB, {len(gc.get_objects()):6d} objects, "
                  f"{sys.getrefcount(image)} references of the image, {sys.getrefcount(result)} of "
                  f"the result, {1e3 * (time.process_time() - began) / (i + 1):.2f} ms CPU a frame",
                  flush=True)
    return slam.finish()


def saved(m: pg.Map) -> list[str]:
    """A file of the map, four times."""
    path = os.path.join(tempfile.mkdtemp(), "map.db")
    m.save(path)
    return [path] * 4


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--frames", type=int, default=10_000)
    given = parser.parse_args()
    world = pg.synthetic.World("corridor-loop", frames=30, size=(160, 120))
    m = sway(world, images_of(world), given.frames)
    before = resident_mb()
    copies = [pg.Map.open(path) for path in saved(m)]
    print(f"{m}: {len(m.tables.keyframes['id'])} keyframes; a map in memory takes "
          f"{(resident_mb() - before) / len(copies):.1f} MB")


if __name__ == "__main__":
    main()
