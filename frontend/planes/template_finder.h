#pragma once
#include <placegraph/frontend/features/wide_matcher.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/core/ransac.h>

namespace placegraph {

/// A proposed position of the template.
struct FoundPlace {
  Eigen::Matrix3d H_cur_ref;
  int inliers = 0;
};

/// Finds a planar region of one image anywhere in other images.
///
/// By point features and a homography that many of them agree with. The results are proposals that
/// an alignment must verify.
class TemplateFinder {
 public:
  /// Detects the features of the region.
  ///
  /// Throws ArgumentError for options out of range, an image that is not grey or a polygon of fewer
  /// than three corners.
  TemplateFinder(const Image& image_ref, const std::vector<Eigen::Vector2d>& polygon_px,
                 const TemplateFinderOptions& options);

  int features() const {
    return static_cast<int>(points_ref_.px.size());
  }  ///< features of the region
  /// Proposals in an image, most inliers first; empty if no homography has ransac.min_inliers.
  std::vector<FoundPlace> find(const Image& image_cur, Random& random) const;

 private:
  TemplateFinderOptions options_;
  WideBaselineFeatures points_ref_;
};

}  // namespace placegraph
