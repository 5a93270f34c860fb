"""The command line of scripts/same_bits."""
import argparse
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import build
from cases import all_cases
from masks import read_masks
from renames import read_renames
from run_case import Runner

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
MOST_NOTES = 5


def parse(arguments):
    parser = argparse.ArgumentParser(prog="scripts/same_bits", description="Compares what two revisions of placegraph compute, bit by bit.")
    parser.add_argument("base", metavar="BASE", nargs="?", help="git revision to compare with")
    parser.add_argument("--quick", action="store_true", help="a subset of small cases")
    parser.add_argument("--case", action="append", default=[], metavar="NAME", help="this case alone, with those that it needs")
    parser.add_argument("--list", action="store_true", help="print the cases")
    parser.add_argument("--base-program", metavar="P", help="a ready program of BASE")
    parser.add_argument("--program", metavar="P", help="a ready program of the present tree")
    parser.add_argument("--data", metavar="DIR", help="research data; default: PLACEGRAPH_DATA, or ../shared/data")
    parser.add_argument("--out", metavar="DIR", default=os.path.join(ROOT, "out", "same_bits"), help="default: out/same_bits")
    chosen = parser.parse_args(arguments)
    if not chosen.list and not chosen.base:
        parser.error("BASE is needed")
    for path in (chosen.base_program, chosen.program):
        if path and not os.access(path, os.X_OK):
            parser.error(f"{path}: is no program")
    if chosen.data and not os.path.isdir(chosen.data):
        parser.error(f"{chosen.data}: is no folder")
    chosen.out = os.path.abspath(chosen.out)
    return chosen


def selected(cases, chosen):
    """The cases to run, with those that they need, in the order of the table."""
    by_name = {case.name: case for case in cases}
    unknown = [name for name in chosen.case if name not in by_name]
    if unknown:
        raise build.BuildError(f"{unknown[0]}: is no case (see --list)")
    wanted = list(chosen.case) or [case.name for case in cases if case.quick or not chosen.quick]
    needed = set()
    while wanted:
        name = wanted.pop()
        if name not in needed:
            needed.add(name)
            wanted += by_name[name].needs()
    return [case for case in cases if case.name in needed]


def data_folder(chosen):
    data = os.path.abspath(chosen.data or os.environ.get("PLACEGRAPH_DATA") or os.path.join(ROOT, "..", "shared", "data"))
    return data if os.path.isdir(data) else None


def report(result):
    word = {"different": "DIFFERENT", "failed": "FAILED"}.get(result.outcome, result.outcome)
    print(f"{result.name:28} {result.files:5} files  {word:10} {result.seconds:7.1f} s", flush=True)
    for note in result.notes[:MOST_NOTES]:
        print(f"    {note}", flush=True)
    if len(result.notes) > MOST_NOTES:
        print(f"    and {len(result.notes) - MOST_NOTES} more", flush=True)


def summary(results, seconds):
    count = lambda outcome: sum(result.outcome == outcome for result in results)
    files = sum(result.files for result in results)
    print(f"{len(results)} cases: {count('identical')} identical, {count('different')} different, {count('failed')} failed, "
          f"{count('skipped')} skipped; {files} files compared, {sum(r.masked for r in results)} values masked; {seconds:.0f} s, "
          f"{sum(r.cpu_s for r in results):.0f} s CPU of both programs")
    if count("different") or count("failed"):
        return 1
    if not count("identical") or not files:
        print("nothing was compared")
        return 1
    return 0


def main(arguments, cases=None, renamed=os.path.join(HERE, "renamed.txt")):
    chosen = parse(arguments)
    cases = all_cases() if cases is None else cases
    if chosen.list:
        for case in cases:
            print(f"{case.name:28} {'quick' if case.quick else '     '}  {case.about}")
        return 0
    try:
        run_these = selected(cases, chosen)
        masks = read_masks(os.path.join(HERE, "masked.txt"))
        renames = read_renames(renamed)
        os.makedirs(chosen.out, exist_ok=True)
        base = chosen.base_program or build.build_base(ROOT, chosen.out, chosen.base)
        present = chosen.program or build.build(ROOT, os.path.join(chosen.out, "present.log"))
    except (build.BuildError, ValueError, OSError) as error:  # bad use, or a build that fails
        print(f"scripts/same_bits: {error}", file=sys.stderr)
        return 2
    begin = time.monotonic()
    runner = Runner([os.path.abspath(base), os.path.abspath(present)], chosen.out, data_folder(chosen), masks, renames)
    results = []
    for case in run_these:
        results.append(runner.run(case))
        report(results[-1])
    return summary(results, time.monotonic() - begin)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
