#pragma once
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/measurements/measured_motion.h>
#include <placegraph/pipeline/scene/scene_map_options.h>
#include <placegraph/pipeline/slam_options.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Requested sensor configuration; kAuto selects the best one that the sequence offers.
enum class SensorChoice { kAuto, kMono, kStereo, kRgbd };

/// Self-calibration of the radial distortion of a monocular or RGB-D camera.
///
/// If the first images are found to be distorted, the run restarts with undistorted ones.
/// Distortion that is found later is reported in RunResult::notes. Images that are stated to be
/// rectified (Dataset::images_rectified) are not corrected.
struct LensOptions {
  bool enabled = true;  ///< off: the images are assumed to be undistorted
  /// Number of frames within which a run may restart, or a fifth of the sequence if that is more:
  /// this bounds the work that is repeated.
  int max_frames = 200;
  /// Minimum |k1| over its standard deviation for a lens to count as distorted.
  double min_sigmas = 5;
  /// Minimum LensDistortion::effect: RMS displacement of the tracks, in their standard deviations,
  /// that no other motion or structure explains. A smaller effect may come from a bias of the
  /// tracks, for example during straight forward motion.
  double min_effect = 0.05;
  void check() const;
};
void visit(OptionVisitor& field, LensOptions& options);

/// Motion of a body measured by other sensors, read from a file.
struct MotionOptions {
  std::string file;  ///< path of a file in the format of docs/other_sensors.md; empty: none
  /// Pose of the body in the (left) camera frame: tx ty tz [m], qx qy qz qw.
  std::vector<double> T_cam_body{0, 0, 0, 0, 0, 0, 1};
  MotionNoise noise;  ///< noise that is assumed where the file states none
  void check() const;
};
void visit(OptionVisitor& field, MotionOptions& options);

/// Scene models that are built from the finished map.
struct SceneOptions {
  bool geometry = false;   ///< build a floor plan with walls, doors and rooms (docs/floor_plan.md)
  bool semantics = false;  ///< make a street map (docs/street_map.md)
  /// Files of the models that label streets and surfaces; empty: the built-in models.
  std::string urban_model, surfaces_model;
  FloorPlanMapperOptions indoor;  ///< options of the floor plan
  StreetMapperOptions urban;      ///< options of the semantic street map
};
void visit(OptionVisitor& field, SceneOptions& options);

/// Options of a run over a recorded sequence, as set by `placegraph run` and configs/*.yaml.
struct RunOptions {
  /// Sensor configuration; auto: the best that the sequence offers.
  SensorChoice sensor = SensorChoice::kAuto;
  /// Camera height above the ground; 0: as stated by the sequence, or unknown.
  double camera_height_m = 0;
  int first_frame = 0;  ///< index of the first frame to process
  int max_frames = 0;   ///< maximum number of frames to process; 0: all
  /// Path of a grey image of the images' size; its pixels that are 0 are not used in any frame.
  /// Empty: none.
  std::string mask;
  int threads = 2;  ///< with 2 or more, the next frame is read in parallel; the result is the same
  MotionOptions motion;  ///< motion measured by other sensors
  LensOptions lens;      ///< self-calibration of radial distortion
  SceneOptions scene;    ///< used by `placegraph run` on the finished map, not by run_sequence
  DescriberOptions describer;  ///< recognizer whose candidates are those of loops
  SlamOptions slam;            ///< options of the SLAM system
  void check() const;
};

}  // namespace placegraph
