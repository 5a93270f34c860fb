#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>

namespace [[gnu::visibility("default")]] placegraph {

struct Pose3d2dOptions {
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 12};
  double threshold_px = 2.5;        ///< inliers reproject within this
  double prior_inlier_ratio = 0.7;  ///< a prior that explains this share spares the RANSAC
  void check() const;
};
void visit(OptionVisitor& field, Pose3d2dOptions& options);

struct Pose2d2dOptions {
  RansacOptions ransac{.max_iterations = 300, .confidence = 0.999, .min_inliers = 30};
  double threshold_px = 1.0;  ///< distance to the epipolar line, or transfer by the homography
  double homography_share =
      0.45;  ///< R_H = S_H / (S_H + S_E) above which the scene counts as planar
  void check() const;
};
void visit(OptionVisitor& field, Pose2d2dOptions& options);

struct Rotation2d2dOptions {
  RansacOptions ransac{.max_iterations = 100, .confidence = 0.999, .min_inliers = 30};
  double threshold_px = 1.5;  ///< between a pixel and where the rotation carries it
  /// Of the matches that a rotation must explain, so that no way has been made; things that move
  /// on their own are among the others.
  double min_inlier_share = 0.85;
  void check() const;
};
void visit(OptionVisitor& field, Rotation2d2dOptions& options);

struct MonoInitializerOptions {
  Pose2d2dOptions two_view;
  double min_parallax_deg = 0.6;  ///< that min_points must have
  int min_points = 50;
  double max_error_px = 1.5;  ///< reprojection error of a triangulated point
  double ambiguity = 0.8;  ///< a second motion with this share of the best one's points is a rival
  void check() const;
};
void visit(OptionVisitor& field, MonoInitializerOptions& options);

}  // namespace placegraph
