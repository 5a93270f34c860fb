#pragma once
#include <placegraph/frontend/internal/floor_plan/indoor_surfaces.h>
#include <placegraph/frontend/internal/scene/street_labelling.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/scene/semantic_map.h>
#include <placegraph/pipeline/internal/scene/map_keyframes.h>
#include <placegraph/pipeline/scene/scene_map_options.h>

#include <functional>
#include <optional>

namespace placegraph {

/// A map of what is where in a street, from the keyframes of a stereo map. What a keyframe tells is
/// kept in its own frame; `fuse` lays all of it out with the poses of the map as it stands, so that
/// after a loop closure the map is simply fused again.
class UrbanMapper {
 public:
  /// Throws ArgumentError for options or a calibration out of range, models of other kinds or a
  /// moving class that the model does not have.
  UrbanMapper(const UrbanMapperOptions& options, const Calibration& calibration, SceneModel urban,
              SceneModel surfaces);

  /// Takes the images of a keyframe; what was told of it before is replaced. `T_map_cam` serves
  /// only for the motion since the keyframe that was added last.
  void add(KeyframeId keyframe, const Frame& frame, const SE3& T_map_cam);
  void add(KeyframeSemantics observation);
  const std::vector<KeyframeSemantics>& observations() const { return observations_; }
  const std::vector<std::string>& classes() const { return urban_.classes; }

  /// The map by the poses of `map` (its first component and what is joined to it).
  /// Outcomes: too few data (nothing seen, one eye, or a map whose unit is not the metre).
  [[nodiscard]] SemanticMap fuse(const Map& map) const;
  /// By other poses, e.g. those before a correction. `down`: of their frame; zero: as the cameras
  /// see the ground.
  [[nodiscard]] SemanticMap fuse(const KeyframePoses& T_map_cam,
                                 const Eigen::Vector3d& down = Eigen::Vector3d::Zero()) const;

 private:
  void drop_seen_through(KeyframeSemantics& observation, const Image& depth_m,
                         const SE3& T_map_cam);
  UrbanMapperOptions options_;
  Calibration calibration_;
  SceneModel urban_, surfaces_;
  std::vector<KeyframeSemantics> observations_;
  struct Last {
    KeyframeId keyframe;
    Image depth_m;
    SE3 T_map_cam;
  };
  std::optional<Last> last_;
};

/// Adds the keyframes of a map that is done, reading their frames by `frame_of`.
void add_keyframes(UrbanMapper& mapper, const Map& map, const UrbanMapperOptions& options,
                   const std::function<Frame(const Keyframe&)>& frame_of,
                   const std::function<void(std::size_t, std::size_t)>& progress = {});

/// What is seen from each place: shares of the classes of the map among the points of its
/// keyframes, in the order of `places`; empty where none was used.
std::vector<std::vector<float>> class_shares(const UrbanMapper& mapper, const Map& map);

}  // namespace placegraph
