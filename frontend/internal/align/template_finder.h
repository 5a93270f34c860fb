#pragma once
#include <placegraph/frontend/internal/features/wide_matcher.h>
#include <placegraph/graph/internal/core/random.h>
#include <placegraph/graph/internal/core/ransac.h>

namespace placegraph {

struct TemplateFinderOptions {
  WideMatcherOptions features;  ///< its geometry is not asked
  double inlier_px = 3;         ///< symmetric transfer error of a match that agrees
  RansacOptions ransac{2000, 0.999, 8};
  int places = 3;  ///< at most, each by the matches that those before leave
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, TemplateFinderOptions& options);

struct FoundPlace {
  Eigen::Matrix3d H_cur_ref;
  int inliers = 0;
};

/// Finds a planar region of one image in others, wherever it went, by point features and a
/// homography that many of them agree on. It proposes; whether the region is really there an
/// alignment has to say.
class TemplateFinder {
 public:
  /// Throws ArgumentError for options out of range, an image that is not grey or a polygon of fewer
  /// than three corners.
  TemplateFinder(const Image& image_ref, const std::vector<Eigen::Vector2d>& polygon_px,
                 const TemplateFinderOptions& options);

  int features() const { return static_cast<int>(points_ref_.px.size()); }  ///< of the region
  /// Those with the most matches first; empty where no homography has ransac.min_inliers.
  std::vector<FoundPlace> find(const Image& image_cur, Random& random) const;

 private:
  TemplateFinderOptions options_;
  WideBaselineFeatures points_ref_;
};

}  // namespace placegraph
