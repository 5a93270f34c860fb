#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/measurements/measured_motion.h>
#include <placegraph/pipeline/scene/scene_map_options.h>
#include <placegraph/pipeline/slam_options.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

enum class SensorChoice { kAuto, kMono, kStereo, kRgbd };

struct LensOptions {
  bool enabled = true;
  double min_sigmas = 5;  ///< |k1| over its deviation, to call a lens distorted
  /// What of it no other motion or structure would explain, rms over the tracks, in their standard
  /// deviations. Below this it may come from a bias of the tracks, as when driving straight on.
  double min_effect = 0.05;
  void check() const;
};
void visit(OptionVisitor& field, LensOptions& options);

/// Motion of a body by other sensors, beside the pictures.
struct MotionOptions {
  std::string file;                                     ///< see docs/odometry.md; none if empty
  std::vector<double> T_cam_body{0, 0, 0, 0, 0, 0, 1};  ///< tx ty tz [m], qx qy qz qw
  MotionNoise noise;
  void check() const;
};
void visit(OptionVisitor& field, MotionOptions& options);

/// What is made of the scene beside the places, from the finished map.
struct SceneOptions {
  bool geometry = false;   ///< a floor plan with walls, doors and rooms (docs/indoor.md)
  bool semantics = false;  ///< a map of what is where in a street (docs/urban_map.md)
  /// Models that label streets; empty: those that came with the program.
  std::string urban_model, surfaces_model;
  IndoorMapperOptions indoor;
  UrbanMapperOptions urban;
};
void visit(OptionVisitor& field, SceneOptions& options);

/// A run over a recorded sequence: what `placegraph run` and configs/*.yaml set.
struct RunOptions {
  SensorChoice sensor = SensorChoice::kAuto;  ///< auto: the best the sequence offers
  double camera_height_m = 0;  ///< above the ground; 0: as the sequence says, or unknown
  int first_frame = 0;
  int max_frames = 0;  ///< 0: all
  int threads = 2;     ///< 2 or more: the next frame is read while this one is worked on
  MotionOptions motion;
  LensOptions lens;
  SceneOptions scene;
  SlamOptions slam;
  void check() const;
};

}  // namespace placegraph
