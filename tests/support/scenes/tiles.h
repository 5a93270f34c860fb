#pragma once
#include <placegraph/graph/geometry/line_segment.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "tests/support/scenes/texture.h"

namespace placegraph::test {

/// A step from dark to bright across a line, as a lens of the given blur shows it.
inline double step(double distance, double blur) {
  return 0.5 * (1 + std::erf(distance / (std::sqrt(2.0) * blur)));
}

/// Two half planes: bright where n^T p > offset with n = (cos angle, sin angle).
inline Image half_planes(int width, int height, double angle, double offset, double dark = 60,
                         double bright = 180, double blur = 0.8) {
  Image image(height, width, CV_8UC1);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      image.at<std::uint8_t>(v, u) = to_grey(
          dark + (bright - dark) * step(std::cos(angle) * u + std::sin(angle) * v - offset, blur));
  return image;
}

/// Rectangles of different greys on a weakly textured wall: where lines are known exactly.
struct TiledWall {
  struct Tile {
    Eigen::Vector2d low, high;
    double grey = 0;
  };
  std::vector<Tile> tiles;
  Texture texture{.seed = 3, .wavelength = 24, .octaves = 3, .contrast = 12, .mean = 120};

  /// Tiles of random size and grey in a grid, none touching another.
  TiledWall(int columns, int rows, double cell, Random& random) {
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        Tile tile;
        const Eigen::Vector2d corner(i * cell, j * cell);
        tile.low =
            corner + cell * Eigen::Vector2d(random.uniform(0.1, 0.3), random.uniform(0.1, 0.3));
        tile.high =
            corner + cell * Eigen::Vector2d(random.uniform(0.65, 0.9), random.uniform(0.65, 0.9));
        tile.grey = random.uniform(0, 1) < 0.5 ? random.uniform(25, 80) : random.uniform(170, 235);
        tiles.push_back(tile);
      }
  }

  double grey(const Eigen::Vector2d& p, double blur = 0.7) const {
    double value = texture.grey(p.x(), p.y());
    for (const Tile& tile : tiles) {
      if ((p - tile.low).minCoeff() < -4 || (tile.high - p).minCoeff() < -4) continue;
      const Eigen::Vector2d from = p - tile.low, to = tile.high - p;
      const double inside =
          step(from.x(), blur) * step(from.y(), blur) * step(to.x(), blur) * step(to.y(), blur);
      value += inside * (tile.grey - value);
    }
    return value;
  }

  /// The wall in an image: px ~ H_image_wall wall.
  Image seen(int width, int height, const Eigen::Matrix3d& H_image_wall) const {
    const Eigen::Matrix3d H_wall_image = H_image_wall.inverse();
    Image image(height, width, CV_8UC1);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u)
        image.at<std::uint8_t>(v, u) =
            to_grey(grey((H_wall_image * Eigen::Vector3d(u, v, 1)).hnormalized()));
    return image;
  }

  /// The edges of all tiles in an image, four a tile.
  std::vector<LineSegment> edges(const Eigen::Matrix3d& H_image_wall) const {
    std::vector<LineSegment> result;
    const auto at = [&](double x, double y) -> Eigen::Vector2d {
      return (H_image_wall * Eigen::Vector3d(x, y, 1)).hnormalized();
    };
    for (const Tile& t : tiles) {
      const Eigen::Vector2d a = at(t.low.x(), t.low.y()), b = at(t.high.x(), t.low.y());
      const Eigen::Vector2d c = at(t.high.x(), t.high.y()), d = at(t.low.x(), t.high.y());
      for (const auto& [p, q] :
           {std::pair(a, b), std::pair(b, c), std::pair(c, d), std::pair(d, a)})
        result.push_back({p, q});
    }
    return result;
  }
};

}  // namespace placegraph::test
