#include <placegraph/frontend/relative_pose/relative_pose_options.h>

namespace placegraph {

void Pose3d2dOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, Pose3d2dOptions& o) {
  field.internal().group("ransac", o.ransac, "three-point hypotheses");
  field("threshold_px", o.threshold_px, "maximum reprojection error of an inlier [px]", {0.1, 50});
  field("prior_inlier_ratio", o.prior_inlier_ratio,
        "share of inliers of the predicted pose that makes RANSAC unnecessary; >1: never",
        {0, 1.01});
}

void Pose2d2dOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, Pose2d2dOptions& o) {
  field.internal().group("ransac", o.ransac, "five-point and four-point hypotheses");
  field("threshold_px", o.threshold_px,
        "maximum epipolar distance or transfer error of an inlier [px]", {0.1, 20});
  field("homography_share", o.homography_share,
        "share S_H / (S_H + S_E) above which the scene counts as planar", {0, 1});
}

void Rotation2d2dOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, Rotation2d2dOptions& o) {
  field.internal().group("ransac", o.ransac, "two-point hypotheses");
  field("threshold_px", o.threshold_px,
        "maximum distance of an inlier from its rotated position [px]", {0.1, 20});
  field("min_inlier_share", o.min_inlier_share,
        "minimum share of the matches that a pure rotation must explain", {0, 1});
}

void MonoInitializerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MonoInitializerOptions& o) {
  field.group("two_view", o.two_view, "essential matrix and homography");
  field("min_parallax_deg", o.min_parallax_deg,
        "minimum angle between the two rays of a point [deg]", {0.01, 45});
  field("min_points", o.min_points, "minimum number of triangulated points with that angle",
        {8, 100000});
  field.retired({{"max_error_px", 1.5}, {"ambiguity", 0.8}});
}

const std::vector<std::string>& relative_pose_model_names() {
  static const std::vector<std::string> names = {"auto", "essential", "homography", "rotation"};
  return names;
}

void RelativePoseOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, RelativePoseOptions& o) {
  field.choice("model", o.model, relative_pose_model_names(), "model of the relative pose");
  field.group("two_view", o.two_view, "essential matrix and homography");
  field.group("rotation", o.rotation, "pure rotation");
  field.group("plane", o.plane, "motion before one plane");
  field("min_parallax_px", o.min_parallax_px, "minimum median displacement for a translation [px]",
        {0, 100});
  field("ambiguity", o.ambiguity,
        "share of the best motion's points that makes a second motion a rival", {0, 1});
}

}  // namespace placegraph
