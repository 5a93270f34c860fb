#!/bin/sh
# evo 1.38.1 (PyPI), seen 2026-11-29.
#
# Input: a camera drives a circle of 10 m in the plane of x and z, a degree a frame. Its z axis points
# forward and y is the normal of the plane, as in KITTI's odometry benchmark. The estimate is the
# truth, turned as a whole by 2 degrees about y.
#
# Expected: a rotation error of 2.000 deg in every frame and an RPE of 0 m. All motions are right, and
# all headings are 2 degrees off. That is what evo finds without the option. A projection into the
# plane in which the motion lies changes nothing.
#
# Seen with --project_to_plane xz: `evo_ape -r angle_deg` gives RMSE 1.994452 deg and a minimum of 0;
# evo_rpe gives RMSE 0.008602 m and a maximum of 0.012182 m. project() in core/trajectory.py takes
# the middle one of three Euler angles ("sxyz") for the heading. That angle ends at +-90 degrees, so
# that evo mirrors each heading beyond: 100 degrees become 80. Between mirrored headings the error
# has the wrong sign, which the absolute angle hides; the RPE shows it: a step of 0.1745 m is seen
# from a heading that is 4 degrees off, 0.1745 m * 2 sin 2 deg = 0.0122 m.
#
# Instead: users leave the option out where the motion is planar already, or let the axes change
# their places before (x, y, z -> z, x, y) and project to xy. evo takes the last Euler angle there,
# which has the whole circle. This script does so at its end.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' HUP INT TERM
cd "$dir"
/usr/bin/python3 -m venv env
env/bin/pip install --quiet --disable-pip-version-check evo==1.38.1
export HOME="$dir" # evo keeps its settings there

env/bin/python - <<'PYTHON'
from math import cos, radians, sin

def write(name, turn, swapped):
    with open(name, "w") as file:
        for i in range(361):
            heading, c, s = radians(i), cos(turn), sin(turn)
            x, z = 10 - 10 * cos(heading), 10 * sin(heading)
            x, z = c * x + s * z, c * z - s * x
            half = (heading + turn) / 2
            p = (z, x, 0) if swapped else (x, 0, z)
            q = (0, 0, sin(half)) if swapped else (0, sin(half), 0)
            row = [*p, *q, cos(half)]
            file.write(f"{i / 10:.1f} " + " ".join(f"{v:.9f}" for v in row) + "\n")

for swapped in (False, True):
    write("truth.swapped" if swapped else "truth", 0, swapped)
    write("estimate.swapped" if swapped else "estimate", radians(2), swapped)
PYTHON

value() { name=$1; shift; "env/bin/$@" | awk -v name="$name" '$1 == name { print $2 }'; }
near() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a ~ /^[0-9]/ && a - b < 1e-4 && b - a < 1e-4) }'; }
turns() { value "$1" evo_ape tum "truth$2" "estimate$2" -r angle_deg ${3:+--project_to_plane $3}; }
steps() { value "$1" evo_rpe tum "truth$2" "estimate$2" ${3:+--project_to_plane $3}; }

echo "not projected:      $(turns rmse '') deg RMSE, $(turns min '') deg min, $(steps max '') m RPE max"
echo "projected to xz:    $(turns rmse '' xz) deg, $(turns min '' xz) deg, $(steps max '' xz) m"
echo "swapped, to xy:     $(turns rmse .swapped xy) deg, $(turns min .swapped xy) deg," \
  "$(steps max .swapped xy) m"

if near "$(turns min '')" 2 && near "$(steps max '')" 0 && near "$(turns rmse '' xz)" 1.994452 &&
  near "$(turns min '' xz)" 0 && near "$(steps rmse '' xz)" 0.008602 &&
  near "$(steps max '' xz)" 0.012182 && near "$(turns min .swapped xy)" 2 &&
  near "$(steps max .swapped xy)" 0; then
  exit 0
fi
echo "changed: with --project_to_plane xz, 1.994452 deg (min 0) and 0.008602 m (max 0.012182) were seen"
exit 1
