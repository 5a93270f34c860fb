"""The fixed set of commands, in the old spelling (renamed.txt has the new one).

cases_run.py       worlds, and runs over them
cases_map.py       what is asked of a finished map
cases_graph.py     pose graphs, bundle adjustment, the earth, file forms
cases_image.py     single images, image pairs, places, training
cases_data.py      research data
"""
import cases_data
import cases_graph
import cases_image
import cases_map
import cases_run
from case import Case

COMMANDS = """
bundle; config; convert; eval; eval-edges; explain; flow; georeference; hover; lines; lines detect; lines match; lines track;
localize; loops; map; map export; map info; map label; map learn; map plan; map semantic; map validate; markers;
markers detect; match; motion; optimize; places; places classify; planes; planes two-view; route; run; scene; scene check;
scene label; scene orientation; scene popup; scene surfaces; synth; synth-graph; track-plane; train; train environment;
train planarity; train surfaces; train urban; vanishing; vocabulary; vocabulary info; vocabulary train
"""

HELP = [
    Case("help", "the help of every command, the version", tuple(
        ["--help", "--version"] + [name.strip() + " --help" for name in COMMANDS.split(";")]), quick=True),
    Case("config", "every option of run and hover with its default, as YAML, Markdown and a list", (
        "config --dump --out run.yaml",
        "config --dump --of hover --out hover.yaml",
        "config --markdown --out options.md",
        "config --set seed=5 --set max_frames=7 --dump",
        "config"), quick=True),
]


def all_cases():
    """In an order in which every case comes after those that it needs."""
    cases = HELP + cases_run.CASES + cases_map.CASES + cases_graph.CASES + cases_image.CASES + cases_data.CASES
    seen = set()
    for case in cases:
        missing = [name for name in case.needs() if name not in seen]
        if missing or case.name in seen:
            raise ValueError(f"case {case.name}: " + (f"stands before {missing[0]}" if missing else "stands twice"))
        seen.add(case.name)
    return cases
