#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace placegraph::test {

/// Smooth grey values over a plane, defined at every real coordinate: octaves of random values on a
/// square lattice with quintic interpolation. The coarsest lattice has the side `wavelength`, every
/// octave half of the one before.
struct Texture {
  std::uint64_t seed = 1;
  double wavelength = 1;
  int octaves = 3;
  double contrast = 60;  ///< grey levels, of one octave
  double mean = 128;

  /// Octaves finer than four times `footprint` (the size of a pixel there) fade out, so that no
  /// picture holds what its pixels cannot show.
  double grey(double x, double y, double footprint = 0) const {
    double value = mean, side = wavelength;
    for (int octave = 0; octave < octaves; ++octave, side /= 2) {
      const double share = footprint > 0 ? std::clamp((side / footprint - 2) / 2, 0.0, 1.0) : 1.0;
      if (share == 0) break;
      value += share * contrast * noise(x / side, y / side, seed * 16 + octave);
    }
    return value;
  }

 private:
  static double lattice(std::int64_t i, std::int64_t j, std::uint64_t key) {
    std::uint64_t h = key * 0x9E3779B97F4A7C15ull ^
                      static_cast<std::uint64_t>(i) * 0xBF58476D1CE4E5B9ull ^
                      static_cast<std::uint64_t>(j) * 0x94D049BB133111EBull;
    h = (h ^ (h >> 31)) * 0xD6E8FEB86659FD93ull;
    h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9ull;
    return static_cast<double>((h ^ (h >> 32)) >> 11) * (2.0 / 9007199254740992.0) - 1;
  }
  static double noise(double x, double y, std::uint64_t key) {
    const double fx = std::floor(x), fy = std::floor(y);
    const auto i = static_cast<std::int64_t>(fx), j = static_cast<std::int64_t>(fy);
    const auto ease = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
    const double a = ease(x - fx), b = ease(y - fy);
    const double top = lattice(i, j, key) * (1 - a) + lattice(i + 1, j, key) * a;
    const double bottom = lattice(i, j + 1, key) * (1 - a) + lattice(i + 1, j + 1, key) * a;
    return top * (1 - b) + bottom * b;
  }
};

inline std::uint8_t to_grey(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

/// The texture seen straight on, one unit a pixel: pixel (u, v) shows (u + shift_u, v + shift_v).
inline Image texture_image(int width, int height, const Texture& texture, double shift_u = 0,
                           double shift_v = 0) {
  Image image(height, width, CV_8UC1);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      image.at<std::uint8_t>(v, u) = to_grey(texture.grey(u + shift_u, v + shift_v));
  return image;
}

/// A rectangle in space that carries a texture [m]: z = 0 of its own frame, around its origin.
struct TexturedPlane {
  SE3 T_world_plane;
  double half_x_m = 1e3, half_y_m = 1e3;
  Texture texture;
};

struct Picture {
  Image grey;   ///< CV_8UC1, 0 where nothing is seen
  Image depth;  ///< CV_32FC1 [m], 0 where nothing is seen
};

/// What an undistorted camera sees: the nearest plane along the ray of every pixel centre. Grey is
/// the mean of `rows_per_pixel` rays one above the other, which a road seen at a grazing angle
/// needs (its far rows would be samples of a texture finer than themselves); depth is that of the
/// centre.
inline Picture render(const Camera& camera, const SE3& T_world_cam,
                      const std::vector<TexturedPlane>& planes, int rows_per_pixel = 1) {
  struct Local {
    Eigen::Vector3d origin;  // the camera in the plane's frame
    Eigen::Matrix3d R;       // from the camera to the plane
  };
  std::vector<Local> locals;
  for (const TexturedPlane& plane : planes) {
    const SE3 T_plane_cam = plane.T_world_plane.inverse() * T_world_cam;
    locals.push_back({T_plane_cam.translation(), T_plane_cam.rotation().matrix()});
  }
  struct Hit {
    double depth = 0, grey = 0;
  };
  const auto sample_at = [&](double u, double v) {
    const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
    double nearest = 1e9;
    int hit = -1;
    Eigen::Vector3d where = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const double depth = -locals[i].origin.z() / locals[i].R.row(2).dot(ray);
      if (!(depth > 1e-3 && depth < nearest)) continue;
      const Eigen::Vector3d p = locals[i].origin + depth * (locals[i].R * ray);
      if (std::abs(p.x()) > planes[i].half_x_m || std::abs(p.y()) > planes[i].half_y_m) continue;
      nearest = depth, hit = static_cast<int>(i), where = p;
    }
    if (hit < 0) return Hit{};
    const Texture& texture = planes[static_cast<std::size_t>(hit)].texture;
    return Hit{nearest, texture.grey(where.x(), where.y(), nearest / camera.fx)};
  };
  Picture picture{Image::zeros(camera.height, camera.width, CV_8UC1),
                  Image::zeros(camera.height, camera.width, CV_32FC1)};
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      double grey = 0;
      for (int k = 0; k < rows_per_pixel; ++k)
        grey += sample_at(u, v + (k + 0.5) / rows_per_pixel - 0.5).grey / rows_per_pixel;
      picture.grey.at<std::uint8_t>(v, u) = to_grey(grey);
      picture.depth.at<float>(v, u) = static_cast<float>(sample_at(u, v).depth);
    }
  return picture;
}

/// The image in a mirror: left is right.
inline Image flipped(const Image& image) {
  Image result;
  cv::flip(image, result, 1);
  return result;
}

/// gain * image + bias + Gaussian noise of `sigma` grey levels.
inline Image disturbed(const Image& image, double sigma, Random& random, double gain = 1,
                       double bias = 0) {
  Image noisy = image.clone();
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u)
      noisy.at<std::uint8_t>(v, u) =
          to_grey(gain * image.at<std::uint8_t>(v, u) + bias + random.normal(0, sigma));
  return noisy;
}

}  // namespace placegraph::test
