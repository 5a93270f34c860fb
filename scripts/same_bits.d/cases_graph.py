"""Pose graphs, bundle adjustment, the earth, file forms."""
import inputs
from case import Case, Copy, Make, Run

STARTS = ("auto", "file", "odometry", "chordal", "certified")
ROBUST = ("none", "huber", "dcs", "gnc", "pcm", "auto")


def optimize(graph, name, options=""):
    return f"optimize {graph} -o {name}.g2o --json --quiet {options}"


CASES = [
    Case("graphs_small", "rendered graphs in the plane and in space, with false loops, in a random order", (
        "synth-graph manhattan-walk --poses 300 -o walk.g2o",
        "synth-graph manhattan-walk --poses 300 --false-loops 20 --shuffle --seed 4 -o false.g2o",
        "synth-graph grid-world --poses 216 -o grid.g2o",
        "synth-graph long-loop --poses 200 --closures 5 --laps 2 -o loop.g2o",
        "synth-graph long-loop --poses 200 --closures 5 --3d -o loop3d.g2o"), quick=True),
    Case("optimize_small", "small graphs by every initialization; plot; a second opinion", tuple(
        [optimize("{graphs_small}/walk.g2o", f"walk_{start}", f"--start {start}") for start in STARTS]
        + [optimize("{graphs_small}/grid.g2o", f"grid_{start}", f"--start {start}") for start in STARTS]
        + [optimize("{graphs_small}/grid.g2o", "grid_ceres", "--engine ceres"),
           "optimize {graphs_small}/walk.g2o -o plotted.g2o --cost g2o --plot plotted.png",
           "optimize {graphs_small}/loop.g2o -o certified.g2o --certify"]), quick=True),
    Case("robust_small", "a small graph with false loops by every robust method", tuple(
        [optimize("{graphs_small}/false.g2o", f"false_{method}", f"--robust {method}") for method in ROBUST]
        + ["optimize {graphs_small}/false.g2o -o kept.g2o --robust gnc --drop-rejected --plot kept.svg"]), quick=True),
    Case("incremental_small", "small graphs that grow pose by pose", (
        optimize("{graphs_small}/walk.g2o", "walk", "--incremental"),
        "optimize {graphs_small}/loop3d.g2o -o loop3d.g2o --incremental"), quick=True),
    Case("graphs_large", "larger rendered graphs; one made harder", (
        "synth-graph manhattan-walk --poses 5000 --seed 2 -o walk.g2o",
        "synth-graph grid-world --poses 2000 --seed 2 -o grid.g2o",
        "synth-graph long-loop --poses 2000 --closures 20 --laps 3 --3d --seed 2 -o loop3d.g2o",
        "synth-graph walk.g2o --rotation-noise 0.02 -o harder.g2o",
        "synth-graph grid.g2o --false-loops 100 -o false.g2o")),
    Case("optimize_large", "larger graphs by every initialization", tuple(
        [optimize("{graphs_large}/harder.g2o", f"harder_{start}", f"--start {start}") for start in STARTS if start != "file"]
        + [optimize("{graphs_large}/loop3d.g2o", f"loop3d_{start}", f"--start {start}") for start in STARTS])),
    Case("robust_large", "a larger graph with false loops by every robust method", tuple(
        optimize("{graphs_large}/false.g2o", f"false_{method}", f"--robust {method}") for method in ROBUST)),
    Case("incremental_large", "larger graphs that grow pose by pose", (
        optimize("{graphs_large}/walk.g2o", "walk", "--incremental"),
        optimize("{graphs_large}/loop3d.g2o", "loop3d", "--incremental"))),
    Case("optimize_map", "the place graph of a run", (
        Copy("run_rounds/run", "run"),
        optimize("run/graph.g2o", "log"),
        optimize("run/graph.g2o", "ceres", "--engine ceres --cost g2o"))),
    Case("graph_usage", "what optimize refuses", (
        Make(inputs.texts, "broken", ("bad.g2o", "VERTEX_SE2 0 0 0\n", "empty.g2o", "",
                                      "apart.g2o", "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_SE2 2 5 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n")),
        Run("optimize {inputs}/broken/bad.g2o -o out.g2o", exits=2),
        Run("optimize {inputs}/broken/empty.g2o -o out.g2o", exits=2),
        Run("optimize {inputs}/broken/apart.g2o -o out.g2o", exits=2)), quick=True),
    Case("convert", "forms of trajectories and of pose graphs", (
        Make(inputs.small_graphs, "graphs"),
        "convert {render_town40}/world/poses.txt poses.tum --times {render_town40}/world/times.txt",
        "convert poses.tum poses.csv",
        "convert poses.csv poses.kitti",
        "convert {inputs}/graphs/toro.graph toro.g2o",
        "convert {inputs}/graphs/isam.txt isam.g2o",
        "convert {graphs_small}/grid.g2o grid.kitti",
        Run("convert {render_town40}/world/poses.txt timeless.tum", exits=2)), quick=True),
    Case("bundle", "bundle adjustment of a small problem, with and without a robust kernel", (
        Make(inputs.bundle, "bundle.txt"),
        "bundle {inputs}/bundle.txt -o plain.txt --json",
        "bundle {inputs}/bundle.txt -o huber.txt --kernel huber --kernel-width 2"), quick=True),
    Case("georeference", "a graph on the earth: clock and lever arm known, and estimated", (
        Make(inputs.circle_on_earth, "earth"),
        "georeference {inputs}/earth/graph.g2o --times {inputs}/earth/times.txt --gps {inputs}/earth/oxts.txt --origin 49,8.4,115 --out plain",
        "georeference {inputs}/earth/graph.g2o --times {inputs}/earth/times.txt --gps {inputs}/earth/oxts.txt --json "
        "--lever-arm estimate --clock-offset estimate --set lever_arm_sigma_m=1 --out estimated"), quick=True),
]
