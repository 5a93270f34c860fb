"""Rigid motions and cameras, against formulas written with numpy."""

import numpy as np
import pytest
from numpy.typing import NDArray

import placegraph as pg


def rotation_about_z(angle: float) -> NDArray[np.float64]:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def matrix_of(angle: float, translation: list[float]) -> NDArray[np.float64]:
    matrix = np.eye(4)
    matrix[:3, :3] = rotation_about_z(angle)
    matrix[:3, 3] = translation
    return matrix


def test_the_quaternion_orders_are_named() -> None:
    T = pg.SE3(matrix_of(0.6, [1, 2, 3]))
    xyzw, wxyz = T.quaternion_xyzw, T.quaternion_wxyz
    np.testing.assert_allclose(xyzw, [0, 0, np.sin(0.3), np.cos(0.3)], atol=1e-15)
    np.testing.assert_array_equal(wxyz, xyzw[[3, 0, 1, 2]])
    for again in (pg.SE3.from_quaternion_xyzw(xyzw, [1, 2, 3]),
                  pg.SE3.from_quaternion_wxyz(2 * wxyz, [1, 2, 3])):
        np.testing.assert_allclose(again.matrix(), T.matrix(), atol=1e-15)


def test_motions_are_multiplied_and_inverted_as_matrices() -> None:
    A, B = matrix_of(0.6, [1, 2, 3]), matrix_of(-1.1, [0.5, 0, -2])
    np.testing.assert_allclose((pg.SE3(A) * pg.SE3(B)).matrix(), A @ B, atol=1e-14)
    np.testing.assert_allclose((pg.SE3(A) @ pg.SE3(B)).matrix(), A @ B, atol=1e-14)
    np.testing.assert_allclose(pg.SE3(A).inverse().matrix(), np.linalg.inv(A), atol=1e-14)
    points = np.arange(12.0).reshape(4, 3)
    np.testing.assert_allclose(
        pg.SE3(A).transform(points), points @ A[:3, :3].T + A[:3, 3], atol=1e-13)


def test_the_tangent_is_translation_then_rotation() -> None:
    T = pg.SE3.exp([1, 2, 3, 0, 0, 0])
    np.testing.assert_array_equal(T.translation, [1, 2, 3])
    turned = pg.SE3.exp([0, 0, 0, 0, 0, 0.25])
    np.testing.assert_allclose(turned.rotation, rotation_about_z(0.25), atol=1e-15)
    xi = np.array([0.3, -0.2, 0.1, 0.5, -0.4, 0.2])
    np.testing.assert_allclose(pg.SE3.exp(xi).log(), xi, atol=1e-14)
    left = pg.SE3.exp(turned.adjoint() @ xi) * turned
    np.testing.assert_allclose(left.matrix(), turned.plus(xi).matrix(), atol=1e-14)


def test_a_camera_projects_points_to_pixels_and_back() -> None:
    camera = pg.Camera(640, 480, 500, 510, 320, 240)
    points = np.array([[0.0, 0, 2], [1, -1, 4], [0, 0, -1]])
    px = camera.project(points)
    np.testing.assert_allclose(px[:2], np.array([[320, 240], [445, 112.5]]))
    assert np.isnan(px[2]).all()
    np.testing.assert_allclose(camera.unproject(px[:2]) * np.array([[2], [4]]), points[:2], atol=1e-12)
    np.testing.assert_array_equal(camera.K(), np.array([[500, 0, 320], [0, 510, 240], [0, 0, 1]]))


def test_a_distorted_camera_follows_its_model() -> None:
    k1 = -0.2
    camera = pg.Camera(640, 480, 500, 500, 320, 240, pg.Distortion.RADIAL_TANGENTIAL, [k1])
    assert camera.coefficients[:2] == (k1, 0)
    px = camera.project([[0.3, 0, 1]])
    assert px[0, 0] == pytest.approx(320 + 500 * 0.3 * (1 + k1 * 0.09))
    np.testing.assert_allclose(camera.unproject(px), [[0.3, 0, 1]], atol=1e-9)
