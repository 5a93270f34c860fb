#include <placegraph/frontend/relative_pose/relative_pose_options.h>

namespace placegraph {

void Pose3d2dOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, Pose3d2dOptions& o) {
  field.group("ransac", o.ransac, "three-point hypotheses");
  field("threshold_px", o.threshold_px, "inliers reproject within this", {0.1, 50});
  field("prior_inlier_ratio", o.prior_inlier_ratio,
        "a predicted pose that explains this share of the points spares the RANSAC", {0, 1.01});
}

void Pose2d2dOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, Pose2d2dOptions& o) {
  field.group("ransac", o.ransac, "five-point and four-point hypotheses");
  field("threshold_px", o.threshold_px, "inliers lie this close", {0.1, 20});
  field("homography_share", o.homography_share,
        "S_H / (S_H + S_E) above which the scene counts as planar", {0, 1});
}

void Rotation2d2dOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, Rotation2d2dOptions& o) {
  field.group("ransac", o.ransac, "two-point hypotheses");
  field("threshold_px", o.threshold_px, "inliers lie this close", {0.1, 20});
  field("min_inlier_share", o.min_inlier_share,
        "of the points that a rotation must explain where no way has been made", {0, 1});
}

void MonoInitializerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MonoInitializerOptions& o) {
  field.group("two_view", o.two_view, "essential matrix and homography");
  field("min_parallax_deg", o.min_parallax_deg, "angle between the rays that min_points must have",
        {0.01, 45});
  field("min_points", o.min_points, "points of that parallax", {8, 100000});
  field("max_error_px", o.max_error_px, "reprojection error of a triangulated point", {0.1, 20});
  field("ambiguity", o.ambiguity, "share of the best motion's points that makes another a rival",
        {0, 1});
}

}  // namespace placegraph
