#pragma once
#include <placegraph/frontend/internal/planes/homography.h>
#include <placegraph/graph/core/options.h>

#include <array>
#include <vector>

namespace placegraph {

struct PlaneNormalOptions {
  int views = 24;            ///< kept at most
  double apart_px = 4;       ///< from every kept view, for another to be kept
  double sigma_px = 0.3;     ///< of a corner, at least
  double max_sigma_deg = 5;  ///< of the normal, to be of use
  double distinct_deg = 8;   ///< two readings closer than this are one
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, PlaneNormalOptions& options);

/// A plane's unit normal in the reference camera, told from homographies to several views.
struct PlaneNormal {
  /// kTooFewData: no view yet that is apart from the reference; kDegenerate: the views leave the
  /// normal open (no parallax), or two readings of them are as good as each other.
  Outcome outcome;
  Eigen::Vector3d normal_ref = Eigen::Vector3d::UnitZ();
  double sigma_rad = 0;  ///< in its more uncertain direction
  int views = 0;
};

/// One homography has two readings (Malis & Vargas 2007), but the normal of the reference is the
/// same for all views: it is the one under which the motions that motion_from_homography gives
/// explain best where the region's corners went, by least squares over the normal's two degrees of
/// freedom, started from every reading of every view.
class PlaneNormalEstimator {
 public:
  PlaneNormalEstimator(const Eigen::Matrix3d& K, const std::vector<Eigen::Vector2d>& corners_ref_px,
                       const PlaneNormalOptions& options);
  /// True if the view was kept. The corners must be in front of both cameras.
  bool add(const Eigen::Matrix3d& H_cur_ref);
  PlaneNormal estimate() const;

 private:
  double apart_px(const Eigen::Matrix3d& Ha, const Eigen::Matrix3d& Hb) const;

  Eigen::Matrix3d K_;
  std::vector<Eigen::Vector2d> corners_px_;
  PlaneNormalOptions options_;
  double spacing_px_;
  std::vector<Eigen::Matrix3d> views_;
};

}  // namespace placegraph
