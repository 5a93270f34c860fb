#pragma once
#include <placegraph/backend/incremental/incremental_options.h>
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/loops/loop_options.h>
#include <placegraph/pipeline/places/place_options.h>
#include <placegraph/pipeline/tracking/odometry_options.h>

#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

/// Appearance of keyframes, kept in the map so that images can be placed in it later.
struct KeyframeViewOptions {
  bool enabled = true;   ///< keep it; MapLocalizer and `placegraph localize` need it
  PlaceCueOptions cues;  ///< which descriptors are kept
};
void visit(OptionVisitor& field, KeyframeViewOptions& options);

/// Labels of surfaces for motion and places; the model is given by SlamInputs::surfaces.
struct SceneUseOptions {
  bool enabled = false;    ///< label keyframes; needs SlamInputs::surfaces
  SceneMaskOptions masks;  ///< which labels keep pixels out of tracking
};
void visit(OptionVisitor& field, SceneUseOptions& options);

/// The kind of environment the camera is in, and what is assumed there.
struct ContextOptions {
  bool enabled = false;  ///< classify keyframes and label places; needs SlamInputs::surfaces
  bool assume = true;    ///< the odometry relies only on what usually holds in that environment
  EnvironmentFilterOptions filter;  ///< smoothing of the kind over consecutive keyframes
};
void visit(OptionVisitor& field, ContextOptions& options);

/// Options of Slam: everything but the sequence.
struct SlamOptions {
  std::uint64_t seed = 0;         ///< of every random stream; the same seed gives the same bits
  OdometryOptions odometry;       ///< motion over the last keyframes
  LoopOptions loops;              ///< loop closures
  PlaceOptions places;            ///< places and the edges between them
  IncrementalOptions pose_graph;  ///< optimization of the place graph
  KeyframeViewOptions views;      ///< appearance of keyframes, kept for localization
  SceneUseOptions semantics;      ///< labels of surfaces
  ContextOptions context;         ///< the kind of environment
  /// Frames without a pose in a row after which a new component of the map begins, or the map goes
  /// on by SlamInputs::motion where it tells the motion.
  int max_lost_frames = 10;
  void check() const;
};
void visit(OptionVisitor& field, SlamOptions& options);

}  // namespace placegraph
