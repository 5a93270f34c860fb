#include <placegraph/frontend/planes/homography_fit.h>
#include <placegraph/frontend/planes/template_finder.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

using Eigen::Matrix3d;

RansacResult<Matrix3d> homography_of(const PointMatches& matches,
                                     const TemplateFinderOptions& options, Random& random) {
  const auto solve = [&](const std::vector<int>& sample) {
    std::vector<Matrix3d> models;
    if (const auto H = homography_through(matches, {sample[0], sample[1], sample[2], sample[3]}))
      models.push_back(*H);
    return models;
  };
  const auto squared_error = [&](const Matrix3d& H, int i) {
    const auto k = static_cast<std::size_t>(i);
    return transfer_error(H, matches.px_ref[k], matches.px_cur[k]).squared;
  };
  const auto refine = [&](const Matrix3d& H, const std::vector<int>& inliers) {
    const HomographyFit fit = refine_homography(H, matches, inliers, TransferNoise{}, 5);
    return fit.outcome ? fit.H_cur_ref : H;
  };
  return ransac<Matrix3d>(matches.size(), 4, options.inlier_px * options.inlier_px, options.ransac,
                          random, solve, squared_error, refine);
}

PointMatches without(const PointMatches& matches, const std::vector<int>& gone) {
  PointMatches rest;
  for (int i = 0; i < matches.size(); ++i) {
    if (std::binary_search(gone.begin(), gone.end(), i)) continue;
    rest.px_ref.push_back(matches.px_ref[static_cast<std::size_t>(i)]);
    rest.px_cur.push_back(matches.px_cur[static_cast<std::size_t>(i)]);
  }
  return rest;
}

}  // namespace

TemplateFinder::TemplateFinder(const Image& image_ref,
                               const std::vector<Eigen::Vector2d>& polygon_px,
                               const TemplateFinderOptions& options)
    : options_(options) {
  options.check();
  require(image_ref.type() == CV_8UC1, "template finder: grey image needed");
  require(polygon_px.size() >= 3, "template finder: a polygon has at least three corners");
  std::vector<cv::Point> corners;
  for (const Eigen::Vector2d& px : polygon_px)
    corners.emplace_back(static_cast<int>(std::lround(px.x())),
                         static_cast<int>(std::lround(px.y())));
  Image mask = Image::zeros(image_ref.size(), CV_8UC1);
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(255));
  points_ref_ = detect_wide(image_ref, options.features, mask);
}

std::vector<FoundPlace> TemplateFinder::find(const Image& image_cur, Random& random) const {
  std::vector<FoundPlace> places;
  PointMatches matches;
  if (features() < options_.ransac.min_inliers) return places;
  for (const PointPair& pair : match_points(points_ref_, detect_wide(image_cur, options_.features),
                                            options_.features.max_ratio)) {
    matches.px_ref.push_back(pair.px_a);
    matches.px_cur.push_back(pair.px_b);
  }
  while (static_cast<int>(places.size()) < options_.places) {
    const RansacResult<Matrix3d> found = homography_of(matches, options_, random);
    if (!found.outcome) break;
    places.push_back({found.model, static_cast<int>(found.inliers.size())});
    matches = without(matches, found.inliers);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const FoundPlace& a, const FoundPlace& b) { return a.inliers > b.inliers; });
  return places;
}

}  // namespace placegraph
