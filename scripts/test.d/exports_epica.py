"""Figures of `placegraph eval` beside those of epica 0.1.17, which runs as a process in an environment of its own.

Both read the same files. Where they differ, the right figure is computed by hand.
"""

import json
import os
import subprocess
import sys

import numpy
from exports_evaluation import figures, near, programs, same, write_circle, write_dense_truth, write_drive, write_line

KINDS = {"ape": {"position_m": "translation_part", "rotation_deg": "rotation_angle_deg", "full": "full_transformation"},
         "rpe": {"translation_m": "translation_part", "rotation_deg": "rotation_angle_deg", "full": "full_transformation", "length_m": "point_distance"}}


class Epica:
    """Its two metrics of files in a folder: statistics by the name of the error."""

    def __init__(self, folder, placegraph):
        self.folder, self.at = folder, placegraph.at

    def __call__(self, metric, truth, estimate, *options):
        command = [self.folder / f"epa_{metric}", "tum", truth, estimate, "--t_max_diff", 0.02, "--out_dir", "epica", *options]
        done = subprocess.run([str(word) for word in command], cwd=self.at("."), capture_output=True, text=True, env={**os.environ, "MPLCONFIGDIR": self.at("matplotlib")})
        if done.returncode != 0:
            sys.exit(f"exports_epica: {command}: {done.stderr.strip()}")
        with open(self.at("epica/metrics.json"), encoding="utf-8") as file:
            return json.load(file)["pose_metrics"][metric]["raw"]


def check_absolute(placegraph, epica, check, files):
    alignments = {("none",): ["--eval-align", "none"], ("se3",): ["-a"], ("origin",): ["--align_origin"], ("sim3",): ["--eval-align", "ov_sim3"],
                  ("yaw", "--vertical", "z"): ["--eval-align", "posyaw"], ("se3", "--align-first", 50): ["-a", "--n_to_align", 50]}
    for ours, theirs in alignments.items():
        mine, other = figures(placegraph, *files, "--align", *ours)["errors"], epica("ape", *files, *theirs)
        for key, name in KINDS["ape"].items():
            check(f"APE of {key} with {' '.join(map(str, ours))} is epica's", same(mine[key], other[name], 1e-6), (mine[key], other[name]))
    mine, other = figures(placegraph, *files, "--part", "xy")["errors"], epica("ape", *files, "-a", "--project_to_plane", "xy")
    check("APE in the plane xy is epica's", same(mine["position_m"], other["translation_part"], 1e-6), (mine["position_m"], other["translation_part"]))


def check_relative(placegraph, epica, check, files):
    for name, step, more in (("1f", [1, "f"], []), ("10f", [10, "f"], []), ("10f", [10, "f"], ["--all_pairs"]), ("1s", [1, "s"], ["-t", 0.01]), ("10deg", [10, "d"], [])):
        all_pairs = ["--all-pairs"] if "--all_pairs" in more else []
        mine = figures(placegraph, *files, "--delta", name, *all_pairs)["relative"][0]
        other = epica("rpe", *files, "-d", step[0], "-u", step[1], "--pairs_from_reference", *more)
        for key, theirs in KINDS["rpe"].items():
            check(f"RPE {key} over {name}{', all pairs,' if all_pairs else ''} is epica's", same(mine[key], other[theirs], 1e-6), (mine[key], other[theirs]))


def check_pairs(placegraph, epica, check):
    """A perfect estimate: but for the first pose epica takes the first true one within 12 ms, 10 ms early."""
    other = epica("ape", *write_dense_truth(placegraph), "--eval-align", "none", "--t_max_diff", 0.012)["translation_part"]
    check("epica takes a true pose before the nearest", near(other["rmse"], 10 * 0.010 * numpy.sqrt(200 / 201), 1e-6), other)


def check_metres(placegraph, epica, check):
    """Eleven steps of 1 m, estimated as 2 m: 4 m from the begin on are two steps, each 4 m too long; epica begins behind 4 m."""
    i = numpy.arange(12)
    truth, estimate = write_line(placegraph, "eleven_truth.tum", 0.1 * i, i), write_line(placegraph, "eleven.tum", 0.1 * i, 2 * i)
    mine = figures(placegraph, truth, estimate, "--delta", "4m")["relative"][0]["translation_m"]
    check("steps begin at the first pose", mine["count"] == 2 and near(mine["rmse"], 4), mine)
    other = epica("rpe", truth, estimate, "-d", 4, "-u", "m", "--pairs_from_reference")
    check("epica loses the first step", other["pair_count"] == 1 and near(other["translation_part"]["rmse"], 4), other["translation_part"])


def check_heading(placegraph, epica, check):
    """A camera on a circle in the plane xz, turned by 2 degrees as a whole: no motion is wrong. epica turns the other way about y."""
    truth, estimate = write_circle(placegraph, "camera_truth.tum"), write_circle(placegraph, "camera.tum", 2)
    mine = figures(placegraph, truth, estimate, "--align", "none", "--part", "xz")
    check("motions in the plane xz are right", mine["rpe_trans_m"] < 1e-6 and near(mine["are_rmse_deg"], 2, 1e-6), mine["rpe_trans_m"])
    other = epica("rpe", truth, estimate, "--project_to_plane", "xz")["translation_part"]
    check("epica turns them", near(other["rmse"], 20 * numpy.sin(numpy.deg2rad(0.5)) * 2 * numpy.sin(numpy.deg2rad(2)), 1e-6), other)


def check_epica(placegraph, check):
    folder = programs("EPICA")
    if not folder:
        return
    epica, files = Epica(folder, placegraph), write_drive(placegraph, 3)
    check_absolute(placegraph, epica, check, files)
    check_relative(placegraph, epica, check, files)
    for case in (check_pairs, check_metres, check_heading):
        case(placegraph, epica, check)
