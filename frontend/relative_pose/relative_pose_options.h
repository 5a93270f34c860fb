#pragma once
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Pose of a camera from 3-D points and their pixels.
struct Pose3d2dOptions {
  /// Three-point hypotheses.
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 12};
  double threshold_px = 2.5;  ///< maximum reprojection error of an inlier
  /// RANSAC is skipped if this share of the points are inliers of the predicted pose; above 1:
  /// never.
  double prior_inlier_ratio = 0.7;
  void check() const;
};
void visit(OptionVisitor& field, Pose3d2dOptions& options);

/// Relative pose of two images from matched pixels, by essential matrix or homography.
struct Pose2d2dOptions {
  /// Five-point and four-point hypotheses.
  RansacOptions ransac{.max_iterations = 300, .confidence = 0.999, .min_inliers = 30};
  double threshold_px = 1.0;  ///< maximum epipolar distance or transfer error of an inlier
  /// Share S_H / (S_H + S_E) of the homography's score above which the scene counts as planar.
  double homography_share = 0.45;
  void check() const;
};
void visit(OptionVisitor& field, Pose2d2dOptions& options);

/// Rotation between two images of a camera that does not translate.
struct Rotation2d2dOptions {
  /// Two-point hypotheses.
  RansacOptions ransac{.max_iterations = 100, .confidence = 0.999, .min_inliers = 30};
  double threshold_px = 1.5;  ///< maximum distance of an inlier from its rotated position
  /// Minimum share of the matches that a pure rotation must explain; with fewer the camera has
  /// translated. The other matches include moving objects.
  double min_inlier_share = 0.85;
  void check() const;
};
void visit(OptionVisitor& field, Rotation2d2dOptions& options);

/// Initialization of a map from two images of a monocular camera.
struct MonoInitializerOptions {
  Pose2d2dOptions two_view;       ///< the relative pose
  double min_parallax_deg = 0.6;  ///< minimum angle between the two rays of a point
  int min_points = 50;            ///< minimum number of triangulated points with that angle
  void check() const;
};
void visit(OptionVisitor& field, MonoInitializerOptions& options);

/// Model of the relative pose of two views; `kAuto` selects one.
enum class RelativePoseModel { kAuto, kEssential, kHomography, kRotation };

/// Names of the models, "auto", "essential", ..., in the order of the enum.
const std::vector<std::string>& relative_pose_model_names();

/// Options of the relative pose of two views.
struct RelativePoseOptions {
  RelativePoseModel model = RelativePoseModel::kAuto;
  Pose2d2dOptions two_view;
  Rotation2d2dOptions rotation;
  MotionFromPlanesOptions plane;
  double min_parallax_px = 1.0;  ///< least median displacement for a translation
  double ambiguity = 0.8;  ///< share of the best motion's points that makes a second one a rival
  void check() const;
};
void visit(OptionVisitor& field, RelativePoseOptions& options);

}  // namespace placegraph
