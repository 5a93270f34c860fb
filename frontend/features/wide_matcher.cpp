#include <placegraph/frontend/features/wide_matcher.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>

namespace placegraph {
namespace {

PointPair pair_of(const WideBaselineFeatures& a, int i, const WideBaselineFeatures& b, int j) {
  PointPair pair;
  pair.px_a = a.px[i];
  pair.px_b = b.px[j];
  const double angle = b.angle_rad[j] - a.angle_rad[i], scale = b.size_px[j] / a.size_px[i];
  pair.rotation_b_a << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  pair.rotation_b_a *= scale;
  return pair;
}

}  // namespace

WideBaselineFeatures detect_wide(const Image& image, const WideMatcherOptions& options,
                                 const Image& mask) {
  constexpr int kLayers = 3;
  const auto sift = cv::SIFT::create(options.max_features, kLayers, kLayers * options.min_contrast);
  std::vector<cv::KeyPoint> keys;
  WideBaselineFeatures points;
  sift->detectAndCompute(image, mask, keys, points.descriptors);
  for (int i = 0; i < points.descriptors.rows; ++i) {
    cv::Mat row = points.descriptors.row(i);
    const double sum = cv::norm(row, cv::NORM_L1);
    if (sum > 0) row /= sum;
    cv::sqrt(row, row);
  }
  for (const cv::KeyPoint& key : keys) {
    points.px.emplace_back(key.pt.x, key.pt.y);
    points.angle_rad.push_back(deg_to_rad(key.angle));
    points.size_px.push_back(key.size);
  }
  return points;
}

std::vector<PointPair> match_points(const WideBaselineFeatures& a, const WideBaselineFeatures& b,
                                    double max_ratio) {
  std::vector<PointPair> pairs;
  if (a.descriptors.rows < 2 || b.descriptors.rows < 2) return pairs;
  const cv::BFMatcher matcher(cv::NORM_L2);
  std::vector<std::vector<cv::DMatch>> forth;
  std::vector<cv::DMatch> back;
  matcher.knnMatch(a.descriptors, b.descriptors, forth, 2);
  matcher.match(b.descriptors, a.descriptors, back);
  for (const auto& best : forth) {
    if (best.size() < 2 || best[0].distance > max_ratio * best[1].distance) continue;
    if (back[best[0].trainIdx].trainIdx != best[0].queryIdx) continue;
    pairs.push_back(pair_of(a, best[0].queryIdx, b, best[0].trainIdx));
  }
  return pairs;
}

WideMatches match_wide(const Image& a, const Image& b, const WideMatcherOptions& options) {
  options.check();
  for (const Image* image : {&a, &b})
    require(!image->empty() && image->type() == CV_8UC1, "match_wide: grey images needed");
  WideMatches result;
  const std::vector<PointPair> all =
      match_points(detect_wide(a, options), detect_wide(b, options), options.max_ratio);
  result.candidates = static_cast<int>(all.size());
  const auto no_consensus = [&](int inliers) {
    result.outcome = Outcome::failure(
        Outcome::Code::kNoConsensus, std::to_string(inliers) + " of " + std::to_string(all.size()) +
                                         " point matches agree, " +
                                         std::to_string(options.min_inliers) + " needed");
    return result;
  };
  if (result.candidates < options.min_inliers) return no_consensus(0);
  std::vector<cv::Point2d> from, to;
  for (const PointPair& pair : all) {
    from.emplace_back(pair.px_a.x(), pair.px_a.y());
    to.emplace_back(pair.px_b.x(), pair.px_b.y());
  }
  std::vector<unsigned char> inlier;
  const cv::Mat F =
      cv::findFundamentalMat(from, to, cv::USAC_MAGSAC, options.epipolar_px, 0.9999, 10000, inlier);
  if (F.rows != 3) return no_consensus(0);
  for (int i = 0; i < 9; ++i) result.F_b_a(i / 3, i % 3) = F.at<double>(i / 3, i % 3);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (inlier[i]) result.pairs.push_back(all[i]);
  if (static_cast<int>(result.pairs.size()) < options.min_inliers)
    return no_consensus(static_cast<int>(result.pairs.size()));
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
