"""Figures of `placegraph eval` beside those of evo, where both define them alike.

Both read the same files, so that the figures agree to the rounding of doubles.
"""

import copy
import json
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
        numpy.savetxt(placegraph.at(name), numpy.column_stack([stamps, p, rotations(r)]), fmt=["%.6f"] + ["%.12f"] * 7)
    return f"truth{seed}.tum", f"estimate{seed}.tum"


def pair(placegraph, truth, estimate):
    read = file_interface.read_tum_trajectory_file
    return sync.associate_trajectories(read(placegraph.at(truth)), read(placegraph.at(estimate)), 0.02)


def same(ours, theirs):
    return all(abs(ours[name] - theirs[name]) <= TOLERANCE * max(1.0, abs(theirs[name])) for name in STATISTICS)


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
        ours = json.loads(placegraph("eval", truth, estimate, "--align", *arguments, "--json"))["errors"]
        reference, estimated = pair(placegraph, truth, estimate)
        align(reference, estimated)
        for key, relation in (("position_m", PoseRelation.translation_part), ("rotation_deg", PoseRelation.rotation_angle_deg), ("full", PoseRelation.full_transformation)):
            theirs = statistics(metrics.APE(relation), (reference, estimated))
            check(f"APE of {key} with {' '.join(map(str, arguments))} is evo's", same(ours[key], theirs), (ours[key], theirs))


def check_projected(placegraph, check, truth, estimate):
    for plane in (Plane.XY, Plane.XZ, Plane.YZ):
        ours = json.loads(placegraph("eval", truth, estimate, "--part", plane.value, "--json"))["errors"]
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
        told = json.loads(placegraph("eval", truth, estimate, "--delta", ",".join(step[0] for step in chosen), *more, "--json"))
        for (name, delta, unit), ours in zip(chosen, told["relative"]):
            data = pair(placegraph, truth, estimate)
            for key, relation in relations:
                theirs = statistics(metrics.RPE(relation, delta, unit, all_pairs=all_pairs, pairs_from_reference=True), copy.deepcopy(data))
                check(f"RPE {key} over {name}, {'all' if all_pairs else 'consecutive'} pairs, is evo's", same(ours[key], theirs), (ours[key], theirs))


def check_evaluation(placegraph, check):
    for seed in (1, 2):
        files = write_drive(placegraph, seed)
        check_absolute(placegraph, check, *files)
        check_projected(placegraph, check, *files)
        check_relative(placegraph, check, *files)
    # A file of evo's own writing is read again.
    reference, _ = pair(placegraph, *files)
    file_interface.write_tum_trajectory_file(placegraph.at("by_evo.tum"), reference)
    told = json.loads(placegraph("eval", files[0], "by_evo.tum", "--align", "none", "--json"))
    check("a trajectory that evo wrote is the same", told["ate_max_m"] < 1e-6, told["ate_max_m"])
    pathlib.Path(placegraph.at("by_evo.tum")).unlink()
