"""random_streams_selftest.py LINT: it finds what is planted."""
import pathlib
import subprocess
import sys
import tempfile

GOOD = 'Random random(seed_, "rotation", {frame.value()});\n'
PLANTED = {
    GOOD: None,
    GOOD + 'Random random(seed_, "scale", {frame.value()});\nRandom other(options.seed, i);\n': None,
    "Random random(seed_, static_cast<std::uint64_t>(frame.value()));\n": "pipeline/a.cpp:1: the stream has no name",
    GOOD + GOOD: 'pipeline/a.cpp:2: pipeline/a.cpp:1 has the name "rotation", too',
}

for source, expected in PLANTED.items():
    with tempfile.TemporaryDirectory() as root:
        (pathlib.Path(root) / "pipeline").mkdir()
        (pathlib.Path(root) / "pipeline/a.cpp").write_text(source, encoding="utf-8")
        run = subprocess.run([sys.executable, sys.argv[1], root], capture_output=True, text=True, check=False)
        if (run.returncode != 0) != (expected is not None) or (expected or "") not in run.stdout:
            sys.exit(f"random_streams_selftest: {source!r}: {run.returncode} {run.stdout} {run.stderr}")
