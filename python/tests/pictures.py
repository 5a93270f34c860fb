"""Pictures that tests make themselves."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Grey = NDArray[np.uint8]


def texture(height: int, width: int, smooth: float = 400.0, seed: int = 1) -> Array:
    """Smooth noise from 0 to 255."""
    noise = np.random.default_rng(seed).random((height, width))
    frequency = np.fft.fftfreq(height)[:, None] ** 2 + np.fft.fftfreq(width) ** 2
    image = np.real(np.fft.ifft2(np.fft.fft2(noise) * np.exp(-smooth * frequency)))
    return np.asarray(255 * (image - image.min()) / np.ptp(image))


def warped(image: Array, H_new_old: Array) -> Array:
    """The image as a homography maps it, by bilinear interpolation; the border is repeated."""
    height, width = image.shape
    v, u = np.mgrid[:height, :width]
    point = np.stack([u, v, np.ones_like(u)], -1) @ np.linalg.inv(H_new_old).T
    x = np.clip(point[..., 0] / point[..., 2], 0, width - 1.001)
    y = np.clip(point[..., 1] / point[..., 2], 0, height - 1.001)
    i, j = x.astype(int), y.astype(int)
    a, b = x - i, y - j
    above = image[j, i] * (1 - a) + image[j, i + 1] * a
    below = image[j + 1, i] * (1 - a) + image[j + 1, i + 1] * a
    return np.asarray(above * (1 - b) + below * b)


def grey(image: Array) -> Grey:
    """The image in whole grey levels."""
    return np.clip(np.rint(image), 0, 255).astype(np.uint8)


def mapped(H: Array, px: Array) -> Array:
    """Points (N x 2) as a homography maps them."""
    point = np.c_[px, np.ones(len(px))] @ H.T
    return np.asarray(point[:, :2] / point[:, 2:])


def marker(number: int, cell_px: int = 8) -> Grey:
    """A marker of the dictionary aruco_original on a white ground, each row two bits of its id."""
    words = (0b10000, 0b10111, 0b01001, 0b01110)
    cells = np.zeros((7, 7))
    for row in range(5):
        word = words[(number >> (2 * (4 - row))) & 3]
        cells[row + 1, 1:6] = [(word >> (4 - column)) & 1 for column in range(5)]
    framed = np.pad(cells, 1, constant_values=1)
    return grey(20 + 200 * np.kron(framed, np.ones((cell_px, cell_px))).astype(np.float64))
