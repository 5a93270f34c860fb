#pragma once
/// Sequences, runs, maps, pose graphs, evaluation and files in one header.
///
/// A program may include the one it needs instead. What has a special use is included by name:
/// factor graphs and bundles (backend/factor_graph), incremental graphs (backend/incremental),
/// covariances (backend/pose_graph/pose_marginals.h), maps on the earth (backend/georeference),
/// localization and explanations (pipeline/map), routes (graph/route.h), recognition alone
/// (frontend/places).

// Run SLAM on a sequence, as a whole or frame by frame.
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/run.h>
#include <placegraph/pipeline/slam.h>
#include <placegraph/pipeline/slam/slam_events.h>

// Maps and pose graphs.
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/graph/map.h>

// Evaluate trajectories and loop closures.
#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/eval/trajectory/report.h>

// Read and write.
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/graphs/pose_graph_file.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/loops/loop_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>
