"""Motions, homographies and planes: against the geometry that the measurements were made with."""

import numpy as np
import pytest
from numpy.typing import NDArray

import placegraph as pg
from placegraph import vision

from pictures import mapped

Array = NDArray[np.float64]
CAMERA = pg.Camera(640, 480, 400, 400, 319.5, 239.5)
K = np.array([[400, 0, 319.5], [0, 400, 239.5], [0, 0, 1.0]])
T = pg.SE3.exp([0.3, 0.05, 0.1, 0.02, -0.05, 0.03])  # T_ref_cur
RANDOM = np.random.default_rng(0)
POINTS = RANDOM.uniform([-3, -2, 4], [3, 2, 10], (200, 3))


def projected(points: Array) -> Array:
    return mapped(K, points[:, :2] / points[:, 2:])


def in_cur(points: Array) -> Array:
    """The points in the second camera."""
    matrix = np.linalg.inv(T.matrix())
    return np.asarray(points @ matrix[:3, :3].T + matrix[:3, 3])


def on_plane(normal: Array, distance: float, count: int = 100) -> Array:
    rays = np.c_[RANDOM.uniform(-0.6, 0.6, count), RANDOM.uniform(-0.5, 0.5, count), np.ones(count)]
    return np.asarray(rays * (distance / (rays @ normal))[:, None])


def assert_same(a: pg.SE3, b: pg.SE3, tolerance: float) -> None:
    np.testing.assert_allclose(a.matrix(), b.matrix(), atol=tolerance)


def unit(motion: pg.SE3) -> pg.SE3:
    """The motion with a translation of length one."""
    matrix = motion.matrix().copy()
    matrix[:3, 3] /= np.linalg.norm(matrix[:3, 3])
    return pg.SE3(matrix)


@pytest.mark.parametrize("model", ["auto", "essential"])
def test_relative_pose_of_exact_matches(model: str) -> None:
    found = vision.estimate_relative_pose(CAMERA, projected(POINTS), projected(in_cur(POINTS)),
                                          model)
    assert found and found.model == "essential" and found.T_ref_cur is not None
    assert_same(found.T_ref_cur, unit(T), 1e-6)
    assert len(found.inliers) == 200 and found.rmse_px < 1e-6


def test_relative_pose_leaves_out_false_matches() -> None:
    px_cur = projected(in_cur(POINTS)) + RANDOM.normal(0, 0.2, (200, 2))
    px_cur[::4] += 25
    found = vision.estimate_relative_pose(CAMERA, projected(POINTS), px_cur, seed=3)
    assert found and not np.isin(found.inliers, np.arange(0, 200, 4)).any()
    assert found.T_ref_cur is not None and found.R_ref_cur is not None
    np.testing.assert_allclose(found.R_ref_cur, T.matrix()[:3, :3], atol=5e-3)
    error = np.array((found.T_ref_cur.inverse() * unit(T)).log())
    sigma = np.sqrt(np.diag(found.covariance))
    assert (np.abs(error[3:]) < 5 * sigma[3:]).all()
    again = vision.estimate_relative_pose(CAMERA, projected(POINTS), px_cur, seed=3)
    assert again.T_ref_cur is not None
    np.testing.assert_array_equal(again.T_ref_cur.matrix(), found.T_ref_cur.matrix())


def test_a_pure_rotation_has_no_translation() -> None:
    turned = POINTS @ T.matrix()[:3, :3]
    found = vision.estimate_relative_pose(CAMERA, projected(POINTS), projected(turned))
    assert found and found.model == "rotation" and found.T_ref_cur is None
    assert found.R_ref_cur is not None
    np.testing.assert_allclose(found.R_ref_cur, T.matrix()[:3, :3], atol=1e-9)


def test_too_few_matches_are_refused() -> None:
    found = vision.estimate_relative_pose(CAMERA, np.zeros((4, 2)), np.zeros((4, 2)))
    assert not found and found.outcome == "too few data" and found.reason


def test_pose_of_points() -> None:
    px = projected(in_cur(POINTS))
    px[:30] += 40
    found = vision.estimate_pose_3d2d(CAMERA, POINTS, px)
    assert found and found.inliers.tolist() == list(range(30, 200))
    assert_same(found.T_ref_cam, T, 1e-6)
    assert np.linalg.eigvalsh(found.information).min() > 0
    near = vision.estimate_pose_3d2d(CAMERA, POINTS, px, prior=T)
    assert_same(near.T_ref_cam, T, 1e-6)


def test_pose_of_clouds() -> None:
    seen = in_cur(POINTS) + RANDOM.normal(0, 0.01, (200, 3))
    covariance = np.tile(1e-4 * np.eye(3), (200, 1, 1))
    for of_cur in (0.01, covariance):
        found = vision.estimate_pose_3d3d(POINTS, seen, 1e-4, of_cur)
        assert found and found.chi2_per_dof == pytest.approx(1, abs=0.25)
        assert_same(found.T_ref_cur, T, 0.02)


def test_pose_with_gravity_and_on_a_circle() -> None:
    down = np.array([0.0, 1, 0])
    found = vision.estimate_pose_with_gravity(CAMERA, projected(POINTS), projected(in_cur(POINTS)),
                                              2 * down, T.matrix()[:3, :3].T @ down)
    assert found
    assert_same(found.T_ref_cur, unit(T), 1e-5)
    yaw = 0.1
    car = pg.SE3.exp([0, 0, 0, 0, yaw, 0]).matrix().copy()
    car[:3, 3] = 0.8 * np.array([np.sin(yaw / 2), 0, np.cos(yaw / 2)])
    inverse = np.linalg.inv(car)
    moved = POINTS @ inverse[:3, :3].T + inverse[:3, 3]
    circle = vision.estimate_circular_motion(CAMERA, projected(POINTS), projected(moved))
    assert circle and circle.yaw_rad == pytest.approx(yaw, abs=1e-6)
    assert_same(circle.T_ref_cur, unit(pg.SE3(car)), 1e-6)


@pytest.mark.parametrize("scale", [1.0, 2.5])
def test_umeyama_recovers_a_similarity(scale: float) -> None:
    matrix = T.matrix()
    found = vision.umeyama(POINTS, scale * POINTS @ matrix[:3, :3].T + matrix[:3, 3], scale != 1)
    assert found and found.rank == 3 and found.pairs == 200
    assert found.scale == pytest.approx(scale, rel=1e-12)
    np.testing.assert_allclose(found.R_truth_estimate, matrix[:3, :3], atol=1e-12)
    np.testing.assert_allclose(found.t_truth_estimate, matrix[:3, 3], atol=1e-12)
    assert not vision.umeyama(POINTS[:2], POINTS[:2])


def test_homography_of_a_plane_both_ways() -> None:
    plane = vision.Plane([0.1, 0.2, 1], 5.0)
    points = on_plane(plane.normal, 5.0)
    a, b = projected(points), projected(in_cur(points))
    H = vision.homography_from_plane(K, T.inverse(), plane)
    np.testing.assert_allclose(mapped(H, a), b, atol=1e-9)
    fit = vision.refine_homography(np.eye(3), a, b + RANDOM.normal(0, 0.1, b.shape), sigma_px=0.1)
    assert fit
    np.testing.assert_allclose(mapped(fit.H_cur_ref, a), b, atol=0.2)
    four = vision.homography_through(a[:4], b[:4])
    assert four is not None
    np.testing.assert_allclose(mapped(four, a), b, atol=1e-6)
    motion = vision.motion_from_homography(K, H, plane.normal)
    expected = T.inverse().matrix().copy()
    expected[:3, 3] /= 5
    np.testing.assert_allclose(motion.matrix(), expected, atol=1e-9)
    solutions = vision.decompose_homography(K, 3 * H, a)
    assert min(np.abs(s.T_cur_ref.matrix() - expected).max() for s in solutions) < 1e-9


def test_two_planes_and_the_motion_between_their_images() -> None:
    first, second = np.array([0, 0.3, 1.0]), np.array([0.9, 0, 1.0])
    planes = [on_plane(n / np.linalg.norm(n), d) for n, d in ((first, 5.0), (second, 7.0))]
    planes = [planes[0][planes[0][:, 0] < -0.3], planes[1][planes[1][:, 0] > 0.3]]
    points = np.concatenate(planes)
    a, b = projected(points), projected(in_cur(points)) + RANDOM.normal(0, 0.1, (len(points), 2))
    found = vision.find_planar_regions(a, b)
    assert found and len(found.regions) == 2
    of = np.repeat([0, 1], [len(each) for each in planes])
    for k in range(2):
        labels = found.labels[of == k]
        assert labels[0] > 0 and (labels == labels[0]).mean() > 0.95
    assert sum(region.matches for region in found.regions) == (found.labels > 0).sum()
    motion = vision.motion_from_planes(CAMERA, a, b, found)
    assert motion
    best = motion.readings[0]
    np.testing.assert_allclose(best.T_cur_ref.matrix(), unit(T.inverse()).matrix(), atol=0.05)
    assert len(best.planes_ref) == 2


def room() -> NDArray[np.float32]:
    """Depths of a wall 4 m ahead and a floor 1.2 m below the camera."""
    v, _ = np.mgrid[:480, :640]
    y = (v - 239.5) / 400
    depth = np.where(y > 0, np.minimum(1.2 / np.maximum(y, 1e-9), 4.0), 4.0)
    return (depth + RANDOM.normal(0, 0.002, depth.shape)).astype(np.float32)


def test_planes_of_a_depth_image() -> None:
    planes = vision.find_depth_planes(room(), CAMERA)
    assert len(planes) == 2
    for plane, normal, distance in zip(planes, ([0, 0, 1], [0, 1, 0]), (4.0, 1.2)):
        sign = np.sign(plane.distance_m)
        np.testing.assert_allclose(sign * plane.normal, normal, atol=2e-3)
        assert sign * plane.distance_m == pytest.approx(distance, abs=5e-3)
        np.testing.assert_allclose(plane.points @ plane.normal, plane.distance_m, atol=0.02)


@pytest.mark.parametrize("method", ["cuts", "ransac", "growing"])
def test_planes_of_a_cloud(method: str) -> None:
    camera = pg.Camera(160, 120, 100, 100, 79.5, 59.5)
    cloud = vision.PointCloud.of_depth(np.ascontiguousarray(room()[1::4, 1::4]), camera)
    assert (cloud.width, cloud.height, len(cloud)) == (160, 120, 160 * 120)
    found = vision.find_cloud_planes(cloud, method)
    assert found and found.from_origin
    for plane, normal, distance in zip(found.planes, ([0, 0, 1], [0, 1, 0]), (4.0, 1.2)):
        np.testing.assert_allclose(plane.normal, normal, atol=0.01)
        assert plane.distance_m == pytest.approx(distance, abs=0.03)
    assert found.planes[0].points == (found.labels == 1).sum()
    organised = vision.PointCloud(cloud.points.reshape(120, 160, 3))
    same = vision.find_cloud_planes(organised, method)
    np.testing.assert_array_equal(same.labels, found.labels)


def test_a_box_is_found_among_planes() -> None:
    # Two sides that meet in an edge 3 m ahead: z = 3 + |x|.
    v, u = np.mgrid[:120, :160]
    ray = np.stack([(u - 79.5) / 100, (v - 59.5) / 100, np.ones(u.shape)], -1)
    depth = 3 / (1 - np.abs(ray[..., 0]))
    depth[(np.abs(ray[..., 0]) > 0.25) | (np.abs(ray[..., 1]) > 0.3)] = np.nan
    points = ray * depth[..., None] + RANDOM.normal(0, 0.001, (120, 160, 3))
    cloud = vision.PointCloud(points)
    found = vision.find_cloud_planes(cloud)
    boxes = vision.find_cuboids(cloud, found)
    assert [box.kind for box in boxes] == ["box"]
    assert sum(face >= 0 for face in boxes[0].faces) == 2
    turned = np.abs(boxes[0].T_sensor_cuboid.matrix()[:3, :3])
    np.testing.assert_allclose(np.sort(turned[0]), np.array([0, 1, 1]) * np.sqrt(0.5), atol=0.02)
