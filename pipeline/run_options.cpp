#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/run_options.h>

namespace placegraph {

void LensOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LensOptions& o) {
  field.basic()("enabled", o.enabled,
                "monocular or RGB-D: restart with undistorted images if distortion is detected");
  field("max_frames", o.max_frames,
        "number of frames within which the run may restart, or a fifth of the sequence if that is "
        "more; later distortion is only reported",
        {0, 1e9});
  field.internal()("min_sigmas", o.min_sigmas,
                   "minimum |k1| over its standard deviation for a lens to count as distorted",
                   {0, 1e6});
  field.internal()(
      "min_effect", o.min_effect,
      "minimum unexplained RMS displacement of the tracks by k1, in standard deviations", {0, 1e6});
}

void MotionOptions::check() const {
  check_ranges(*this);
  require(T_cam_body.size() == 7, "T_cam_body: seven numbers needed, tx ty tz qx qy qz qw");
  const Eigen::Map<const Eigen::Vector4d> q(T_cam_body.data() + 3);
  require(std::abs(q.norm() - 1) < 1e-2, "T_cam_body: the quaternion is not of unit length");
}

void visit(OptionVisitor& field, MotionOptions& o) {
  field.basic()("file", o.file, "path of a motion file (docs/other_sensors.md); empty: none");
  field.basic()("T_cam_body", o.T_cam_body,
                "pose of the body in the camera frame: tx ty tz [m] qx qy qz qw");
  field.group("noise", o.noise, "noise of the motion where the file states none");
}

void visit(OptionVisitor& field, SceneOptions& o) {
  field.basic()("geometry", o.geometry,
                "build a floor plan with walls, doors and rooms at the end");
  field.basic()("semantics", o.semantics, "make a street map at the end");
  field("urban_model", o.urban_model, "path of the street class model; empty: the built-in model");
  field("surfaces_model", o.surfaces_model, "path of the surface model; empty: the built-in model");
  field.group("indoor", o.indoor, "floor plan");
  field.group("urban", o.urban, "semantic street map");
}

void RunOptions::check() const {
  check_ranges(*this);
  describer.check();
  slam.check();
}

void visit(OptionVisitor& field, RunOptions& o) {
  field.basic().choice("sensor", o.sensor, {"auto", "mono", "stereo", "rgbd"},
                       "sensor configuration; auto: the best that the sequence offers");
  field.basic()("camera_height_m", o.camera_height_m,
                "camera height above the ground [m]; 0: as stated by the sequence, or unknown",
                {0, 1000});
  field.basic()("first_frame", o.first_frame, "number of frames skipped at the beginning",
                {0, 1e9});
  field.basic()("max_frames", o.max_frames, "maximum number of frames to process; 0: all",
                {0, 1e9});
  field("mask", o.mask,
        "path of a grey image of the images' size; where it is 0, the (left) images are not used; "
        "empty: none");
  field.basic()("threads", o.threads, "number of threads; the result does not depend on it",
                {1, 256});
  field.group("motion", o.motion, "motion measured by other sensors");
  field.group("lens", o.lens, "self-calibration of a monocular camera's radial distortion");
  field.group("scene", o.scene, "scene models built from the finished map");
  field.group("describer", o.describer, "recognizer of loop candidates that is not the library's");
  visit(field, o.slam);
}

}  // namespace placegraph
