"""exports_check.py PROGRAM FOLDER: what the program writes, read by evo, gtsam and networkx; by others in exports_geometry.py and exports_dense.py.

Beside that the figures of evo, epica and slam-regression-ci on the same trajectories (exports_evaluation.py, exports_epica.py, exports_slam_regression.py), and a recognizer of others (exports_recognizer.py).

Renders and runs small sequences in FOLDER. Prints one line a check; exits 1 where one fails.
"""

import json
import os
import pathlib
import subprocess
import sys

os.environ.setdefault("HOME", sys.argv[2])  # evo writes its settings there

import gtsam
import networkx
import numpy
from evo import main_ape
from evo.core import metrics
from evo.tools import file_interface
from exports_dense import check_bundle, check_dense
from exports_epica import check_epica
from exports_evaluation import check_evaluation
from exports_geometry import check_geometry, package
from exports_recognizer import check_recognizer
from exports_slam_regression import check_slam_regression

FRAMES = 40
failures = 0


def check(name, right, found=""):
    global failures
    failures += not right
    print(f"  {'right' if right else 'WRONG'}: {name}" + (f" ({found})" if found != "" and not right else ""))


def close(a, b, tolerance):
    return abs(a - b) <= tolerance * max(1.0, abs(b))


class Program:
    def __init__(self, path, folder):
        self.path, self.folder = path, pathlib.Path(folder)

    def __call__(self, *arguments):
        """Standard output of a command that ends well."""
        done = subprocess.run([self.path, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"exports_check: {' '.join(map(str, arguments))}: exit code {done.returncode}: {done.stderr.strip()}")
        return done.stdout

    def at(self, name):
        return str(self.folder / name)


def write_runs(placegraph):
    """A drive by two eyes, and by one eye that knows no scale."""
    placegraph("synth", "sequence", "town-loop", "--frames", FRAMES, "--stereo", "--size", "448x280", "--difficulty", "clean", "--out", "drive")
    placegraph("run", "drive", "--out", "stereo")
    os.remove(placegraph.at("drive/world.yaml"))  # it tells the camera's height
    placegraph("run", "drive", "--sensor", "mono", "--out", "mono")


def check_trajectories(placegraph):
    kitti = file_interface.read_kitti_poses_file(placegraph.at("stereo/trajectory_optimized.kitti"))
    tum = file_interface.read_tum_trajectory_file(placegraph.at("stereo/trajectory_optimized.tum"))
    check("evo reads every pose of KITTI's form", kitti.num_poses == FRAMES, kitti.num_poses)
    check("evo reads every pose of TUM's form", tum.num_poses == FRAMES, tum.num_poses)
    check("the two are the same positions", numpy.allclose(kitti.positions_xyz, tum.positions_xyz, atol=1e-6))
    check("rotations are rotations to evo", kitti.check()[0], kitti.check()[1])
    placegraph("graph", "convert", "stereo/trajectory_optimized.tum", "euroc.csv")
    euroc = file_interface.read_euroc_csv_trajectory(placegraph.at("euroc.csv"))
    check("evo reads EuRoC's form", numpy.allclose(euroc.positions_xyz, tum.positions_xyz, atol=1e-6) and numpy.allclose(euroc.timestamps, tum.timestamps, atol=1e-6))
    truth = file_interface.read_kitti_poses_file(placegraph.at("drive/poses.txt"))
    ape = metrics.APE(metrics.PoseRelation.translation_part)
    ape.process_data((truth, kitti))
    told = json.loads(placegraph("eval", "drive/poses.txt", "stereo/trajectory_optimized.kitti", "--align", "none", "--json"))
    check("evo's error is that of eval", close(ape.get_statistic(metrics.StatisticsType.rmse), told["ate_rmse_m"], 1e-6))


def check_results_of_evo(placegraph):
    """Archives of both directions: what eval writes is evo's own result, and what evo writes is tabled."""
    pair = ("drive/poses.txt", "stereo/trajectory_optimized.kitti")
    placegraph("eval", *pair, "--align", "se3", "--evo-results", "ours.zip")
    ours = file_interface.load_res_file(placegraph.at("ours.zip"), load_trajectories=True)
    truth, estimate = (file_interface.read_kitti_poses_file(placegraph.at(file)) for file in pair)
    own = main_ape.ape(truth, estimate, metrics.PoseRelation.translation_part, align=True)
    check("evo reads the statistics of --evo-results", all(close(ours.stats[name], value, 1e-6) for name, value in own.stats.items()), ours.stats)
    check("evo reads the errors of --evo-results", numpy.allclose(ours.np_arrays["error_array"], own.np_arrays["error_array"], atol=1e-6))
    check("title and label are evo's", all(ours.info[name] == own.info[name] for name in ("title", "label")), ours.info)
    check("the alignment is evo's", numpy.allclose(ours.np_arrays["alignment_transformation_sim3"], own.np_arrays["alignment_transformation_sim3"], atol=1e-6))
    check("evo reads both trajectories of --evo-results", sorted(each.num_poses for each in ours.trajectories.values()) == [FRAMES, FRAMES])
    own.info["ref_name"], own.info["est_name"] = "gt/drive.kitti", "runs/stereo.kitti"
    file_interface.save_res_file(placegraph.at("theirs.zip"), own)
    table = json.loads(placegraph("eval", "table", "theirs.zip", "--figures", ",".join(f"ape_m_{name}" for name in own.stats), "--json"))
    values = [cell["value"] for cell in table["rows"][0]["cells"]]
    check("eval table has evo's statistics to the bit", values == list(own.stats.values()), values)
    check("eval table has evo's names", table["rows"][0]["name"] == "drive" and table["caption"] == "stereo", table["rows"])


def check_lost_frames(placegraph):
    lines = pathlib.Path(placegraph.at("stereo/trajectory_optimized.kitti")).read_text().splitlines(True)
    for lost in (3, 4, 20):
        lines[lost] = " ".join(["nan"] * 12) + "\n"
    pathlib.Path(placegraph.at("lost.kitti")).write_text("".join(lines))
    placegraph("graph", "convert", "lost.kitti", "posed.kitti", "--posed-only")
    placegraph("graph", "convert", "drive/poses.txt", "truth.kitti", "--posed-in", "lost.kitti")
    posed = file_interface.read_kitti_poses_file(placegraph.at("posed.kitti"))
    truth = file_interface.read_kitti_poses_file(placegraph.at("truth.kitti"))
    check("evo reads what has no lost frames", posed.num_poses == truth.num_poses == FRAMES - 3 and posed.check()[0])


def read_by_gtsam(path, in_space):
    """The graph, its start, and twice the error there: the sum of e^T Omega e."""
    graph, start = gtsam.readG2o(path, in_space)
    return graph, start, 2 * graph.error(start)


def positions(graph_file):
    """Of a graph in space, by vertex."""
    _, poses, _ = read_by_gtsam(graph_file, True)
    return numpy.array([poses.atPose3(key).translation() for key in sorted(poses.keys())])


def check_map_exports(placegraph):
    placegraph("map", "export", "mono", "--g2o-se3", "map_se3.g2o", "--tum", "map.tum", "--kitti", "map.kitti", "--graphml", "map.graphml")
    placegraph("graph", "convert", "mono/graph.g2o", "rigid.g2o", "--rigid")
    se3 = positions(placegraph.at("mono/graph_se3.g2o"))
    check("map export --g2o-se3 is that graph, too", numpy.allclose(positions(placegraph.at("map_se3.g2o")), se3, atol=1e-9))
    check("and convert --rigid", numpy.allclose(positions(placegraph.at("rigid.g2o")), se3, atol=1e-9))
    kitti, tum = file_interface.read_kitti_poses_file(placegraph.at("map.kitti")), file_interface.read_tum_trajectory_file(placegraph.at("map.tum"))
    check("evo reads the trajectories of map export", numpy.allclose(kitti.positions_xyz, tum.positions_xyz, atol=1e-6))
    of_map, of_run = (networkx.read_graphml(placegraph.at(name)) for name in ("map.graphml", "mono/places.graphml"))
    check("networkx reads the places of map export", sorted(of_map.edges) == sorted(of_run.edges) and of_map.number_of_nodes() > 0)


def count(path, tag):
    return sum(line.startswith(tag) for line in open(path))


def check_graphs(placegraph):
    for name in ("stereo/graph.g2o", "mono/graph_se3.g2o"):
        path = placegraph.at(name)
        graph, start, _ = read_by_gtsam(path, True)
        check(f"gtsam reads {name}", graph.size() == count(path, "EDGE_") > 0 and start.size() == count(path, "VERTEX_"), f"{graph.size()} factors, {start.size()} poses")
    check("the scales of one eye are in graph.g2o", count(placegraph.at("mono/graph.g2o"), "VERTEX_SIM3") > 0)
    for world, in_space in (("grid-world", True), ("manhattan-walk", False)):
        placegraph("synth", "graph", world, "--poses", 200, "-o", world + ".g2o")
        told = json.loads(placegraph("optimize", world + ".g2o", "-o", world + "_optimized.g2o", "--json", "--quiet"))
        _, _, before = read_by_gtsam(placegraph.at(world + ".g2o"), in_space)
        _, _, after = read_by_gtsam(placegraph.at(world + "_optimized.g2o"), in_space)
        for when, error, of_ours in (("before", before, told["chi2_log_initial"]), ("after", after, told["chi2_log"])):
            check(f"gtsam's error of {world} {when} optimization is chi2_log", close(error, of_ours, 1e-6), f"{error} and {of_ours}")


def check_places(placegraph):
    places = json.load(open(placegraph.at("stereo/places.json")))
    count_of_places = len(places["places"])
    graphml = networkx.read_graphml(placegraph.at("stereo/places.graphml"))
    check("networkx reads the places of GraphML", graphml.number_of_nodes() == count_of_places, graphml.number_of_nodes())
    check("they hang together", networkx.is_connected(graphml.to_undirected()))
    dot = networkx.nx_pydot.read_dot(placegraph.at("stereo/places.dot"))
    nodes = [n for n in dot.nodes if n not in ("\\n", "node", "edge", "graph")]
    check("and those of Graphviz", len(nodes) == count_of_places, len(nodes))


def main():
    placegraph = Program(sys.argv[1], sys.argv[2])
    write_runs(placegraph)
    check_trajectories(placegraph)
    check_evaluation(placegraph, check)
    check_epica(placegraph, check)
    check_slam_regression(placegraph, check)
    check_results_of_evo(placegraph)
    check_lost_frames(placegraph)
    check_graphs(placegraph)
    check_places(placegraph)
    check_map_exports(placegraph)
    check_geometry(placegraph, check, "stereo", "drive")
    if pycolmap := package("pycolmap"):
        check_bundle(placegraph, check, pycolmap, "model")
    check_dense(placegraph, check, package)
    check_recognizer(placegraph, check)
    print(f"exports_check: {'FAILED: ' + str(failures) + ' checks' if failures else 'passed'}")
    return 1 if failures else 0


sys.exit(main())
