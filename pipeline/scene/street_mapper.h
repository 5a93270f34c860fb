#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/scene/scene_model.h>
#include <placegraph/graph/scene/street_map.h>
#include <placegraph/pipeline/scene/scene_map_options.h>

#include <functional>
#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// Pose of a keyframe's camera in the frame of a map; nothing if it is unknown.
using KeyframePoses = std::function<std::optional<SE3>(KeyframeId keyframe)>;

/// The poses of the keyframes of the main component of a map.
KeyframePoses poses_of(const Map& map);
/// Pose of each keyframe when its frame had been processed, before later loops moved it.
KeyframePoses online_poses_of(const Map& map);

/// Makes a semantic street map from the keyframes of a stereo map.
///
/// The labelled points of a keyframe are stored in its own frame; `fuse` transforms all of them
/// with the current poses of the map, so that after a loop closure the map is recomputed by fusing
/// again.
class StreetMapper {
 public:
  /// Throws ArgumentError for options or a calibration out of range, models of other kinds or a
  /// moving class that the model does not have.
  StreetMapper(const StreetMapperOptions& options, const Calibration& calibration, SceneModel urban,
               SceneModel surfaces);

  /// Checks options as the constructor does; `urban` has the classes.
  static void check(const StreetMapperOptions& options, const SceneModel& urban);

  /// Adds the images of a keyframe; replaces earlier data of this keyframe. `T_map_cam` is used
  /// only for the motion since the keyframe that was added last.
  void add(KeyframeId keyframe, const Frame& frame, const SE3& T_map_cam);
  /// Adds the labelled points of a keyframe; replaces earlier ones.
  void add(KeyframeStreetPoints observation);
  /// The keyframes that were added, in the order of their first addition.
  const std::vector<KeyframeStreetPoints>& observations() const { return observations_; }
  /// Names of the classes of the map.
  const std::vector<std::string>& classes() const { return urban_.classes; }

  /// Computes the map with the poses of `map` (its first component and those joined to it).
  /// Outcomes: too few data (no points, a monocular camera, or a map that is not metric).
  [[nodiscard]] StreetMap fuse(const Map& map) const;
  /// Computes the map with other poses, e.g. those before a correction. `down`: down direction of
  /// their frame; zero: estimated from the ground seen by the cameras.
  [[nodiscard]] StreetMap fuse(const KeyframePoses& T_map_cam,
                               const Eigen::Vector3d& down = Eigen::Vector3d::Zero()) const;

 private:
  void drop_seen_through(KeyframeStreetPoints& observation, const Image& depth_m,
                         const SE3& T_map_cam);
  StreetMapperOptions options_;
  Calibration calibration_;
  SceneModel urban_, surfaces_;
  std::vector<KeyframeStreetPoints> observations_;
  struct Last {
    KeyframeId keyframe;
    Image depth_m;
    SE3 T_map_cam;
  };
  std::optional<Last> last_;
};

/// Adds the keyframes of a finished map; reads their frames with `frame_of`.
void add_keyframes(StreetMapper& mapper, const Map& map, const StreetMapperOptions& options,
                   const std::function<Frame(const Keyframe&)>& frame_of,
                   const std::function<void(std::size_t, std::size_t)>& progress = {});

/// Observed classes of each place, in the order of `places`.
///
/// They are the shares of the map's classes among the points of its keyframes; empty where no
/// keyframe was used.
std::vector<std::vector<float>> class_shares(const StreetMapper& mapper, const Map& map);

}  // namespace placegraph
