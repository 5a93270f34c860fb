"""One case: its commands through both programs, and the comparison of what they leave."""
import os
import resource
import shlex
import shutil
import subprocess
import time
from dataclasses import dataclass, field

from case import PLACEHOLDER, Copy, Make, Run
from compare import compare_folders

TIME_LIMIT_S = 3600
SIDES = ("base", "present")


@dataclass
class CaseResult:
    name: str
    outcome: str  # identical, different, failed or skipped
    files: int = 0
    masked: int = 0
    seconds: float = 0
    cpu_s: float = 0  # of both programs
    notes: list = field(default_factory=list)


def cpu_of_programs():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Runner:
    """`programs` are the paths of the base program and of the present one; `out` takes everything that is written."""

    def __init__(self, programs, out, data, masks, renames):
        self.programs = dict(zip(SIDES, programs))
        self.out = out
        self.data = data
        self.masks = masks
        self.renames = renames
        self.outcomes = {}
        cores = sorted(os.sched_getaffinity(0))
        half = len(cores) // 2
        self.cores = {"base": cores[:half] or cores, "present": cores[half:] or cores}

    def folder(self, side, case_name):
        return os.path.join(self.out, side, case_name)

    def filled_in(self, text):
        places = {"inputs": os.path.join(self.out, "inputs"), "data": self.data or ""}
        return PLACEHOLDER.sub(lambda m: places.get(m[1]) or self.folder("base", m[1]), text)

    def run(self, case):
        begin, cpu_begin = time.monotonic(), cpu_of_programs()
        absent = [p for p in case.data_paths() if not self.data or not os.path.exists(os.path.join(self.data, p))]
        missing = [n for n in case.needs() if self.outcomes.get(n) in (None, "failed", "skipped")]
        if absent:
            result = CaseResult(case.name, "skipped", notes=[f"absent: {', '.join(absent)}"])
        elif missing:
            skipped = all(self.outcomes.get(n) == "skipped" for n in missing)
            result = CaseResult(case.name, "skipped" if skipped else "failed", notes=[f"needs {', '.join(missing)}"])
        else:
            result = self.run_and_compare(case)
        result.seconds, result.cpu_s = time.monotonic() - begin, cpu_of_programs() - cpu_begin
        self.outcomes[case.name] = result.outcome
        return result

    def run_and_compare(self, case):
        for side in SIDES:
            shutil.rmtree(self.folder(side, case.name), ignore_errors=True)
            os.makedirs(self.folder(side, case.name))
        copies, notes, number, failed = [], [], 0, False
        for step in case.steps:
            if isinstance(step, Make):
                step.make(self.filled_in(step.folder if step.folder.startswith("{") else "{inputs}/" + step.folder),
                          *[self.filled_in(a) if isinstance(a, str) else a for a in step.arguments])
            elif isinstance(step, Copy):
                copies.append((step.to, self.copy(case, step)))
            else:
                number += 1
                exits = self.run_command(case, step, number)
                if exits["base"] != exits["present"]:
                    notes.append(f"command {number} ({step.line}): exit code: base {exits['base']}, present {exits['present']}")
                elif exits["base"] != step.exits:
                    failed = True
                    notes.append(f"command {number} ({step.line}): both exit with {exits['base']}, expected {step.exits}: {self.complaint(case, number)}")
                if notes:
                    break
        return self.judged(case, copies, notes, failed)

    def judged(self, case, copies, notes, failed):
        # A copy that no command changed is no output of the case.
        ignore = [to for to, before in copies if all(self.stamp(case, side, to) == before[side] for side in SIDES)]
        folders = [os.path.join(self.out, side) for side in SIDES]
        compared = compare_folders(self.folder("base", case.name), self.folder("present", case.name),
                                   self.masks.of_case(case.name), self.renames, folders, ignore)
        notes += compared.differences
        if not failed and not notes and compared.files == 0:
            failed = True
            notes.append("no file was compared")
        outcome = "failed" if failed else "different" if notes else "identical"
        return CaseResult(case.name, outcome, compared.files, compared.masked, notes=notes)

    def complaint(self, case, number):
        with open(os.path.join(self.folder("base", case.name), f"stderr_{number}.txt"), encoding="utf-8", errors="replace") as file:
            return (file.read().strip().splitlines() or ["nothing on standard error"])[-1][:300]

    def place_on(self, case, side, to):
        return os.path.join(self.folder(side, case.name), self.renames.present_path(to) if side == "present" else to)

    def stamp(self, case, side, to):
        """Names, sizes and times of what was copied."""
        path = self.place_on(case, side, to)
        found = [path] if os.path.isfile(path) else [os.path.join(r, f) for r, _, names in os.walk(path) for f in names]
        return sorted((p, os.path.getsize(p), os.stat(p).st_mtime_ns) for p in found)

    def copy(self, case, step):
        source_case, _, path = step.output.partition("/")
        own = self.outcomes[source_case] == "identical"
        for side in SIDES:
            source_side = side if own else "base"
            if source_side == "present":
                path_there = self.renames.present_path(path)
            else:
                path_there = path
            source = os.path.join(self.folder(source_side, source_case), path_there)
            target = self.place_on(case, side, step.to)
            os.makedirs(os.path.dirname(target), exist_ok=True)
            shutil.copytree(source, target) if os.path.isdir(source) else shutil.copyfile(source, target)
        return {side: self.stamp(case, side, step.to) for side in SIDES}

    def run_command(self, case, step, number):
        """Both programs at the same time, each on half of the cores. Their exit codes."""
        arguments = [self.filled_in(word) for word in shlex.split(step.line)]
        running = {}
        for side in SIDES:
            words = self.renames.present_arguments(arguments) if side == "present" else arguments
            folder = self.folder(side, case.name)
            cores = self.cores[side]
            with open(os.path.join(folder, f"stdout_{number}.txt"), "wb") as out, \
                    open(os.path.join(folder, f"stderr_{number}.txt"), "wb") as err:
                running[side] = subprocess.Popen([self.programs[side]] + words, cwd=folder, stdin=subprocess.DEVNULL,
                                                 stdout=out, stderr=err,
                                                 preexec_fn=lambda cores=cores: os.sched_setaffinity(0, cores))
        return {side: self.exit_code(process) for side, process in running.items()}

    @staticmethod
    def exit_code(process):
        try:
            return process.wait(timeout=TIME_LIMIT_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            return "none within the time limit"
