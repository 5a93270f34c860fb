#pragma once
/// The entry points of the library in one header; a program may include the one it needs instead.

// Run SLAM on a sequence, as a whole or frame by frame.
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/run.h>
#include <placegraph/pipeline/slam.h>
#include <placegraph/pipeline/slam/slam_events.h>

// Query a map, and localize images in it.
#include <placegraph/graph/map.h>
#include <placegraph/graph/route.h>
#include <placegraph/pipeline/map/explanation.h>
#include <placegraph/pipeline/map/map_localizer.h>

// Optimize a pose graph, in batch or incrementally, and georeference it.
#include <placegraph/backend/georeference/georeference.h>
#include <placegraph/backend/incremental/incremental_optimizer.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/backend/pose_graph/pose_marginals.h>

// Build a factor graph.
#include <placegraph/backend/factor_graph/bundle_adjustment.h>
#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/backend/factor_graph/fixed_lag_smoother.h>
#include <placegraph/backend/factor_graph/landmark_graph_optimizer.h>

// Evaluate trajectories and loop closures.
#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/eval/trajectory/report.h>

// Recognize places.
#include <placegraph/frontend/places/place_recognizer.h>

// Read and write.
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/graphs/pose_graph_file.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/measurements/loop_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>
