#pragma once
#include <placegraph/backend/incremental/incremental_options.h>
#include <placegraph/frontend/places/cues/place_cue_options.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/overlays/static_overlay_options.h>
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
  StaticOverlayOptions overlays;  ///< regions fixed to the camera
  /// Number of consecutive frames without a pose after which a new component of the map begins, or
  /// after which the trajectory continues with SlamInputs::motion if that covers the time.
  int max_lost_frames = 10;
  void check() const;
};
void visit(OptionVisitor& field, SlamOptions& options);

}  // namespace placegraph
