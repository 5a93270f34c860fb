#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/measurements/measured_motion.h>
#include <placegraph/pipeline/scene/scene_map_options.h>
#include <placegraph/pipeline/slam_options.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The sensor that a sequence is to be run as; kAuto: the best that it offers.
enum class SensorChoice { kAuto, kMono, kStereo, kRgbd };

/// Self-calibration of the radial distortion of a monocular or RGB-D camera.
///
/// Where the images prove to be distorted, the run begins again with undistorted ones.
struct LensOptions {
  bool enabled = true;    ///< off: images are taken to be free of distortion
  double min_sigmas = 5;  ///< least |k1| over its standard deviation to call a lens distorted
  /// Least LensDistortion::effect: rms displacement of the tracks, in their standard deviations,
  /// that no other motion or structure explains. Below this it may come from a bias of the tracks,
  /// as when driving straight on.
  double min_effect = 0.05;
  void check() const;
};
void visit(OptionVisitor& field, LensOptions& options);

/// Motion of a body that other sensors measured, read from a file.
struct MotionOptions {
  std::string file;  ///< in the format of docs/odometry.md; empty: none
  /// Pose of the body in the (left) camera frame: tx ty tz [m], qx qy qz qw.
  std::vector<double> T_cam_body{0, 0, 0, 0, 0, 0, 1};
  MotionNoise noise;  ///< where the file tells none
  void check() const;
};
void visit(OptionVisitor& field, MotionOptions& options);

/// What is made of the scene beside the places, from the finished map.
struct SceneOptions {
  bool geometry = false;   ///< a floor plan with walls, doors and rooms (docs/indoor.md)
  bool semantics = false;  ///< a map of what is where in a street (docs/urban_map.md)
  /// Files of the models that label streets and surfaces; empty: those built into the program.
  std::string urban_model, surfaces_model;
  IndoorMapperOptions indoor;  ///< how the floor plan is made
  UrbanMapperOptions urban;    ///< how the street map is made
};
void visit(OptionVisitor& field, SceneOptions& options);

/// A run over a recorded sequence: what `placegraph run` and configs/*.yaml set.
struct RunOptions {
  SensorChoice sensor = SensorChoice::kAuto;  ///< auto: the best the sequence offers
  double camera_height_m = 0;  ///< above the ground; 0: as the sequence says, or unknown
  int first_frame = 0;         ///< index of the first frame that is run
  int max_frames = 0;          ///< most frames that are run; 0: all
  int threads = 2;       ///< 2 or more: the next frame is read meanwhile; the result is the same
  MotionOptions motion;  ///< motion that other sensors measured
  LensOptions lens;      ///< self-calibration of radial distortion
  SceneOptions scene;    ///< used by `placegraph run` on the finished map, not by run_sequence
  SlamOptions slam;      ///< the system itself
  void check() const;
};

}  // namespace placegraph
