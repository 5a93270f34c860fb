"""Figures of `placegraph eval` beside those of evo, where both define them alike.

Both read the same files, so that the figures agree to the rounding of doubles. Where they differ by
design (docs/evaluation.md, "Beside other tools"), the right figure is computed by hand.
"""

import copy
import json
import os
import pathlib

import numpy
from evo.core import metrics, sync
from evo.core.metrics import PoseRelation, Unit
from evo.core.trajectory import Plane
from evo.tools import file_interface

TOLERANCE = 1e-9
STATISTICS = ("rmse", "mean", "median", "std", "min", "max", "sse")


def rotations(vectors):
    """Quaternions x y z w of rotation vectors [rad], N x 3."""
    angles = numpy.linalg.norm(vectors, axis=1)
    axes = vectors / numpy.maximum(angles, 1e-12)[:, None]
    return numpy.column_stack([axes * numpy.sin(angles / 2)[:, None], numpy.cos(angles / 2)])


def write_tum(placegraph, name, stamps, positions, quaternions):
    numpy.savetxt(placegraph.at(name), numpy.column_stack([stamps, positions, quaternions]), fmt=["%.6f"] + ["%.12f"] * 7)
    return name


def write_line(placegraph, name, stamps, metres):
    """A straight drive along x without rotation."""
    return write_tum(placegraph, name, stamps, numpy.outer(metres, [1, 0, 0]), numpy.tile([0, 0, 0, 1], (len(stamps), 1)))


def write_circle(placegraph, name, turn_deg=0):
    """A camera that drives a circle of 10 m in the plane xz, a degree a frame; turned by `turn_deg` about the centre of the world."""
    angle, turn = numpy.deg2rad(numpy.arange(361)), numpy.deg2rad(turn_deg)
    position = 10 * numpy.column_stack([1 - numpy.cos(angle), 0 * angle, numpy.sin(angle)])
    about_y = numpy.array([[numpy.cos(turn), 0, numpy.sin(turn)], [0, 1, 0], [-numpy.sin(turn), 0, numpy.cos(turn)]])
    return write_tum(placegraph, name, 0.1 * numpy.arange(361), position @ about_y.T, rotations(numpy.outer(angle + turn, [0, 1, 0])))


def write_gap(placegraph):
    """A hundred frames at 10 Hz and 1 m/s, and an estimate that is perfect, lost for twenty of them, then 2 m off."""
    i = numpy.arange(100)
    posed = i[(i < 40) | (i >= 60)]
    return write_line(placegraph, "gap_truth.tum", 0.1 * i, 0.1 * i), write_line(placegraph, "gap.tum", 0.1 * posed, 0.1 * posed + 2 * (posed >= 60))


def write_dense_truth(placegraph):
    """A truth of 200 Hz at 10 m/s, and a perfect estimate of 20 Hz."""
    i = numpy.arange(2001)
    return write_line(placegraph, "dense_truth.tum", 0.005 * i, 0.05 * i), write_line(placegraph, "sparse.tum", 0.005 * i[::10], 0.05 * i[::10])


def write_drive(placegraph, seed, frames=240):
    """A drive of `frames` poses at 10 Hz, and an estimate of it that drifts and jitters."""
    random = numpy.random.default_rng(seed)
    i = numpy.arange(frames)
    yaw = 0.8 * numpy.sin(0.03 * i) + 0.01 * i
    turn = numpy.column_stack([0.02 * numpy.sin(0.1 * i), 0.03 * numpy.cos(0.07 * i), yaw])
    step = 0.5 + 0.3 * numpy.sin(0.05 * i)
    position = numpy.cumsum(numpy.column_stack([step * numpy.cos(yaw), step * numpy.sin(yaw), 0.05 * numpy.sin(0.2 * i)]), axis=0)
    drift = numpy.cumsum(random.normal(0, 0.01, (frames, 3)), axis=0) + random.normal(0, 0.01, (frames, 3))
    bend = numpy.cumsum(random.normal(0, 0.001, (frames, 3)), axis=0)
    stamps = 1.6e9 + 0.1 * i
    for name, p, r in ((f"truth{seed}.tum", position, turn), (f"estimate{seed}.tum", 1.02 * position + drift, turn + bend)):
        write_tum(placegraph, name, stamps, p, rotations(r))
    return f"truth{seed}.tum", f"estimate{seed}.tum"


def figures(placegraph, truth, estimate, *options):
    return json.loads(placegraph("eval", truth, estimate, *options, "--json"))


def pair(placegraph, truth, estimate, max_diff=0.02):
    read = file_interface.read_tum_trajectory_file
    return sync.associate_trajectories(read(placegraph.at(truth)), read(placegraph.at(estimate)), max_diff=max_diff)


def near(ours, theirs, tolerance=TOLERANCE):
    return abs(ours - theirs) <= tolerance * max(1.0, abs(theirs))


def same(ours, theirs, tolerance=TOLERANCE):
    return all(near(ours[name], theirs[name], tolerance) for name in STATISTICS)


def programs(name):
    """The folder of the programs of a tool in an environment of its own (exports_test makes it), or nothing, which is said."""
    folder = os.environ.get("EXPORTS_" + name)
    if not folder:
        print(f"  skipped: {name.lower()} is not installed")
    return folder and pathlib.Path(folder)


def statistics(metric, data):
    metric.process_data(data)
    return metric.get_all_statistics()


def check_absolute(placegraph, check, truth, estimate):
    """APE of positions, angles and whole poses by every alignment that both have."""
    alignments = {
        ("none",): lambda ref, est: None,
        ("se3",): lambda ref, est: est.align(ref),
        ("sim3",): lambda ref, est: est.align(ref, correct_scale=True),
        ("origin",): lambda ref, est: est.align_origin(ref),
        ("se3", "--align-first", 50): lambda ref, est: est.align(ref, n=50),
        ("sim3", "--align-frames", "0:80"): lambda ref, est: est.align(ref, correct_scale=True, n=80),
    }
    for arguments, align in alignments.items():
        ours = figures(placegraph, truth, estimate, "--align", *arguments)["errors"]
        reference, estimated = pair(placegraph, truth, estimate)
        align(reference, estimated)
        for key, relation in (("position_m", PoseRelation.translation_part), ("rotation_deg", PoseRelation.rotation_angle_deg), ("full", PoseRelation.full_transformation)):
            theirs = statistics(metrics.APE(relation), (reference, estimated))
            check(f"APE of {key} with {' '.join(map(str, arguments))} is evo's", same(ours[key], theirs), (ours[key], theirs))


def check_projected(placegraph, check, truth, estimate):
    for plane in (Plane.XY, Plane.XZ, Plane.YZ):
        ours = figures(placegraph, truth, estimate, "--part", plane.value)["errors"]
        reference, estimated = pair(placegraph, truth, estimate)
        estimated.align(reference)
        reference.project(plane)
        estimated.project(plane)
        theirs = statistics(metrics.APE(PoseRelation.translation_part), (reference, estimated))
        check(f"APE in the plane {plane.value} is evo's", same(ours["position_m"], theirs), (ours["position_m"], theirs))


def check_relative(placegraph, check, truth, estimate):
    """RPE of steps of frames, metres and degrees; evo's steps by the reference."""
    steps = (("1f", 1, Unit.frames), ("10f", 10, Unit.frames), ("5m", 5.0, Unit.meters), ("12.5m", 12.5, Unit.meters), ("10deg", 10.0, Unit.degrees))
    relations = (("translation_m", PoseRelation.translation_part), ("rotation_deg", PoseRelation.rotation_angle_deg), ("full", PoseRelation.full_transformation), ("length_m", PoseRelation.point_distance))
    for all_pairs in (False, True):
        chosen = [step for step in steps if not all_pairs or step[2] is Unit.frames]
        more = ["--all-pairs"] if all_pairs else []
        told = figures(placegraph, truth, estimate, "--delta", ",".join(step[0] for step in chosen), *more)
        for (name, delta, unit), ours in zip(chosen, told["relative"]):
            data = pair(placegraph, truth, estimate)
            for key, relation in relations:
                theirs = statistics(metrics.RPE(relation, delta, unit, all_pairs=all_pairs, pairs_from_reference=True), copy.deepcopy(data))
                check(f"RPE {key} over {name}, {'all' if all_pairs else 'consecutive'} pairs, is evo's", same(ours[key], theirs), (ours[key], theirs))


def check_pairs(placegraph, check):
    """The nearest true pose, once. evo takes those of 100 Hz twice for 200 Hz that end before them, 5 ms or 5 cm off."""
    sparse = figures(placegraph, *write_dense_truth(placegraph), "--align", "none")
    check("the nearest true pose is taken", sparse["posed"] == 201 and sparse["ate_max_m"] < 1e-9, sparse["ate_max_m"])
    truth = write_line(placegraph, "slow_truth.tum", 0.01 * numpy.arange(1001), 0.1 * numpy.arange(1001))
    estimate = write_line(placegraph, "fast.tum", 0.005 * numpy.arange(201), 0.05 * numpy.arange(201))
    ours = figures(placegraph, truth, estimate, "--align", "none")
    check("every true pose is used once", (ours["posed"], ours["estimate_beside_nearer"]) == (101, 100) and ours["ate_max_m"] < 1e-9 and ours["rpe_trans_m"] < 1e-9, ours)
    rpe = statistics(metrics.RPE(PoseRelation.translation_part), pair(placegraph, truth, estimate))
    check("evo takes them twice", near(rpe["rmse"], 10 * 0.005, 1e-6), rpe)


def check_gap(placegraph, check):
    """A step of 2.1 s, which is 2 m off, among 78 of 0.1 s, which are perfect."""
    truth, estimate = write_gap(placegraph)
    ours = figures(placegraph, truth, estimate, "--delta", "1f")
    check("no step crosses a gap", ours["rpe_trans_m"] < 1e-9 and ours["relative"][0]["translation_m"]["count"] == 78 and near(ours["coverage"], 0.8), ours)
    rpe = statistics(metrics.RPE(PoseRelation.translation_part), pair(placegraph, truth, estimate))
    check("evo's steps cross it", near(rpe["rmse"], 2 / numpy.sqrt(79), 1e-6), rpe)


def check_metres(placegraph, check):
    """Ten steps of 1 m, estimated as 2 m: 4 m of the true path are four steps, and 4 m too long."""
    i = numpy.arange(11)
    truth, estimate = write_line(placegraph, "metres_truth.tum", 0.1 * i, i), write_line(placegraph, "metres.tum", 0.1 * i, 2 * i)
    ours = figures(placegraph, truth, estimate, "--delta", "4m")["relative"][0]["translation_m"]
    check("metres are those of the true path", ours["count"] == 2 and near(ours["rmse"], 4), ours)
    rpe = statistics(metrics.RPE(PoseRelation.translation_part, 4.0, Unit.meters), pair(placegraph, truth, estimate))
    check("evo's are those of the estimate", near(rpe["rmse"], 2), rpe)


def check_heading(placegraph, check):
    """A camera on a circle, turned by 2 degrees as a whole: no motion is wrong, and every heading by 2 degrees."""
    truth, estimate = write_circle(placegraph, "circle_truth.tum"), write_circle(placegraph, "circle.tum", 2)
    ours = figures(placegraph, truth, estimate, "--align", "none", "--part", "xz")
    check("headings beyond 90 degrees count in the plane xz", near(ours["are_rmse_deg"], 2, 1e-6) and ours["rpe_trans_m"] < 1e-6, ours)
    data = pair(placegraph, truth, estimate)
    for each in data:
        each.project(Plane.XZ)
    ape, rpe = statistics(metrics.APE(PoseRelation.rotation_angle_deg), data), statistics(metrics.RPE(PoseRelation.translation_part), data)
    check("evo mirrors them", near(ape["min"], 0, 1e-6) and near(rpe["max"], 20 * numpy.sin(numpy.deg2rad(0.5)) * 2 * numpy.sin(numpy.deg2rad(2)), 1e-6), (ape, rpe))


def check_backwards(placegraph, check):
    """A step of 1 m that turns by 0.1 rad too much at its end. TUM's evaluate_rpe measures it from the end, here by hand."""
    truth = write_line(placegraph, "step_truth.tum", [0, 0.1], [0, 1])
    estimate = write_tum(placegraph, "step.tum", [0, 0.1], [[0, 0, 0], [1, 0, 0]], rotations(numpy.array([[0, 0, 0], [0, 0, 0.1]])))
    ours = figures(placegraph, truth, estimate, "--align", "none")
    check("a turn at the end of a step moves nothing", ours["rpe_trans_m"] < 1e-9 and near(ours["rpe_rot_deg"], numpy.rad2deg(0.1), 1e-6), ours)
    (t0, t1), (e0, e1) = (each.poses_se3 for each in pair(placegraph, truth, estimate))
    inverse = numpy.linalg.inv
    backwards = inverse(inverse(e1) @ e0) @ (inverse(t1) @ t0)
    check("from its end it does", near(numpy.linalg.norm(backwards[:3, 3]), 2 * numpy.sin(0.05), 1e-6), backwards.tolist())


def check_evaluation(placegraph, check):
    for case in (check_pairs, check_gap, check_metres, check_heading, check_backwards):
        case(placegraph, check)
    for seed in (1, 2):
        files = write_drive(placegraph, seed)
        check_absolute(placegraph, check, *files)
        check_projected(placegraph, check, *files)
        check_relative(placegraph, check, *files)
    # A file of evo's own writing is read again.
    reference, _ = pair(placegraph, *files)
    file_interface.write_tum_trajectory_file(placegraph.at("by_evo.tum"), reference)
    told = figures(placegraph, files[0], "by_evo.tum", "--align", "none")
    check("a trajectory that evo wrote is the same", told["ate_max_m"] < 1e-6, told["ate_max_m"])
    pathlib.Path(placegraph.at("by_evo.tum")).unlink()
