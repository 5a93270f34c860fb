#pragma once
#include <placegraph/frontend/align/warp.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "tests/support/scenes/texture.h"

namespace placegraph::test {

/// A textured board before a textured background, and the pictures of it.
struct Board {
  int width = 320, height = 240;
  std::vector<Eigen::Vector2d> corners = {{110, 70}, {210, 70}, {210, 160}, {110, 160}};
  Texture texture, background;

  explicit Board(Random& random)
      : texture{random.next(), 36, 4, 40, 128}, background{random.next(), 50, 4, 35, 120} {}

  /// The board where H takes it from its place in the first image, or none.
  Image picture(const std::optional<Eigen::Matrix3d>& H_cur_ref) const {
    const Eigen::Matrix3d H_ref_cur =
        H_cur_ref ? Eigen::Matrix3d(H_cur_ref->inverse()) : Eigen::Matrix3d::Identity();
    Image image(height, width, CV_8UC1);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        const auto px = map_pixel(H_ref_cur, Eigen::Vector2d(u, v));
        const bool on = H_cur_ref && px && px->x() >= corners[0].x() && px->x() <= corners[2].x() &&
                        px->y() >= corners[0].y() && px->y() <= corners[2].y();
        image.at<std::uint8_t>(v, u) =
            to_grey(on ? texture.grey(px->x(), px->y()) : background.grey(u, v));
      }
    return image;
  }

  double error_px(const std::vector<Eigen::Vector2d>& found, const Eigen::Matrix3d& H) const {
    double largest = 0;
    for (std::size_t c = 0; c < 4; ++c)
      largest = std::max(largest, (found.at(c) - *map_pixel(H, corners[c])).norm());
    return largest;
  }
};

/// Turned, scaled and moved about a pixel, with a vanishing line.
inline Eigen::Matrix3d view_of(const Eigen::Vector2d& about, double angle_rad, double scale,
                               const Eigen::Vector2d& shift, const Eigen::Vector2d& tilt) {
  Eigen::Matrix3d to = Eigen::Matrix3d::Identity(), from = to, M = to;
  to.topRightCorner<2, 1>() = about + shift;
  from.topRightCorner<2, 1>() = -about;
  M.topLeftCorner<2, 2>() << scale * std::cos(angle_rad), -scale * std::sin(angle_rad),
      scale * std::sin(angle_rad), scale * std::cos(angle_rad);
  M.bottomLeftCorner<1, 2>() = tilt.transpose();
  return to * M * from;
}

}  // namespace placegraph::test
