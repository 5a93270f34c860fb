#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/run_options.h>

namespace placegraph {

void LensOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LensOptions& o) {
  field("enabled", o.enabled,
        "one eye or a depth camera: where the images prove to be distorted, the run begins again "
        "with undistorted ones");
  field("min_sigmas", o.min_sigmas, "radial distortion over its deviation that counts as proof",
        {0, 1e6});
  field("min_effect", o.min_effect,
        "of it on the tracks, rms in their standard deviations, that nothing else would explain",
        {0, 1e6});
}

void MotionOptions::check() const {
  check_ranges(*this);
  require(T_cam_body.size() == 7, "T_cam_body: seven numbers needed, tx ty tz qx qy qz qw");
  const Eigen::Map<const Eigen::Vector4d> q(T_cam_body.data() + 3);
  require(std::abs(q.norm() - 1) < 1e-2, "T_cam_body: the quaternion is not of unit length");
}

void visit(OptionVisitor& field, MotionOptions& o) {
  field("file", o.file, "see docs/odometry.md; none if empty");
  field("T_cam_body", o.T_cam_body, "tx ty tz qx qy qz qw of the body in the camera [m]");
  field.group("noise", o.noise, "where the file tells none");
}

void visit(OptionVisitor& field, SceneOptions& o) {
  field("geometry", o.geometry, "a floor plan with walls, doors and rooms, at the end");
  field("semantics", o.semantics, "a map of what is where in a street, at the end");
  field("urban_model", o.urban_model, "model of a street's classes; empty: the program's own");
  field("surfaces_model", o.surfaces_model, "model of surfaces; empty: the program's own");
  field.group("indoor", o.indoor, "the floor plan");
  field.group("urban", o.urban, "the map of a street");
}

void RunOptions::check() const {
  check_ranges(*this);
  slam.check();
}

void visit(OptionVisitor& field, RunOptions& o) {
  field.choice("sensor", o.sensor, {"auto", "mono", "stereo", "rgbd"},
               "what the sequence is run as; auto: the best it offers");
  field("camera_height_m", o.camera_height_m,
        "of the camera above the ground; 0: as the sequence says, or unknown", {0, 1000});
  field("first_frame", o.first_frame, "frames left out at the beginning", {0, 1e9});
  field("max_frames", o.max_frames, "frames run; 0: all", {0, 1e9});
  field("threads", o.threads, "threads; the result does not depend on it", {1, 256});
  field.group("motion", o.motion, "motion that other sensors measured");
  field.group("lens", o.lens, "self-calibration of one eye's radial distortion");
  field.group("scene", o.scene, "what is made of the scene beside the places");
  visit(field, o.slam);
}

}  // namespace placegraph
