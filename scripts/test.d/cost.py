#!/usr/bin/python3
"""cost.py reference | run FILE COMMAND... | check BUILD...: keeps the checks light.

reference      compiles reference.cpp and runs it, and prints the CPU seconds of both
run FILE ...   runs a command, ends with its exit code, and writes the CPU seconds of it and of all its children to FILE,
               and behind them those of the reference program before and after it, if `reference` has compiled that
check BUILD... compares with budget.txt, in units of the reference program of the machine that did the work:
               compile  all objects of the build folders, each as it cost when it was compiled last (cmake/compile_cost.sh),
                        also where the compiler cache saved it this time
               tests    the quick tests, as scripts/test measured them in the first folder (cost.quick), with the speed
                        that the machine had then: others on it slow it down and leave
               Exits 1 if one is more than its budget, 2 if too little is known to tell.
"""

import json
import os
import pathlib
import resource
import shlex
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
COSTS = pathlib.Path(os.environ.get("PLACEGRAPH_COSTS") or pathlib.Path.home() / ".cache/placegraph_costs")
PROGRAM = COSTS / "reference_program"
LEAST_KNOWN = 0.9  # share of the objects of which the cost must be known


def cpu_seconds(command, **options):
    """The CPU seconds of a command and of the children it waited for, and its exit code."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    code = subprocess.run(command, check=False, **options).returncode
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, code


def reference():
    """The CPU seconds of the reference program's compilation, and of one run."""
    COSTS.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=COSTS) as folder:
        program = pathlib.Path(folder) / "reference"
        compile_s, code = cpu_seconds(["g++", "-std=c++20", "-O2", "-I/usr/include/eigen3", "-o", program,
                                       str(HERE / "reference.cpp")])
        if code:
            raise SystemExit(f"cost.py: {HERE / 'reference.cpp'} does not compile")
        program.replace(PROGRAM)
    return compile_s, reference_run()


def reference_run():
    """The CPU seconds of the compiled reference program; the least of three runs."""
    return min(cpu_seconds([PROGRAM], stdout=subprocess.DEVNULL)[0] for _ in range(3))


def objects_of(build):
    """The objects that lie in a build folder, as paths relative to it."""
    with open(build / "compile_commands.json", encoding="utf-8") as file:
        commands = [shlex.split(entry["command"]) for entry in json.load(file)]
    outputs = {command[command.index("-o") + 1] for command in commands}
    return sorted(output for output in outputs if (build / output).exists())


def compile_cost(builds, compile_s):
    """Cost of all objects in compilations of the reference program, those known and their number."""
    cost, known, count = 0.0, 0, 0
    for build in builds:
        for output in objects_of(build):
            count += 1
            note = COSTS / build.name / output.replace("/", "%")
            if note.is_file():
                seconds, then = map(float, note.read_text().split())
                cost += seconds / (then or compile_s)
                known += 1
    return cost, known, count


def check(builds):
    budget = {}
    for line in (HERE / "budget.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            name, value = line.split()
            budget[name] = float(value)
    compile_s, run_s = reference()
    cost, known, count = compile_cost(builds, compile_s)
    if known < LEAST_KNOWN * count or not count:
        print(f"cost: compile: known of {known} of {count} objects only; an empty compiler cache tells all")
        code = 2
    else:
        cost *= count / known
        code = int(cost > budget["compile"])
        print(f"cost: compile: {cost:.0f} reference compilations ({compile_s:.1f} CPU s each), "
              f"{budget['compile']:.0f} allowed")
    tests = builds[0] / "cost.quick"
    if not tests.is_file():
        print("cost: tests: not measured; scripts/test does it")
        return code or 2
    seconds, *then = map(float, tests.read_text().split())
    run_s = sum(then) / len(then) if then else run_s
    cost = seconds / run_s
    print(f"cost: tests: {cost:.0f} runs of the reference program ({run_s:.2f} CPU s each), {budget['tests']:.0f} allowed")
    return 1 if cost > budget["tests"] else code


def main():
    if sys.argv[1:] == ["reference"]:
        print("%.2f %.3f" % reference())
        return 0
    if sys.argv[1:2] == ["run"] and len(sys.argv) > 3:
        speeds = [reference_run()] if PROGRAM.exists() else []
        seconds, code = cpu_seconds(sys.argv[3:])
        if speeds:
            speeds.append(reference_run())
        pathlib.Path(sys.argv[2]).write_text(f"{seconds:.1f}{''.join(f' {s:.3f}' for s in speeds)}\n")
        return code
    if sys.argv[1:2] == ["check"] and len(sys.argv) > 2:
        return check([pathlib.Path(build) for build in sys.argv[2:]])
    print(__doc__.splitlines()[0], file=sys.stderr)
    return 2


sys.exit(main())
