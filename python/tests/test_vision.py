"""Single functions on images: against the geometry that the images were made with."""

import pathlib
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import placegraph as pg
from placegraph import vision

from pictures import grey, mapped, marker, texture, warped

MODELS = pathlib.Path(__file__).resolve().parents[2] / "configs" / "models"
IMAGE = texture(240, 320)
H = np.array([[1.02, 0.01, 3], [-0.01, 0.99, 2], [1e-5, 2e-5, 1]])
FIRST, SECOND = grey(IMAGE), grey(warped(IMAGE, H))
QUAD = np.array([[110.0, 90], [200, 90], [200, 160], [110, 160]])


def true_flow() -> NDArray[np.float32]:
    v, u = np.mgrid[:240, :320]
    px = np.stack([u.ravel(), v.ravel()], -1).astype(float)
    return np.asarray((mapped(H, px) - px).reshape(240, 320, 2), np.float32)


@pytest.mark.parametrize("method", vision.flow_methods())
def test_flow_is_that_of_the_homography(method: Any) -> None:
    flow = vision.optical_flow(FIRST, SECOND, method)
    assert flow.shape == (240, 320, 2) and flow.dtype == np.float32
    error = vision.flow_error(flow, true_flow())
    assert error.compared > 50 and error.median_px < 0.15
    known = np.isfinite(flow).all(2)
    inside = mapped(H, np.argwhere(np.ones((240, 320)))[:, ::-1].astype(float))
    seen = ((inside >= 0) & (inside <= [319, 239])).all(1).reshape(240, 320)
    apart = np.linalg.norm(flow - true_flow(), axis=2)[known & seen]
    assert error.mean_px == pytest.approx(apart.mean(), rel=1e-3)
    options = vision.FlowOptions()
    options.method = method
    np.testing.assert_array_equal(vision.optical_flow(FIRST, SECOND, options=options), flow)


def test_flow_of_a_rendered_drive_is_the_exact_one() -> None:
    world = pg.synthetic.World("town-loop", frames=2, size=(320, 120))
    seen = world.render(0, pg.Sensor.MONO, flow=True)
    truth: Any = seen.flow
    flow = vision.optical_flow(seen.frame.image, world.frame(1, pg.Sensor.MONO).image)
    error = vision.flow_error(flow, truth)
    assert error.pixels > 20_000 and error.coverage > 0.9
    assert error.median_px < 0.5


def test_points_are_followed_with_their_covariances() -> None:
    px, strength = vision.find_corners(FIRST, border=25)
    assert len(px) == len(strength) > 100 and (strength > 1e-4).all()
    for method in (vision.lucas_kanade, vision.interpolation_flow):
        found = method(FIRST, SECOND, px)
        whole = found.kind == 2
        assert len(found) == len(px) and whole.mean() > 0.9
        start = found.px[whole]
        error = start + found.flow[whole] - mapped(H, start)
        assert np.median(np.linalg.norm(error, axis=1)) < 0.1
        assert (np.linalg.eigvalsh(found.covariance[whole]) > 0).all()
    sparse = vision.key_pixel_flow(FIRST, SECOND)
    error = sparse.px + sparse.flow - mapped(H, sparse.px)
    assert len(sparse) > 50 and np.median(np.linalg.norm(error, axis=1)) < 0.3


def test_cues_of_the_flow_of_a_descent() -> None:
    # The camera descends by a tenth of its height above the plane and turns.
    camera = pg.Camera(320, 240, 300, 300, 159.5, 119.5)
    K = np.array([[300, 0, 159.5], [0, 300, 119.5], [0, 0, 1.0]])
    R = pg.SE3.exp([0, 0, 0, 0.01, -0.02, 0.03]).matrix()[:3, :3]  # of T_1_2
    t, normal = np.array([0.02, -0.01, 0.1]), np.array([0, 0, 1.0])
    plane = K @ R.T @ (np.eye(3) - np.outer(t, normal)) @ np.linalg.inv(K)
    second = grey(warped(IMAGE, plane))
    px, _ = vision.find_corners(FIRST, border=30)
    flow = vision.lucas_kanade(FIRST, second, px)
    turned = vision.derotate(camera, flow, R, 1e-8 * np.eye(3))
    moved = 1 - t[2]
    assert np.median(np.abs(turned.end - (turned.start - t[:2]) / moved)) < 1e-3
    motion = vision.ventral_motion(turned, normal)
    assert motion and motion.inliers > 0.8 * len(turned)
    np.testing.assert_allclose(motion.over_distance, t, atol=2e-3)
    contact = vision.time_to_contact(motion, normal, dt_s=0.5)
    assert contact and contact.seconds == pytest.approx(0.5 * moved / t[2], rel=0.03)
    affine = vision.affine_flow(turned)
    assert affine and affine.divergence == pytest.approx(2 * t[2] / moved, abs=5e-3)
    balance = vision.lateral_balance(turned)
    assert balance and abs(balance.balance) < 0.6
    dense = vision.sampled_flow(FIRST, vision.optical_flow(FIRST, second), 16)
    same = vision.ventral_motion(vision.derotate(camera, dense, R), normal)
    np.testing.assert_allclose(same.over_distance, t, atol=5e-3)


def test_corners_avoid_the_mask() -> None:
    mask = np.zeros((240, 320), np.uint8)
    mask[:, :160] = 255
    px, _ = vision.find_corners(FIRST, mask=mask)
    assert len(px) > 50 and px[:, 0].max() < 160


def test_a_region_is_aligned() -> None:
    found = vision.align(FIRST, SECOND, QUAD)
    assert found and found.agreement > 0.99
    np.testing.assert_allclose(mapped(found.H_cur_ref, QUAD), mapped(H, QUAD), atol=0.05)
    brighter = vision.align(FIRST, grey(0.7 * warped(IMAGE, H) + 30), QUAD)
    assert brighter.gain == pytest.approx(0.7, abs=0.02)
    assert brighter.bias == pytest.approx(30, abs=3)
    assert not vision.align(FIRST, grey(texture(240, 320, seed=9)), QUAD)


def test_a_region_is_tracked_and_lost() -> None:
    tracker = vision.PlaneTracker(FIRST, QUAD)
    assert tracker.ok and 0 < tracker.least_similarity < 1
    motion = np.eye(3)
    for _ in range(4):
        motion = H @ motion
        track = tracker.track(grey(warped(IMAGE, motion)))
        assert track and track.source == "prediction"
        np.testing.assert_allclose(track.corners_px, mapped(motion, QUAD), atol=0.1)
    lost = tracker.track(np.full((240, 320), 90, np.uint8))
    assert not lost and lost.reason
    flat = vision.PlaneTracker(np.full((240, 320), 90, np.uint8), QUAD)
    assert not flat.ok and flat.reason


def test_points_are_matched() -> None:
    found = vision.match_wide(FIRST, SECOND)
    assert found and found.candidates >= len(found) > 100
    error = np.linalg.norm(mapped(H, found.px_a) - found.px_b, axis=1)
    assert np.median(error) < 0.3
    ends = np.c_[found.px_b, np.ones(len(found))], np.c_[found.px_a, np.ones(len(found))]
    assert np.abs(np.einsum("ni,ij,nj->n", ends[0], found.F_b_a, ends[1])).max() < 1


def test_markers_are_detected_with_their_pose() -> None:
    camera = pg.Camera(320, 240, 300, 300, 159.5, 119.5)
    image = np.full((240, 320), 220, np.uint8)
    image[80:152, 100:172] = marker(123)
    found = vision.MarkerDetector("aruco_original").detect(image)
    assert [each.id for each in found] == [123]
    corners = [[107.5, 87.5], [163.5, 87.5], [163.5, 143.5], [107.5, 143.5]]
    np.testing.assert_allclose(found[0].corners_px, corners, atol=0.1)
    poses = vision.estimate_marker_poses(found[0], 0.1, camera)
    assert poses and poses.margin > 100
    middle = (np.mean(corners, 0) - [159.5, 119.5]) / 300
    depth = 300 * 0.1 / 56
    np.testing.assert_allclose(poses.poses[0].T_cam_marker.translation,
                               [*(depth * middle), depth], atol=2e-3)
    assert "apriltag_36h11" in vision.marker_dictionaries()
    measured = vision.MarkerObservation(7, corners, sigma_px=0.5)
    np.testing.assert_allclose(measured.covariance, 0.25 * np.eye(8))


def test_edges_are_found() -> None:
    image = np.full((240, 320), 200, np.uint8)
    image[60:180, 80:240] = 40
    segments = vision.detect_segments(image)
    assert segments.shape == (4, 4)
    lines = {tuple(np.rint(2 * part.mean(0)) / 2) for part in segments.reshape(4, 2, 2)}
    assert lines == {(79.5, 119.5), (239.5, 119.5), (159.5, 59.5), (159.5, 179.5)}


def test_vanishing_points_and_surfaces_of_a_room() -> None:
    random = np.random.default_rng(0)
    camera = pg.Camera(320, 240, 300, 300, 159.5, 119.5)
    R = pg.SE3.exp([0, 0, 0, 0.1, 0.3, 0.05]).matrix()[:3, :3]
    axis = np.arange(60) % 3
    start = random.uniform([-2, -1.5, 4], [2, 1.5, 8], (60, 3))
    ends = np.stack([start, start + R.T[axis] * random.uniform(0.4, 1, (60, 1))], 1)
    px = 300 * ends[..., :2] / ends[..., 2:] + [159.5, 119.5]
    segments = (px + random.normal(0, 0.1, px.shape)).reshape(60, 4)
    scene = vision.find_scene_directions(segments, camera)
    assert scene and len(scene.points) == 3
    for point in scene.points:
        assert np.abs(R.T @ point.direction).max() > np.cos(np.radians(0.5))
    for k in range(3):
        assert len(set(scene.labels[axis == k])) == 1
    frame = scene.frames[0]
    agreement = np.abs(frame.R_cam_manhattan.T @ R)
    np.testing.assert_allclose(agreement, np.rint(agreement), atol=0.01)
    surfaces = vision.compute_orientation_map(segments, frame.axis, camera, frame.R_cam_manhattan)
    assert surfaces and surfaces.labels.shape == (240, 320)
    assert surfaces.coverage == pytest.approx((surfaces.labels > 0).mean())
    kinds = vision.indoor_surfaces(surfaces, camera, frame.R_cam_manhattan)
    walls = (surfaces.labels > 0) & (surfaces.labels != 1 + surfaces.vertical_axis)
    np.testing.assert_array_equal(kinds == 3, walls)
    horizon = vision.estimate_horizon(segments, camera)
    assert horizon and horizon.directions >= 2
    assert horizon.down @ R[:, 1] > np.cos(np.radians(1))


@pytest.mark.skipif(not MODELS.is_dir(), reason="the models are absent")
def test_surfaces_of_an_image() -> None:
    random = np.random.default_rng(1)
    image = np.zeros((240, 320, 3), np.uint8)
    image[:100], image[100:] = (230, 180, 120), (90, 95, 95)
    image += random.integers(0, 10, image.shape).astype(np.uint8)
    model = vision.SceneModel.read(str(MODELS / "surfaces.pgscene"))
    urban = vision.SceneModel.read(str(MODELS / "urban.pgscene"))
    assert (model.kind, urban.kind) == ("surfaces", "urban")
    found = vision.classify_surfaces(model, image)
    assert found.classes == model.classes == ("sky", "ground", "vertical", "object")
    assert (found.labels[:60] == 0).all() and (found.labels[180:] == 1).all()
    assert found.confidence.min() > 0 and found.confidence.max() <= 1
    certain = vision.classify_surfaces(model, image, unknown_below=1.0)
    assert (certain.labels[found.confidence < 1] == len(model.classes)).all()
    street = vision.label_jointly(urban, model, image)
    assert (street.labels[:60] == street.classes.index("Sky")).all()
    assert np.mean(street.labels[180:] == street.classes.index("Road")) > 0.9


def test_a_border_wider_than_the_image_leaves_no_corners() -> None:
    for border in (120, 2**30, 2**31 - 1):
        px, strength = vision.find_corners(FIRST, border=border)
        assert px.shape == (0, 2) and strength.shape == (0,)
