"""Rendered worlds, and runs over them."""
import inputs
from case import Case, Make, Run

SMALL = "--size 448x280 --difficulty clean"
HALF = "--size 620x188 --difficulty standard --stereo"

WORLDS = [
    Case("render_town40", "40 frames of the town, small: stereo, depth, labels, flow", (
        f"synth town-loop --frames 40 --stereo --depth --labels --flow {SMALL} --out world",), quick=True),
    Case("render_corridor40", "40 frames of the corridor, small: stereo, depth, labels", (
        f"synth corridor-loop --frames 40 --stereo --labels {SMALL} --out world",), quick=True),
    Case("render_flight4", "a flight of four seconds, with flow", (
        "synth hover --duration 4 --seed 6 --flow --out world",), quick=True),
    Case("render_town", "200 frames of the town: stereo, depth, labels", (
        "synth town-loop --frames 200 --stereo --depth --labels --difficulty standard --out world",)),
    Case("render_hard", "30 frames of another town, hard: traffic, bad light; and of the street of equal blocks", (
        "synth town-loop --frames 30 --seed 3 --difficulty hard --size 620x188 --out town",
        "synth repeated-blocks --frames 30 --difficulty hard --size 620x188 --out blocks")),
    Case("render_corridor", "150 frames of the corridor: stereo, depth, floor plan", (
        "synth corridor-loop --frames 150 --stereo --difficulty standard --out world",)),
    Case("render_warehouse", "100 frames of the warehouse: stereo, depth, floor plan", (
        "synth warehouse --frames 100 --seed 5 --stereo --difficulty standard --out world",)),
    Case("render_rounds", "two rounds about a block, from a file of poses", (
        Make(inputs.rounds, "rounds.txt", (2,)),
        f"synth {{inputs}}/rounds.txt {HALF} --out world")),
    Case("render_rounds_mono", "the same in another light, one eye: to be localized", (
        "synth {inputs}/rounds.txt --size 620x188 --difficulty hard --mono --frames 60 --out world",)),
    Case("render_turn", "a drive that turns on the spot", (
        Make(inputs.turning, "turn.txt"),
        f"synth {{inputs}}/turn.txt {SMALL} --mono --out world")),
    Case("render_flight", "a flight of 20 seconds", (
        "synth hover --duration 20 --seed 2 --difficulty standard --out world",)),
    Case("synth_usage", "what synth refuses", (
        Run("synth atlantis --out out", exits=2),
        Run("synth town-loop --out out --size 96", exits=2),
        Run("synth", exits=2)), quick=True),
]

QUICK_RUNS = [
    Case("run_town40_stereo", "two eyes; log, drawings of the frames", (
        "run {render_town40}/world --sensor stereo --draw drawn --verbose --out run",), quick=True),
    Case("run_town40_mono", "one eye of known height", (
        "run {render_town40}/world --sensor mono --camera-height 1.65 --out run --json",), quick=True),
    Case("run_corridor40_rgbd", "a depth camera; places by the rooms of the floor plan", (
        "run {render_corridor40}/world --sensor rgbd --scene geometry --out run",), quick=True),
    Case("run_corridor40_lines", "lines alone", (
        "run {render_corridor40}/world --sensor stereo --cues lines --no-loops --out run",), quick=True),
    Case("run_town40_resumed", "a run that a broken image ended goes on when the image is whole again", (
        Make(inputs.damaged, "damaged40", ("{render_town40}/world", "image_0/000025.png")),
        Run("run {inputs}/damaged40 --sensor stereo --out run", exits=2),
        "map info run --json",
        Run("run {inputs}/damaged40 --sensor stereo --out run", exits=2),
        Make(inputs.mended, "damaged40", ("{render_town40}/world", "image_0/000025.png")),
        "run --resume run --json",
        "map validate run"), quick=True),
    Case("hover4", "a short flight", (
        "hover {render_flight4}/world --out hover",), quick=True),
    Case("run_usage", "what run refuses; a sequence that allows no answer", (
        Run("run", exits=2),
        Run("run nowhere --out run", exits=2),
        Run("run {render_town40}/world --cues points,colour --out run", exits=2),
        Run("run {render_town40}/world --set no.such=1 --out run", exits=2)), quick=True),
]

RUNS = [
    Case("run_town_stereo", "two eyes", (
        "run {render_town}/world --sensor stereo --out run",)),
    Case("run_town_mono", "one eye of known height", (
        "run {render_town}/world --sensor mono --camera-height 1.65 --out run",)),
    Case("run_town_mono_unscaled", "one eye, nothing gives the metre", (
        "run {render_town}/world --sensor mono --set max_frames=80 --cues points --out run",)),
    Case("run_town_rgbd", "a depth camera", (
        "run {render_town}/world --sensor rgbd --out run",)),
    Case("run_town_profile", "the table of the stages", (
        "run {render_town40}/world --sensor stereo --profile --out run",)),
    Case("run_seed_threads", "another seed, one thread, options from a file", (
        "config --dump --set seed=9 --set max_frames=30 --out my.yaml",
        "run {render_town40}/world --sensor stereo --config my.yaml --out file",
        "run {render_town40}/world --sensor stereo --seed 9 --threads 1 --out run",)),
    Case("run_direct", "intensities of planes, one eye", (
        "run {render_town40}/world --sensor mono --camera-height 1.65 --cues direct --no-loops --out run",)),
    Case("run_corridor_lines", "corridor by lines alone, one eye and two", (
        "run {render_corridor}/world --sensor stereo --cues lines --no-loops --out stereo",
        "run {render_corridor}/world --sensor mono --cues lines --no-loops --set max_frames=60 --out mono")),
    Case("run_corridor_all_cues", "all cues at once, two eyes", (
        "run {render_corridor}/world --sensor stereo --cues points,lines,plane,manhattan,direct --set max_frames=100 --out run",)),
    Case("run_town_all_cues", "all cues at once, one eye", (
        "run {render_town}/world --sensor mono --camera-height 1.65 --cues points,lines,plane,manhattan,direct "
        "--set max_frames=60 --out run",)),
    Case("run_elements", "what navigation is made of: motion, context and semantics", (
        "run {render_corridor}/world --sensor rgbd --elements motion,spatial,context,semantics --set max_frames=60 --out run",)),
    Case("run_rounds", "loops and places that merge, two eyes", (
        "run {render_rounds}/world --sensor stereo --out run",)),
    Case("run_rounds_mono", "loops of one eye of known height", (
        "run {render_rounds}/world --sensor mono --camera-height 1.65 --out run",)),
    Case("run_rounds_lines", "loops with points and lines", (
        "run {render_rounds}/world --sensor stereo --cues points,lines --out run",)),
    Case("run_turn", "pure rotation", (
        "run {render_turn}/world --sensor mono --camera-height 1.65 --out run",)),
    Case("run_odometry", "motion by other sensors", (
        "convert {render_town}/world/poses.txt wheels.tum --times {render_town}/world/times.txt",
        "run {render_town}/world --sensor mono --odometry wheels.tum --set max_frames=80 --out run")),
    Case("run_hard", "traffic and bad light, one eye; masks", (
        "run {render_hard}/town --sensor mono --camera-height 1.65 --scene none --out town",
        "run {render_hard}/town --sensor mono --camera-height 1.65 --elements motion,spatial,semantics --out masked")),
    Case("hover_flight", "a flight: filter, smoother, prediction, blind spans, without markers, markers that are mapped", (
        Make(inputs.first_marker, "first_marker.yaml", ("{render_flight}/world/markers.yaml",)),
        "hover {render_flight}/world --out plain",
        "hover {render_flight}/world --out smooth --smooth --json",
        "hover {render_flight}/world --out ahead --predict-ahead-ms 100",
        "hover {render_flight}/world --out blind --blind 3:6 --markers-until 15",
        "hover {render_flight}/world --out truth --no-markers --start-from-truth",
        "hover {render_flight}/world --out mapped --markers {inputs}/first_marker.yaml --map-markers "
        "--true-markers {render_flight}/world/markers.yaml")),
    Case("hover_profile", "the table of the stages of a flight", (
        "hover {render_flight4}/world --profile --out hover",)),
]

CASES = WORLDS + QUICK_RUNS + RUNS
