#pragma once
#include <placegraph/backend/incremental/incremental_options.h>
#include <placegraph/frontend/places/cues/place_cue_options.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/loops/loop_options.h>
#include <placegraph/pipeline/places/place_options.h>
#include <placegraph/pipeline/tracking/odometry_options.h>

#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

/// Options for storing the appearance of keyframes, which MapLocalizer needs.
struct KeyframeViewOptions {
  /// Store the appearance; required by MapLocalizer and `placegraph map localize`.
  bool enabled = true;
  PlaceCueOptions cues;  ///< descriptors that are stored
};
void visit(OptionVisitor& field, KeyframeViewOptions& options);

/// Surface labels for odometry and place recognition; the model is SlamInputs::surfaces.
struct SceneUseOptions {
  bool enabled = false;    ///< label keyframes; requires SlamInputs::surfaces
  SceneMaskOptions masks;  ///< labels whose pixels are excluded from tracking
};
void visit(OptionVisitor& field, SceneUseOptions& options);

/// Classification of the environment, and the assumptions that follow from it.
struct ContextOptions {
  bool enabled = false;  ///< classify keyframes and label places; requires SlamInputs::surfaces
  bool assume = true;    ///< odometry relies only on cues that usually hold in that environment
  EnvironmentFilterOptions filter;  ///< smoothing of the class over consecutive keyframes
};
void visit(OptionVisitor& field, ContextOptions& options);

/// Search for static overlays, which move with the camera and are no part of the world.
///
/// Dirt on the lens, a time stamp, a logo or the bonnet are such. An episode is a stretch of frames
/// in which the camera moves. It speaks against a patch that stands still in the images if the
/// motion of other points moves every point of the world there, however far away.
struct StaticOverlayOptions {
  bool enabled = true;       ///< search for static overlays and mask them
  int interval = 2;          ///< number of frames from one comparison of the patches to the next
  double standing_px = 0.3;  ///< maximum displacement of a patch that stands still [px]
  double min_motion_px = 8;  ///< displacement of most moving points that completes an episode [px]
  /// Minimum distance from a patch that stands still to the nearest pixel at which the motion
  /// allows it [px].
  double min_contradiction_px = 0.5;
  int min_episodes = 2;  ///< number of episodes that prove a patch to move with the camera
  int min_patches = 6;   ///< minimum number of proven patches in a region that is masked
  void check() const;
};
void visit(OptionVisitor& field, StaticOverlayOptions& options);

/// Options of Slam.
struct SlamOptions {
  /// Seed of all random number generators; the same seed gives identical results.
  std::uint64_t seed = 0;
  OdometryOptions odometry;       ///< visual odometry over the last keyframes
  LoopOptions loops;              ///< loop closures
  PlaceOptions places;            ///< places and the edges between them
  IncrementalOptions pose_graph;  ///< optimization of the place graph
  KeyframeViewOptions views;      ///< stored appearance of keyframes, for localization
  SceneUseOptions semantics;      ///< surface labels
  ContextOptions context;         ///< class of the environment
  StaticOverlayOptions overlays;  ///< what moves with the camera
  /// Number of consecutive frames without a pose after which a new component of the map begins, or
  /// after which the trajectory continues with SlamInputs::motion if that covers the time.
  int max_lost_frames = 10;
  void check() const;
};
void visit(OptionVisitor& field, SlamOptions& options);

}  // namespace placegraph
