#!/bin/sh
# epica 0.1.17 (PyPI), seen 2026-11-29.
#
# Input: two ROS maps of 40 x 40 cells of 0.1 m, with the origin [0, 0, 0]. In the picture of the one
# the upper half is black (occupied), in that of the other the lower half. The trajectory is the
# diagonal of the map, and is its own estimate.
#
# Expected: `epa_ape --ros_map_yaml` draws the upper half of the map's picture at y = 2 to 4 m, above
# the lower half. map_server defines the origin as the pose of the lower left pixel, so that the
# upper rows have the larger y.
#
# Seen: the upper half is drawn below the lower one; walls and trajectory do not belong together. The
# function that draws the map (ape_tool.py, and its copies in rpe_tool.py, traj_tool.py and
# viz/plot_bundle.py) calls imshow(picture, origin="lower", ...), which draws the first row lowest. A
# picture file begins with its uppermost row.
#
# Instead: users give a picture that is flipped from top to bottom, and a YAML file that names it.
# The other map of this script is just that: what epica draws of it is right for the first one.
#
# The script compares two pictures that epica wrote, pixel by pixel. They differ where the maps do:
# where the first is darker, it shows its black half. Rows count from the top of a picture.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
cd "$dir"
/usr/bin/python3 -m venv env
env/bin/pip install --quiet --disable-pip-version-check epica==0.1.17
export HOME="$dir" MPLBACKEND=Agg # epica keeps its settings there

env/bin/python - <<'PYTHON'
import matplotlib.pyplot as plt
import numpy as np

cells = np.full((40, 40), 255, np.uint8)
cells[:20] = 0
for name, picture in (("upper", cells), ("lower", cells[::-1])):
    plt.imsave(name + ".png", picture, cmap="gray", vmin=0, vmax=255)
    with open(name + ".yaml", "w") as file:
        file.write(f"image: {name}.png\nresolution: 0.1\norigin: [0.0, 0.0, 0.0]\n"
                   "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")
with open("drive.tum", "w") as file:
    for i in range(40):
        file.write(f"{i / 10:.1f} {i / 10:.1f} {i / 10:.1f} 0 0 0 0 1\n")
PYTHON

for half in upper lower; do
  env/bin/epa_ape tum drive.tum drive.tum --plot --plot_mode xy --ros_map_yaml $half.yaml \
    --save_plot drawn_$half --out_dir out_$half >/dev/null
done

env/bin/python - <<'PYTHON'
import sys

import matplotlib.pyplot as plt
import numpy as np

first, second = (plt.imread(f"drawn_{half}_map.png")[:, :, :3].mean(axis=2) for half in ("upper", "lower"))
black_upper = np.nonzero(second - first > 0.2)[0].mean()
black_lower = np.nonzero(first - second > 0.2)[0].mean()
print(f"upper half: drawn around row {black_upper:.0f} of {first.shape[0]}; lower half: {black_lower:.0f}")
if not black_upper - black_lower > 0.2 * first.shape[0]:
    print("changed: the upper half was drawn below the lower one")
    sys.exit(1)
PYTHON
