#include <placegraph/frontend/align/null_distribution.h>
#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

namespace placegraph {
namespace {

using Eigen::Vector2d;

/// The part of an image within the bounding box of a polygon.
Image box_of(const Image& image, const std::vector<Vector2d>& polygon_px) {
  Vector2d low = polygon_px.at(0), high = low;
  for (const Vector2d& px : polygon_px) low = low.cwiseMin(px), high = high.cwiseMax(px);
  const auto within = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  const cv::Point from(within(low.x(), image.cols), within(low.y(), image.rows));
  const cv::Point to(within(high.x() + 1, image.cols), within(high.y() + 1, image.rows));
  return image(cv::Rect(from, to));
}

PlanarWarp shifted(const PlanarTemplate& planar_template, const Vector2d& by_px) {
  Eigen::Matrix3d H_cur_ref = Eigen::Matrix3d::Identity();
  H_cur_ref.topRightCorner<2, 1>() = by_px;
  return planar_template.homography(H_cur_ref);
}

/// White noise with the amplitudes of the patch's spectrum, repeated twice in both directions.
Image surrogate(const Image& patch, Random& random) {
  Image grey, noise(patch.size(), CV_32FC1);
  patch.convertTo(grey, CV_32F);
  const double mean = cv::mean(grey)[0];
  grey -= mean;
  for (int v = 0; v < noise.rows; ++v)
    for (int u = 0; u < noise.cols; ++u)
      noise.at<float>(v, u) = static_cast<float>(random.normal());
  cv::dft(grey, grey, cv::DFT_COMPLEX_OUTPUT);
  cv::dft(noise, noise, cv::DFT_COMPLEX_OUTPUT);
  for (int v = 0; v < noise.rows; ++v)
    for (int u = 0; u < noise.cols; ++u) {
      auto& phase = noise.at<cv::Vec2f>(v, u);
      const double size = cv::norm(phase), wanted = cv::norm(grey.at<cv::Vec2f>(v, u));
      phase *= size > 0 ? static_cast<float>(wanted / size) : 0.0f;
    }
  cv::idft(noise, noise, cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
  noise += mean;
  Image picture, tiled;
  noise.convertTo(picture, CV_8U);
  cv::repeat(picture, 2, 2, tiled);
  return tiled;
}

/// Statistics over surrogate images with the patch's spectrum; alignments start near their centre.
void ask_surrogates(const Image& patch, const PlanarTemplate& planar_template,
                    const AlignOptions& options, int trials, Random& random,
                    NullDistribution& chance) {
  const Vector2d size(patch.cols, patch.rows);
  double sum = 0, squares = 0;
  for (int i = 0; i < trials; ++i) {
    const Image picture = surrogate(patch, random);
    const Vector2d aside(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2));
    const Vector2d to = size - planar_template.centre_px() + aside.cwiseProduct(size);
    const AlignResult end = align(planar_template, picture, shifted(planar_template, to), options);
    if (end.robust_similarity == 0) continue;
    sum += end.robust_similarity, squares += end.robust_similarity * end.robust_similarity;
    ++chance.trials;
  }
  if (chance.trials < 2) return;
  chance.mean = sum / chance.trials;
  chance.deviation = std::sqrt(std::max(0.0, (squares - sum * chance.mean) / (chance.trials - 1)));
}

/// Greatest similarity away from the true position, from starts a quarter to a whole side off.
double best_rival(const Image& image_ref, const PlanarTemplate& planar_template,
                  const AlignOptions& options, int trials, Random& random) {
  // Distance of another place of the template. Chosen.
  constexpr double kElsewherePx = 3;
  const auto& corners = planar_template.corners_px();
  const double side = (corners[2] - corners[0]).norm() / std::sqrt(2.0);
  double rival = 0;
  for (int i = 0; i < trials; ++i) {
    const double angle = random.uniform(0, 2 * std::numbers::pi),
                 far = random.uniform(0.25, 1) * side;
    const Vector2d aside = far * Vector2d(std::cos(angle), std::sin(angle));
    const AlignResult end =
        align(planar_template, image_ref, shifted(planar_template, aside), options);
    if (planar_template.corner_distance_px(end.warp.H_cur_ref(), Eigen::Matrix3d::Identity()) >
        kElsewherePx)
      rival = std::max(rival, end.robust_similarity);
  }
  return rival;
}

}  // namespace

NullDistribution null_distribution(const Image& image_ref, const std::vector<Vector2d>& polygon_px,
                                   const PlanarTemplate& planar_template,
                                   const AlignOptions& options, int trials) {
  require(trials >= 2, "null_distribution: at least two trials needed");
  const Image patch = box_of(image_ref, polygon_px);
  NullDistribution chance;
  if (patch.rows < 2 || patch.cols < 2) return chance;
  Random random(options.swarm.seed);
  ask_surrogates(patch, planar_template, options, trials, random, chance);
  chance.rival = best_rival(image_ref, planar_template, options, trials, random);
  return chance;
}

}  // namespace placegraph
