#include <placegraph/frontend/features/matcher.h>
#include <placegraph/frontend/places/cues/corner_agreement.h>
#include <placegraph/graph/core/function_clones.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Maximum Hamming distance of a match [bits of 256]. Chosen.
constexpr int kMaxCornerDistance = 70;
/// Maximum ratio of best to second best distance (Lowe 2004).
constexpr double kMaxCornerRatio = 0.8;
/// Maximum position error of an agreeing corner, as a share of the width. Chosen.
constexpr double kCornerTolerance = 0.06;

// Ratio of pyramid levels: ORB's (Rublee 2011).
constexpr float kOctave = 1.2f;

/// Matched points of two views, stored by coordinate so that several are tested at once.
struct MatchedPoints {
  std::vector<float> ax, ay, bx, by;
};

/// x_b = shift + [c -s; s c] x_a.
struct PlaneSimilarity {
  float c = 1, s = 0, x = 0, y = 0;
};

PLACEGRAPH_CLONES
int count_agreeing(const MatchedPoints& points, const PlaneSimilarity& similarity, float limit) {
  const std::size_t count = points.ax.size();
  const float *ax = points.ax.data(), *ay = points.ay.data();
  const float *bx = points.bx.data(), *by = points.by.data();
  const auto [c, s, x, y] = similarity;
  int agreeing = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float u = bx[i] - (x + c * ax[i] - s * ay[i]);
    const float v = by[i] - (y + s * ax[i] + c * ay[i]);
    agreeing += u * u + v * v < limit * limit;
  }
  return agreeing;
}

}  // namespace

std::vector<Feature> corners_of_view(const Image& grey, const CornerAgreementOptions& options) {
  cv::Mat sized = grey;
  if (grey.cols != options.width_px) {
    const int height = std::max(1, static_cast<int>(std::lround(static_cast<double>(grey.rows) *
                                                                options.width_px / grey.cols)));
    cv::resize(grey, sized, {options.width_px, height}, 0, 0,
               grey.cols > options.width_px ? cv::INTER_AREA : cv::INTER_CUBIC);
  }
  // The strongest corners anywhere: if they were spread over the image, fewer would be found again.
  constexpr int kOctaves = 6, kMargin = 16, kPatch = 31, kFastThreshold = 5;
  const auto orb = cv::ORB::create(options.max_corners, kOctave, kOctaves, kMargin, 0, 2,
                                   cv::ORB::HARRIS_SCORE, kPatch, kFastThreshold);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  orb->detectAndCompute(sized, cv::noArray(), keypoints, descriptors);
  std::vector<Feature> corners(keypoints.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    corners[i].px = {keypoints[i].pt.x, keypoints[i].pt.y};
    corners[i].angle_rad = keypoints[i].angle * std::numbers::pi_v<float> / 180;
    corners[i].octave = keypoints[i].octave;
    std::memcpy(corners[i].descriptor.data(), descriptors.ptr(static_cast<int>(i)),
                sizeof(BinaryDescriptor));
  }
  return corners;
}

int corner_agreement(const std::vector<Feature>& a, const std::vector<Feature>& b,
                     const CornerAgreementOptions& options) {
  const std::vector<FeatureMatch> matches =
      match_features(a, b, {.max_distance = kMaxCornerDistance, .max_ratio = kMaxCornerRatio});
  const auto limit = static_cast<float>(kCornerTolerance * options.width_px);
  MatchedPoints points;
  for (const FeatureMatch& match : matches) {
    const Eigen::Vector2f& in_a = a[static_cast<std::size_t>(match.a)].px;
    const Eigen::Vector2f& in_b = b[static_cast<std::size_t>(match.b)].px;
    points.ax.push_back(in_a.x());
    points.ay.push_back(in_a.y());
    points.bx.push_back(in_b.x());
    points.by.push_back(in_b.y());
  }
  int most = 0;
  for (const FeatureMatch& proposal : matches) {
    const Feature& from = a[static_cast<std::size_t>(proposal.a)];
    const Feature& to = b[static_cast<std::size_t>(proposal.b)];
    const float scale = std::pow(kOctave, static_cast<float>(to.octave - from.octave));
    const float angle_rad = to.angle_rad - from.angle_rad;
    const float c = scale * std::cos(angle_rad), s = scale * std::sin(angle_rad);
    most = std::max(most, count_agreeing(points,
                                         {c, s, to.px.x() - c * from.px.x() + s * from.px.y(),
                                          to.px.y() - s * from.px.x() - c * from.px.y()},
                                         limit));
  }
  return most;
}

}  // namespace placegraph
