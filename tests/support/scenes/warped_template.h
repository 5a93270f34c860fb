#pragma once
#include <placegraph/frontend/align/planar_template.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "tests/support/scenes/texture.h"

namespace placegraph::test {

/// The homography that takes each of four corners to where `moved` says.
inline Eigen::Matrix3d homography_of_corners(const std::array<Eigen::Vector2d, 4>& corners,
                                             const std::array<Eigen::Vector2d, 4>& moved) {
  Eigen::Matrix<double, 8, 8> A;
  Eigen::Matrix<double, 8, 1> b;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d &p = corners[i], &q = moved[i];
    A.row(2 * i) << p.x(), p.y(), 1, 0, 0, 0, -q.x() * p.x(), -q.x() * p.y();
    A.row(2 * i + 1) << 0, 0, 0, p.x(), p.y(), 1, -q.y() * p.x(), -q.y() * p.y();
    b.segment<2>(2 * i) = q;
  }
  const Eigen::Matrix<double, 8, 1> h = A.fullPivLu().solve(b);
  Eigen::Matrix3d H;
  H << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1;
  return H;
}

/// Each corner goes `offset_px` into a direction of its own.
inline Eigen::Matrix3d random_homography(const PlanarTemplate& t, double offset_px,
                                         Random& random) {
  std::array<Eigen::Vector2d, 4> moved = t.corners_px();
  for (Eigen::Vector2d& corner : moved) {
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    corner += offset_px * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return homography_of_corners(t.corners_px(), moved);
}

/// A plane of texture seen through a homography: pixel p shows the texture at H^-1 p.
inline Image warped_texture(int width, int height, const Texture& texture,
                            const Eigen::Matrix3d& H_cur_ref) {
  const Eigen::Matrix3d H_ref_cur = H_cur_ref.inverse();
  Image image(height, width, CV_8UC1);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector3d q = H_ref_cur * Eigen::Vector3d(u, v, 1);
      image.at<std::uint8_t>(v, u) = to_grey(texture.grey(q.x() / q.z(), q.y() / q.z()));
    }
  return image;
}

}  // namespace placegraph::test
