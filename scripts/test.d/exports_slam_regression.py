"""Figures and verdicts of `placegraph eval` beside those of slam-regression-ci 0.2.1, which runs as a process in an environment of its own.

Both read the same files. Where they differ, the right figure is computed by hand.
"""

import json
import subprocess

import numpy
from exports_evaluation import figures, near, programs, write_dense_truth, write_drive, write_gap, write_tum


class SlamRegression:
    """Its two commands on files in a folder, with the settings that are given as YAML."""

    def __init__(self, folder, placegraph):
        self.program, self.at = folder / "slam-regression", placegraph.at

    def run(self, command, settings, *arguments):
        with open(self.at("settings.yaml"), "w", encoding="utf-8") as file:
            file.write(settings)
        return subprocess.run([str(self.program), command, "--config", "settings.yaml", *arguments], cwd=self.at("."), capture_output=True, text=True)

    def record(self, truth, estimate, settings, name="slam.json"):
        done = self.run("record", settings, "--reference", truth, "--estimate", estimate, "--json", name)
        if done.returncode != 0:
            raise RuntimeError(f"slam-regression record: {done.stderr}")
        with open(self.at(name), encoding="utf-8") as file:
            return json.load(file)

    def compare(self, truth, estimate, settings, baseline="slam.json"):
        return self.run("compare", settings, "--baseline", baseline, "--reference", truth, "--estimate", estimate).returncode


def check_figures(placegraph, slam, check, files):
    settings = {"none": "enabled: false", "se3": "enabled: true", "sim3": "correct_scale: true"}
    for align, setting in settings.items():
        for delta in (1, 10):
            theirs = slam.record(*files, f"alignment: {{{setting}}}\nrpe_delta: {delta}\nassociation: {{max_timestamp_diff: 0.02}}\n")
            ours = figures(placegraph, *files, "--align", align, "--delta", f"{delta}f", "--all-pairs")
            position, relative = ours["errors"]["position_m"], ours["relative"][0]["translation_m"]
            pairs = [(position[name], theirs["metrics"][f"ate_{name}"]) for name in ("rmse", "mean", "max")]
            pairs += [(relative[name], theirs["metrics"][f"rpe_{their}"]) for name, their in (("rmse", "translation_rmse"), ("mean", "mean"), ("max", "max"))]
            check(f"ATE and RPE over {delta} frames with {align} are slam-regression's", all(near(*two, 1e-6) for two in pairs), pairs)
            check("and the coverage", near(ours["coverage"], theirs["coverage"]["matched_pose_ratio"]), theirs["coverage"])


def worsened(placegraph, files, factor):
    """The estimate with `factor` times its error: after an alignment, too, nearly so many times as wrong."""
    truth, estimate = (numpy.loadtxt(placegraph.at(name)) for name in files)
    return write_tum(placegraph, f"worse{factor}.tum", truth[:, 0], truth[:, 1:4] + factor * (estimate[:, 1:4] - truth[:, 1:4]), estimate[:, 4:])


def gate(placegraph, truth, estimate, name, *rules):
    """The exit code of ours."""
    placegraph("eval", "record", truth, estimate, "--name", "drive", "--out", name, "--force", "--align", "none")
    return subprocess.run([placegraph.path, "eval", "gate", "baseline.json", name, *rules], cwd=placegraph.folder, capture_output=True, text=True).returncode


def check_gate(placegraph, slam, check, files):
    with open(placegraph.at("rules.txt"), "w", encoding="utf-8") as file:
        file.write("* | ate_rmse_m | worse 10 %\n* | * | info\n")
    settings = "alignment: {enabled: false}\nmetrics: {ate_rmse: {max_relative_regression_percent: 10}}\n"
    slam.record(*files, settings)
    gate(placegraph, *files, "baseline.json")
    for factor, verdict in ((0.8, 0), (1.05, 0), (1.2, 1)):
        estimate = worsened(placegraph, files, factor)
        both = gate(placegraph, files[0], estimate, "candidate.json", "--rules", "rules.txt"), slam.compare(files[0], estimate, settings)
        check(f"{factor} times the error gets exit code {verdict} of both", both == (verdict, verdict), both)
    with open(placegraph.at(files[1]), encoding="utf-8") as file, open(placegraph.at("half.tum"), "w", encoding="utf-8") as half:
        half.writelines(file.readlines()[:120])
    ours, theirs = gate(placegraph, files[0], "half.tum", "candidate.json"), slam.compare(files[0], "half.tum", settings)
    check("an estimate that ends halfway regressed", ours == 1, ours)
    check("slam-regression lets it pass unless `coverage` is set", theirs == 0 and slam.compare(files[0], "half.tum", settings + "coverage: {min_matched_pose_ratio: 0.9}\n") == 1, theirs)


def check_differences(placegraph, slam, check):
    """Its steps cross a gap, and but for the first pose it takes the first true one within 12 ms, 10 ms early."""
    theirs = slam.record(*write_gap(placegraph), "")["metrics"]
    check("slam-regression's steps cross a gap", near(theirs["rpe_translation_rmse"], 2 / numpy.sqrt(79), 1e-6), theirs)
    theirs = slam.record(*write_dense_truth(placegraph), "alignment: {enabled: false}\nassociation: {max_timestamp_diff: 0.012}\n")["metrics"]
    check("slam-regression takes a true pose before the nearest", near(theirs["ate_rmse"], 10 * 0.010 * numpy.sqrt(200 / 201), 1e-6), theirs)


def check_slam_regression(placegraph, check):
    folder = programs("SLAM_REGRESSION")
    if not folder:
        return
    slam, files = SlamRegression(folder, placegraph), write_drive(placegraph, 4)
    check_figures(placegraph, slam, check, files)
    check_gate(placegraph, slam, check, files)
    check_differences(placegraph, slam, check)
