"""Wrong input of evaluation, place recognition and single functions: errors name the argument."""

import pathlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from checks import wrong

import placegraph as pg
from placegraph import loops, vision

GREY = np.random.default_rng(0).integers(0, 255, (120, 160)).astype(np.uint8)
COLOUR = np.stack([GREY] * 3, -1)
FLOW = np.zeros((120, 160, 2), np.float32)
CAMERA = pg.Camera(160, 120, 100, 100, 79.5, 59.5)
PX = np.random.default_rng(1).uniform(0, 100, (40, 2))
XYZ = np.random.default_rng(2).uniform(1, 5, (40, 3))
NAN = np.full((40, 2), np.nan)
SEGMENTS = np.c_[PX, PX + 20]
QUAD = [[20, 20], [100, 20], [100, 80], [20, 80]]
TRUTH = loops.LoopTruth({10: [1], 11: [2]})
RECORD_TRUTH = None
POSES = pg.Trajectory.from_arrays(np.arange(5), np.tile(np.eye(4), (5, 1, 1)))
DRIVE = pg.Trajectory.from_arrays(np.arange(5), np.stack(
    [pg.SE3.exp([i, 0, 0, 0, 0, 0.1 * i]).matrix() for i in range(5)]))
RECORD = pg.record(DRIVE, [DRIVE])
VECTORS = vision.lucas_kanade(GREY, GREY, PX)
DEROTATED = vision.derotate(CAMERA, VECTORS)
CLOUD = vision.PointCloud(XYZ)
OPTIONS: Any = pg.SlamOptions()
RECOGNIZER = pg.PlaceRecognizer()
RECOGNIZER.add(GREY)
RECOGNIZER.add(GREY)
# Values that the types forbid.
NONE: Any = None
NUMBER: Any = 3
LIST: Any = [[1, 2]]
FLOATS: Any = GREY / 255
DOUBLES: Any = FLOW.astype(float)
WHOLE: Any = GREY


def planes_of_others() -> Any:
    points = np.random.default_rng(3).uniform(0, 3, (200, 3))
    return vision.find_cuboids(CLOUD, vision.find_cloud_planes(vision.PointCloud(points)))


def regions_of_others() -> Any:
    return vision.motion_from_planes(CAMERA, PX, PX, vision.find_planar_regions(PX[:20], PX[:20]))


def edges_in_the_plane() -> Any:
    graph = pg.PoseGraph()
    graph.add_node(0, pg.SE2())
    return pg.edge_consistency(graph, {})


def tracked_colour() -> Any:
    return vision.PlaneTracker(GREY, QUAD).track(COLOUR)


def unsized_options() -> Any:
    options = vision.FlowOptions()
    options.step_px = 0


CASES: list[tuple[str, Callable[[], Any], type[Exception], str]] = [
    ("flow of a colour image", lambda: vision.optical_flow(COLOUR, GREY), ValueError, "image_from"),
    ("flow of floats", lambda: vision.optical_flow(GREY, FLOATS), ValueError, "image_to"),
    ("flow of a list", lambda: vision.optical_flow(LIST, GREY), ValueError, "image_from"),
    ("flow of None", lambda: vision.optical_flow(NONE, GREY), TypeError, "image_from"),
    ("flow of two sizes", lambda: vision.optical_flow(GREY, GREY[:60]), ValueError, "size"),
    ("flow of a few pixels", lambda: vision.optical_flow(GREY[:3, :3].copy(), GREY[:3, :3].copy()),
     ValueError, "image_from"),
    ("flow of columns", lambda: vision.optical_flow(GREY, GREY[:, ::2]), ValueError, "image_to"),
    ("flow of no method", lambda: vision.optical_flow(GREY, GREY, "best"), ValueError, "method"),
    ("options of another kind", lambda: vision.optical_flow(GREY, GREY, options=OPTIONS),
     ValueError, "options"),
    ("options of a number", lambda: vision.optical_flow(GREY, GREY, options=NUMBER),
     ValueError, "options"),
    ("option out of range", unsized_options, ValueError, "step_px"),
    ("points of three numbers", lambda: vision.lucas_kanade(GREY, GREY, XYZ), ValueError, "points"),
    ("points with NaN", lambda: vision.lucas_kanade(GREY, GREY, NAN), ValueError, "points"),
    ("mask of another size", lambda: vision.find_corners(GREY, mask=GREY[:50]), ValueError, "mask"),
    ("narrow border", lambda: vision.find_corners(GREY, border=1), ValueError, "border"),
    ("true flow of another size", lambda: vision.flow_error(FLOW, FLOW[:50]), ValueError, "truth"),
    ("flow of doubles", lambda: vision.flow_error(DOUBLES, FLOW), ValueError, "flow"),
    ("rotation of two rows", lambda: vision.derotate(CAMERA, VECTORS, np.eye(2)), ValueError,
     "R_1_2"),
    ("negative covariance", lambda: vision.derotate(CAMERA, VECTORS, None, -np.eye(3)), ValueError,
     "covariance"),
    ("no time between images",
     lambda: vision.time_to_contact(vision.ventral_motion(DEROTATED, [0, 0, 1]), [0, 0, 1], 0.0),
     ValueError, "dt_s"),
    ("horizon of points", lambda: vision.estimate_horizon(PX, CAMERA), ValueError, "segments"),
    ("edges in the plane", edges_in_the_plane, ValueError, "graph"),
    ("matches of two lengths", lambda: vision.estimate_relative_pose(CAMERA, PX, PX[:9]),
     ValueError, "px_cur"),
    ("matches with NaN", lambda: vision.estimate_relative_pose(CAMERA, NAN, PX), ValueError,
     "px_ref"),
    ("no such model", lambda: vision.estimate_relative_pose(CAMERA, PX, PX, "affine"), ValueError,
     "model"),
    ("negative seed", lambda: vision.estimate_relative_pose(CAMERA, PX, PX, seed=-1), TypeError,
     "seed"),
    ("points and pixels differ", lambda: vision.estimate_pose_3d2d(CAMERA, XYZ, PX[:9]), ValueError,
     "px"),
    ("covariance of zero", lambda: vision.estimate_pose_3d3d(XYZ, XYZ, 0.0), ValueError,
     "covariance_ref"),
    ("covariance that is no covariance",
     lambda: vision.estimate_pose_3d3d(XYZ, XYZ, 1.0, -np.ones((40, 3, 3))), ValueError,
     "covariance_cur"),
    ("direction without length",
     lambda: vision.estimate_pose_with_gravity(CAMERA, PX, PX, [0, 0, 0], [0, 1, 0]), ValueError,
     "down_ref"),
    ("Umeyama of two lengths", lambda: vision.umeyama(XYZ, XYZ[:5]), ValueError, "points_to"),
    ("plane behind the camera", lambda: vision.Plane([0, 0, 1], -1.0), ValueError, "distance_m"),
    ("singular homography", lambda: vision.refine_homography(np.zeros((3, 3)), PX, PX), ValueError,
     "H_start"),
    ("homography through five points", lambda: vision.homography_through(PX[:5], PX[:5]),
     ValueError, "four"),
    ("regions of other matches", regions_of_others, ValueError, "px_ref"),
    ("cloud of pixels", lambda: vision.PointCloud(PX), ValueError, "points"),
    ("cloud beyond the world", lambda: vision.PointCloud([[0, 0, 1e9]]), ValueError, "points"),
    ("cloud of an empty image", lambda: vision.PointCloud(np.zeros((0, 4, 3))), ValueError,
     "points"),
    ("depth of another camera",
     lambda: vision.find_depth_planes(np.ones((10, 10), np.float32), CAMERA), ValueError, "depth"),
    ("depth of whole numbers", lambda: vision.PointCloud.of_depth(WHOLE, CAMERA),
     ValueError, "depth"),
    ("no such method of planes", lambda: vision.find_cloud_planes(CLOUD, "hough"), ValueError,
     "method"),
    ("planes of another cloud", planes_of_others, ValueError, "planes"),
    ("segments of points", lambda: vision.find_scene_directions(PX, CAMERA), ValueError,
     "segments"),
    ("segments without length", lambda: vision.find_scene_directions(np.ones((9, 4)), CAMERA),
     ValueError, "segments"),
    ("axes of other segments",
     lambda: vision.compute_orientation_map(SEGMENTS, np.zeros(3, np.int32), CAMERA, np.eye(3)),
     ValueError, "axis"),
    ("no such axis",
     lambda: vision.compute_orientation_map(SEGMENTS, np.full(40, 7, np.int32), CAMERA, np.eye(3)),
     ValueError, "axis"),
    ("no such dictionary", lambda: vision.MarkerDetector("qr"), ValueError, "qr"),
    ("marker of three corners", lambda: vision.MarkerObservation(1, QUAD[:3]), ValueError,
     "corners_px"),
    ("marker without a side",
     lambda: vision.estimate_marker_poses(vision.MarkerObservation(1, QUAD), 0.0, CAMERA),
     ValueError, "side_m"),
    ("template outside the image", lambda: vision.PlaneTracker(GREY, np.array(QUAD) * 1e9),
     ValueError, "corners_px"),
    ("template of three corners", lambda: vision.PlaneTracker(GREY, QUAD[:3]), ValueError,
     "corners_px"),
    ("template with crossed sides",
     lambda: vision.PlaneTracker(GREY, [QUAD[i] for i in (0, 2, 1, 3)]), ValueError, "convex"),
    ("tracking in colour", tracked_colour, ValueError, "image"),
    ("region of two corners", lambda: vision.align(GREY, GREY, QUAD[:2]), ValueError, "polygon_px"),
    ("no model", lambda: vision.SceneModel.read("/nowhere.pgscene"), OSError, "nowhere"),
    ("place of a float image", lambda: RECOGNIZER.add(FLOATS), ValueError, "image"),
    ("place in colour among grey ones", lambda: RECOGNIZER.add(COLOUR), ValueError, "colour"),
    ("match of a description that is no query", lambda: RECOGNIZER.match(RECOGNIZER.view(0)),
     ValueError, "query"),
    ("negative first view", lambda: RECOGNIZER.match(GREY, -1), ValueError, "first"),
    ("filter of a score with NaN",
     lambda: pg.SequenceFilter().update([(0, float("nan"))], 0, 5), ValueError, "matches"),
    ("filter of a view beyond its range", lambda: pg.SequenceFilter().update([(9, 1.0)], 0, 5),
     ValueError, ""),
    ("view that is not there", lambda: RECOGNIZER.view(9), ValueError, "index"),
    ("predictions of two columns", lambda: loops.score(([1], [2]), TRUTH), ValueError,
     "predictions"),
    ("predictions without a score", lambda: loops.score({"query": [1], "candidate": [0]}, TRUTH),
     ValueError, "score"),
    ("scores of another length", lambda: loops.score(([10], [1], [1.0, 2]), TRUTH), ValueError,
     "score"),
    ("score with NaN", lambda: loops.score(([10], [1], [np.nan]), TRUTH), ValueError, "score"),
    ("query before the first image", lambda: loops.score(([-1], [0], [1.0]), TRUTH), ValueError,
     "query"),
    ("queries of floats", lambda: loops.score(([1.5], [0], [1.0]), TRUTH), ValueError, "query"),
    ("negative tolerance", lambda: loops.score(([10], [1], [1.0]), TRUTH, tolerance=-1), ValueError,
     "tolerance"),
    ("no such file of predictions", lambda: loops.score("/nowhere.txt", TRUTH), OSError, "nowhere"),
    ("no such format", lambda: loops.score("/nowhere.txt", TRUTH, format="csv"), ValueError,
     "format"),
    ("truth of a number", lambda: loops.score(([10], [1], [1.0]), NUMBER), ValueError,
     "truth"),
    ("age of a given truth", lambda: loops.score(([10], [1], [1.0]), TRUTH, min_age=3), ValueError,
     "min_age"),
    ("matrix without columns", lambda: loops.LoopTruth.from_matrix(np.zeros((3, 0), bool)),
     ValueError, "no columns"),
    ("reliability of scores above one",
     lambda: loops.score(([10], [1], [7.0]), TRUTH).reliability, ValueError, ""),
    ("alignment that is none", lambda: pg.evaluate(POSES, POSES, align="affine"), ValueError,
     "align"),
    ("truth that is none", lambda: pg.evaluate(NONE, POSES), ValueError, "truth"),
    ("estimate of an array", lambda: pg.evaluate(POSES, FLOATS), ValueError, "estimate"),
    ("no such estimate", lambda: pg.evaluate(POSES, "/nowhere.tum"), OSError, "nowhere"),
    ("evaluation options of another kind", lambda: pg.evaluate(POSES, POSES, options=OPTIONS),
     ValueError, "options"),
    ("criteria of a revisit of no kind",
     lambda: loops.score(([1], [0], [0.5]), POSES, options=wrong({}), min_age=3), ValueError,
     "options: RevisitOptions"),
    ("evaluation options of no kind", lambda: pg.evaluate(POSES, POSES, options=wrong({})),
     ValueError, "options"),
    ("times of a number", lambda: pg.evaluate(POSES, POSES, times=wrong(5)), ValueError, "times"),
    ("times of numbers", lambda: pg.evaluate(POSES, POSES, times=wrong([1, 2])), ValueError,
     "times"),
    ("estimates of a number", lambda: pg.compare(POSES, wrong(5)), ValueError, "estimates"),
    ("estimates of numbers", lambda: pg.compare(POSES, wrong([5])), ValueError, "estimates"),
    ("three files of times", lambda: pg.evaluate(POSES, POSES, times=["a", "b", "c"]), ValueError,
     "times"),
    ("submission that is not there", lambda: pg.evaluate_kitti(".", "/nowhere"), OSError,
     "nowhere"),
    ("submission of a number", lambda: pg.evaluate_kitti(".", wrong(5)), ValueError, "estimates"),
    ("submission without poses", lambda: pg.evaluate_kitti("/", "/"), ValueError,
     "holds no poses of a sequence"),
    ("record that is not there", lambda: pg.read_record("/nowhere.json"), OSError, "nowhere"),
    ("baseline of a number", lambda: pg.gate(wrong(5), "b.json"), ValueError, "baseline"),
    ("candidates of numbers", lambda: pg.gate(RECORD, wrong([5])), ValueError, "candidates"),
    ("no candidate", lambda: pg.gate(RECORD, []), ValueError, "no record is given"),
    ("rules of no form", lambda: pg.gate(RECORD, RECORD, rules=["worse"]), OSError, "rules:1"),
    ("level of two", lambda: pg.gate(RECORD, RECORD, level=2), ValueError, "level"),
    ("no such figure of a record", lambda: RECORD.values("sequence", "ate"), ValueError, "ate"),
    ("differences of several truths",
     lambda: pg.Comparison([pg.evaluate(DRIVE, DRIVE)], True).differences(), ValueError,
     "one ground truth"),
    ("nothing to compare", lambda: pg.compare(POSES, {}), ValueError, "estimates"),
    ("no such plot", lambda: pg.evaluate(DRIVE, DRIVE).plot("pie"), ValueError, "kind"),
    ("no such figure", lambda: pg.evaluate(DRIVE, DRIVE)["ate"], KeyError, "ate_rmse_m"),
]


@pytest.mark.parametrize("call, error, text", [case[1:] for case in CASES],
                         ids=[case[0] for case in CASES])
def test_wrong_input_is_refused(call: Callable[[], Any], error: type[Exception], text: str) -> None:
    with pytest.raises(error) as raised:
        call()
    assert text in str(raised.value)


def test_a_folder_without_a_run_is_no_estimate(tmp_path: pathlib.Path) -> None:
    with pytest.raises(ValueError, match="estimate"):
        pg.evaluate(POSES, tmp_path)
    with pytest.raises(ValueError, match="truth"):
        pg.compare(POSES, tmp_path)  # a folder of files


def test_views_outlive_their_results() -> None:
    labels = vision.find_cloud_planes(CLOUD).labels
    px = vision.lucas_kanade(GREY, GREY, PX).px
    flow = vision.optical_flow(GREY, GREY)
    copies = labels.copy(), px.copy(), flow.copy()
    for _ in range(20):  # others use the memory that a view without an owner would have lost
        vision.find_cloud_planes(CLOUD)
        vision.lucas_kanade(GREY, GREY, 2 * PX % 100)
    for view, copy in zip((labels, px, flow), copies):
        np.testing.assert_array_equal(view, copy)
    with pytest.raises(ValueError):
        px[0] = 0
