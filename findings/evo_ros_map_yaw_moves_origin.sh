#!/bin/sh
# evo 1.38.1 (PyPI), seen 2026-11-29.
#
# Input: a ROS map of 20 x 10 cells of 0.1 m. Its YAML file has `origin: [2.0, 0.0, 1.5707963...]`: the
# lower left corner of the picture is at x = 2 m, y = 0, and the map is turned by 90 degrees.
#
# Expected: evo draws the corner at (2, 0) and the end of the lower edge at (2, 2). map_server defines
# the origin as the 2-D pose of the lower left pixel (x, y, yaw), and nav_msgs/MapMetaData as the pose
# of cell (0, 0). A pose's rotation does not move its own position.
#
# Seen: evo draws the corner at (0, 2) and the end of the lower edge at (0, 4). ros_map() in
# tools/plot.py calls Affine2D().translate(x, y).rotate(yaw). matplotlib appends the rotation, so that
# it turns the translation, too, about the origin of the world. With a yaw of 0 the place is right.
#
# Instead: users write the position that the yaw turns into the right one: [R(-yaw) (x, y), yaw], here
# [0, -2, pi / 2]. This script does so at its end.
#
# The script calls evo's own function on axes that are not shown. It asks matplotlib where evo put the
# corners of the picture, as evo writes no numbers.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
cd "$dir"
/usr/bin/python3 -m venv env
env/bin/pip install --quiet --disable-pip-version-check evo==1.38.1
export HOME="$dir" # evo keeps its settings there

env/bin/python - <<'PYTHON'
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from evo.tools import plot

plt.imsave("map.png", np.full((10, 20), 200, np.uint8), cmap="gray", vmin=0, vmax=255)


def corners(x, y, yaw):
    with open("map.yaml", "w") as file:
        file.write(f"image: map.png\nresolution: 0.1\norigin: [{x}, {y}, {yaw}]\n"
                   "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")
    axes = plt.figure().add_subplot()
    plot.ros_map(axes, "map.yaml", plot.PlotMode.xy)
    to_metres = axes.images[-1].get_transform() - axes.transData
    found = to_metres.transform([(0, 0), (2, 0)])
    print(f"origin [{x}, {y}, {yaw:.4f}]: the lower edge goes from "
          + " to ".join(f"({a:.3f}, {b:.3f})" for a, b in np.round(found, 6) + 0.0))
    return found


straight = corners(2.0, 0.0, 0.0)
turned = corners(2.0, 0.0, math.pi / 2)
instead = corners(0.0, -2.0, math.pi / 2)
seen = (np.allclose(straight, [(2, 0), (4, 0)], atol=1e-3)
        and np.allclose(turned, [(0, 2), (0, 4)], atol=1e-3)
        and np.allclose(instead, [(2, 0), (2, 2)], atol=1e-3))
if not seen:
    print("changed: (0, 2) to (0, 4) was seen for the origin [2, 0, pi / 2]")
sys.exit(not seen)
PYTHON
