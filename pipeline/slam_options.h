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

/// How keyframes look in all cues: kept in the map, so that images can be placed in it later.
struct KeyframeViewOptions {
  bool enabled = true;
  PlaceCueOptions cues;
};
void visit(OptionVisitor& field, KeyframeViewOptions& options);

/// Labels of surfaces for motion and places; the model is given by SlamInputs::surfaces.
struct SceneUseOptions {
  bool enabled = false;
  SceneMaskOptions masks;
};
void visit(OptionVisitor& field, SceneUseOptions& options);

/// The kind of environment the camera is in, and what is assumed there.
struct ContextOptions {
  bool enabled = false;
  bool assume = true;  ///< the odometry takes for granted what holds there, and nothing else
  EnvironmentFilterOptions filter;
};
void visit(OptionVisitor& field, ContextOptions& options);

struct SlamOptions {
  std::uint64_t seed = 0;  ///< of every random stream
  OdometryOptions odometry;
  LoopOptions loops;
  PlaceOptions places;
  IncrementalOptions pose_graph;
  KeyframeViewOptions views;
  SceneUseOptions semantics;
  ContextOptions context;
  int max_lost_frames = 10;  ///< then a new component of the map begins
  void check() const;
};
void visit(OptionVisitor& field, SlamOptions& options);

}  // namespace placegraph
