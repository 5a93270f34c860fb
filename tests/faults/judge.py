#!/usr/bin/python3
"""judge.py: makes sequences with faults, runs placegraph on each, and judges what it did and said.

A table goes to stdout, a line a run, then the summary. Exit codes: 0 ok, 1 more runs than allowed
are wrong and unreported, 2 the kit itself failed. README.md explains the terms.
"""
import argparse
import concurrent.futures
import dataclasses
import json
import os
import shutil
import subprocess
import sys
import threading

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import report
from wrong_poses import components_of, read_poses, wrong_frames

HERE = os.path.dirname(os.path.abspath(__file__))
TIMEOUT_S = 1200


class KitError(Exception):
    """The kit cannot do its work; the message is one line."""


@dataclasses.dataclass(frozen=True)
class Base:
    """A sequence that faults are put into. `world`: arguments of `placegraph synth sequence`;
    `recorded`: a sequence below DATA/sequences."""
    name: str
    sensors: tuple
    frames: int
    world: tuple = ()
    recorded: str = ""
    options: tuple = ()  # of make_fault


RENDERED = (
    Base("town", ("mono", "stereo"), 120, world=("town-loop", "--stereo", "--size", "620x188")),
    Base("corridor", ("rgbd",), 120, world=("corridor-loop", "--size", "320x240")),
)
RECORDED = (
    Base("kitti00", ("mono",), 120, recorded="kitti00_mono200", options=("--scale", "0.5", "--camera-height", "1.65")),
    Base("kitti06", ("stereo",), 51, recorded="kitti06_stereo51", options=("--scale", "0.5")),
    Base("sevenscenes", ("rgbd",), 120, recorded="sevenscenes_rgbd334", options=("--scale", "0.5")),
)
QUICK_FRAMES = 40
QUICK = {"black_few": "mono", "noise_alone": "mono", "overlay_blocks_33": "mono", "every_5th": "mono",
         "focal_plus_20": "mono", "camera_height_10x": "mono", "kidnap": "mono", "baseline_2x": "stereo",
         "right_late": "stereo", "right_rows_6": "stereo", "depth_late_20": "rgbd", "depth_unit_1000": "rgbd"}


@dataclasses.dataclass(frozen=True)
class Fault:
    name: str
    sensors: tuple
    group: str
    causes: tuple


CLEAN = Fault("none", ("mono", "stereo", "rgbd"), "clean", ())


def call(arguments, failure):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise KitError(f"{failure}: {(done.stderr.strip().splitlines() or ['no message'])[-1]}")
    return done.stdout


class Kit:
    def __init__(self, chosen):
        self.program, self.make_fault, self.work = chosen.program, chosen.make_fault, chosen.work
        self.seed, self.frames, self.keep = chosen.seed, chosen.frames, chosen.keep
        self.data = chosen.data
        self.base_lock = threading.Lock()
        shutil.rmtree(os.path.join(self.work, "bases"), ignore_errors=True)  # of another program, perhaps

    def table(self):
        faults = []
        for line in call([self.make_fault, "list"], "make_fault list").splitlines():
            if not line.startswith("#"):
                name, sensors, group, causes, _ = line.split("\t")
                faults.append(Fault(name, tuple(sensors.split()), group, () if causes == "-" else tuple(causes.split("|"))))
        unknown = sorted({cause for fault in faults for cause in fault.causes} - report.CAUSES - {report.UNCHECKED})
        if unknown:
            raise KitError(f"make_fault list: cause '{unknown[0]}' is unknown")
        return faults

    def source(self, base):
        """The folder of a base sequence, rendered when it is first needed."""
        if base.recorded:
            return os.path.join(self.data, "sequences", base.recorded)
        frames = self.frames or base.frames
        folder = os.path.join(self.work, "bases", f"{base.name}_{frames}")
        with self.base_lock:
            if not os.path.isdir(folder):
                os.makedirs(os.path.dirname(folder), exist_ok=True)
                call([self.program, "synth", "sequence", *base.world, "--frames", frames, "--threads", 1, "--out", folder],
                     f"base {base.name}")
        return folder

    def judge(self, base, fault, sensors):
        """Makes one faulty sequence and runs the program on it as each sensor."""
        folder = os.path.join(self.work, f"{base.name}-{fault.name}")
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        sequence = os.path.join(folder, "sequence")
        call([self.make_fault, fault.name, self.source(base), sequence, "--seed", self.seed, "--frames",
              self.frames or base.frames, *base.options], f"fault {fault.name} of {base.name}")
        runs = [self.run(base, fault, sensor, sequence, os.path.join(folder, sensor)) for sensor in sensors]
        if not self.keep:
            shutil.rmtree(folder)
        return runs

    def run(self, base, fault, sensor, sequence, out):
        arguments = [self.program, "run", sequence, "--sensor", sensor, "--quiet", "--threads", "1", "--out", out]
        try:
            done = subprocess.run(arguments, capture_output=True, text=True, errors="replace", timeout=TIMEOUT_S)
            code, message = done.returncode, (done.stderr.strip().splitlines() or [""])[-1]
        except subprocess.TimeoutExpired:
            code, message = -1, f"no end within {TIMEOUT_S} s"
        message = message.replace(sequence, "SEQUENCE")
        run = report.Run(fault.name, fault.group, base.name, sensor, list(fault.causes), code, message=message)
        with open(os.path.join(sequence, "fault.json"), encoding="utf-8") as file:
            first_faulty = json.load(file)["first"]
        truth = read_poses(os.path.join(sequence, "poses.txt"))
        run.frames = len(truth)
        if os.path.exists(os.path.join(out, "result.json")):
            read_run(run, out, truth, first_faulty)
        return run


def read_run(run, out, truth, first_faulty):
    """Fills in what the folder of a run says."""
    with open(os.path.join(out, "result.json"), encoding="utf-8") as file:
        result = json.load(file)
    run.verdict, run.found, run.unchecked = report.judgement_of(result)
    run.metric = result.get("judgement", result)["metric"]
    poses = read_poses(os.path.join(out, "trajectory_optimized.kitti"))
    if len(poses) != len(truth):
        raise KitError(f"{out}: {len(poses)} lines in the trajectory, {len(truth)} frames")
    run.posed = sum(pose is not None for pose in poses)
    run.wrong = wrong_frames(poses, truth, components_of(out, len(poses)), first_faulty, run.metric)


def bound_of(name):
    """The largest number of runs that may be wrong and unreported, by bounds.txt."""
    with open(os.path.join(HERE, "bounds.txt"), encoding="utf-8") as file:
        for line in file:
            fields = line.split("#")[0].split()
            if fields and fields[0] == name:
                return int(fields[1])
    raise KitError(f"bounds.txt: has no bound '{name}'")


def parse(arguments):
    parser = argparse.ArgumentParser(prog="judge.py", description="Runs placegraph on sequences with faults and judges whether it reports them.")
    parser.add_argument("--program", required=True, help="the program placegraph")
    parser.add_argument("--make-fault", required=True, help="the program make_fault")
    parser.add_argument("--work", required=True, help="folder for sequences and runs")
    parser.add_argument("--quick", action="store_true", help=f"{len(QUICK)} faults, {QUICK_FRAMES} frames")
    parser.add_argument("--data", help="research data: faults are put into its sequences, too")
    parser.add_argument("--fault", action="append", default=[], metavar="NAME", help="this fault alone; may be repeated")
    parser.add_argument("--base", action="append", default=[], metavar="NAME", help="this base sequence alone; may be repeated")
    parser.add_argument("--sensor", choices=("mono", "stereo", "rgbd"), help="runs with this sensor alone")
    parser.add_argument("--group", choices=("fixed", "held"), help="faults of this group alone")
    parser.add_argument("--frames", type=int, default=0, help="frames of a base sequence; default: as its table says")
    parser.add_argument("--seed", type=int, default=1, help="seed of the faults")
    parser.add_argument("--jobs", type=int, default=1, help="sequences at a time")
    parser.add_argument("--keep", action="store_true", help="keep the sequences and runs")
    parser.add_argument("--json", metavar="FILE", help="write all figures there")
    parser.add_argument("--allow", type=int, default=0, metavar="N", help="runs on rendered sequences that may be wrong and unreported")
    parser.add_argument("--bound", metavar="NAME", help="as --allow, with the number that bounds.txt names so")
    chosen = parser.parse_args(arguments)
    if chosen.quick:
        chosen.frames = chosen.frames or QUICK_FRAMES
    return chosen


def tasks_of(chosen, table):
    """(base, fault, sensors) of all sequences to make, the clean ones first."""
    unknown = sorted(set(chosen.fault) - {fault.name for fault in table})
    if unknown:
        raise KitError(f"--fault {unknown[0]}: is no fault")
    bases = [base for base in RENDERED + (RECORDED if chosen.data else ()) if not chosen.base or base.name in chosen.base]
    if not bases:
        raise KitError(f"--base {chosen.base[0]}: is no base sequence")
    faults = [fault for fault in table
              if (not chosen.fault or fault.name in chosen.fault) and (not chosen.quick or fault.name in QUICK)
              and (not chosen.group or fault.group == chosen.group)]
    tasks = []
    for fault in [CLEAN, *faults]:
        for base in bases:
            sensors = [sensor for sensor in base.sensors if sensor in fault.sensors and chosen.sensor in (None, sensor)
                       and (not chosen.quick or fault is CLEAN or QUICK[fault.name] == sensor)]
            if sensors:
                tasks.append((base, fault, sensors))
    return tasks


def judge_all(kit, tasks, jobs):
    """All runs, printed as they end, in the order of the tasks."""
    print(report.HEADING)
    runs = []
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        futures = [pool.submit(kit.judge, *task) for task in tasks]
        try:
            for future in futures:
                for run in future.result():
                    runs.append(run)
                    print(report.row_of(run), flush=True)
        except BaseException:
            for future in futures:
                future.cancel()
            raise
    return runs


def unreported_of_rendered(runs):
    """The number of runs on rendered sequences that are wrong and unreported: what a bound is for."""
    rendered = {base.name for base in RENDERED}
    return report.summary_of([run for run in runs if run.base in rendered])["wrong_and_unreported"]


def main(arguments):
    chosen = parse(arguments)
    try:
        allowed = bound_of(chosen.bound) if chosen.bound else chosen.allow
        kit = Kit(chosen)
        runs = judge_all(kit, tasks_of(chosen, kit.table()), chosen.jobs)
        if chosen.json:
            with open(chosen.json, "w", encoding="utf-8") as file:
                file.write(report.to_json(runs) + "\n")
    except (KitError, OSError, ValueError, KeyError) as error:
        print(f"judge.py: {error}", file=sys.stderr)
        return 2
    for group in ("fixed", "held"):
        print(report.summary_line(group, [run for run in runs if run.group == group]).split("; false alarms")[0])
    print(report.summary_line("faults", runs))
    found = unreported_of_rendered(runs)
    if found > allowed:
        print(f"judge.py: {found} runs on rendered sequences are wrong and unreported, {allowed} are allowed")
    return 1 if found > allowed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
