#include <placegraph/frontend/floor_plan/depth_agreement.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace {

/// Marks pixels whose neighbourhood is distinct and has the same depth.
void mark_certain(const std::vector<PixelDepth>& found, const SweepGeometry& geometry,
                  SweptDepth& result) {
  const Camera& camera = geometry.camera;
  // Pixels on either side that are asked. Chosen.
  constexpr int kReach = 2;
  const auto at = [&](int u, int v) -> const PixelDepth& {
    return found[static_cast<std::size_t>(v) * camera.width + u];
  };
  for (int v = kReach; v + kReach < camera.height; ++v)
    for (int u = kReach; u + kReach < camera.width; ++u) {
      const double depth = at(u, v).inverse_depth;
      bool certain = result.depth_m.at<float>(v, u) > 0;
      for (int y = v - kReach; certain && y <= v + kReach; ++y)
        for (int x = u - kReach; certain && x <= u + kReach; ++x)
          certain = at(x, y).distinct && result.depth_m.at<float>(y, x) > 0 &&
                    std::abs(at(x, y).inverse_depth - depth) < 3 * geometry.step;
      if (certain) result.certain.at<std::uint8_t>(v, u) = 255;
    }
}

}  // namespace

SweptDepth agreed_depth(const std::vector<PixelDepth>& found, const SweepGeometry& geometry,
                        double sigma_px) {
  const Camera& camera = geometry.camera;
  const cv::Size size(camera.width, camera.height);
  SweptDepth result{camera, Image(size, CV_32FC1, cv::Scalar(0)),
                    Image(size, CV_32FC1, cv::Scalar(0)), Image(size, CV_8UC1, cv::Scalar(0))};
  std::vector<Image> shown(geometry.views.size());
  const auto pixel_of = [&](const SweepGeometry::View& view, int u, int v, double inverse_depth) {
    const Eigen::Vector3d p = view.at(u, v, inverse_depth);
    return p[2] < SweepGeometry::kBehind ? cv::Point(-1, -1)
                                         : cv::Point(cvRound(p[0] / p[2]), cvRound(p[1] / p[2]));
  };
  const auto inside = [&](const cv::Point& p) {
    return p.x >= 0 && p.y >= 0 && p.x < camera.width && p.y < camera.height;
  };
  const auto each = [&](const auto& visit_samples) {
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u)
        if (const PixelDepth& level = found[static_cast<std::size_t>(v) * camera.width + u];
            level.inverse_depth > 0)
          visit_samples(u, v, level);
  };
  for (std::size_t i = 0; i < geometry.views.size(); ++i) {
    shown[i] = Image(size, CV_32FC2, cv::Scalar(0, 1e9));
    each([&](int u, int v, const PixelDepth& level) {
      const cv::Point at = pixel_of(geometry.views[i], u, v, level.inverse_depth);
      if (!inside(at)) return;
      cv::Vec2f& best = shown[i].at<cv::Vec2f>(at);
      if (level.cost < best[1])
        best = {static_cast<float>(level.inverse_depth), static_cast<float>(level.cost)};
    });
  }
  each([&](int u, int v, const PixelDepth& level) {
    double information = 0;
    std::size_t agreed = 0;
    for (std::size_t i = 0; i < geometry.views.size(); ++i) {
      const cv::Point at = pixel_of(geometry.views[i], u, v, level.inverse_depth);
      if (!inside(at)) continue;
      if (std::abs(shown[i].at<cv::Vec2f>(at)[0] - level.inverse_depth) > 1.5 * geometry.step)
        continue;
      information += std::pow(geometry.views[i].rate(u, v, level.inverse_depth) / sigma_px, 2);
      ++agreed;
    }
    // Around the point that the camera moves towards the depth is not observable.
    constexpr double kMostDeviation = 0.2;  // standard deviation of a depth, as a share of it
    const double sigma = 1 / std::sqrt(information);
    if (agreed < geometry.better_half() || !(sigma < kMostDeviation * level.inverse_depth)) return;
    result.depth_m.at<float>(v, u) = static_cast<float>(1 / level.inverse_depth);
    result.sigma_inverse.at<float>(v, u) = static_cast<float>(sigma);
  });
  mark_certain(found, geometry, result);
  return result;
}

}  // namespace placegraph
