#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>
#include <placegraph/graph/core/robust_kernel.h>

#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

struct GpsAlignmentOptions {
  double max_bend_percent =
      3;  ///< how far the map may be bent, in percent of its extent along the way
  double max_angle_sigma_deg = 10;  ///< of the rotation; above it the positions determine none
  RansacOptions ransac{1000, 0.9999, 3};
  void check() const;
};
void visit(OptionVisitor& field, GpsAlignmentOptions& options);

struct GeoreferenceOptions {
  /// Of the position error in standard deviations; a fix far off must have no say.
  RobustKernel kernel{RobustKernel::Kind::kTukey, 6.0};
  double min_accuracy_m = 0.02;     ///< no receiver is taken for better
  bool estimate_accuracy = true;    ///< take fixes for worse than stated where they scatter more
  bool estimate_odometry = true;    ///< take edges for worse or better than stated if fixes show it
  bool estimate_delay = true;       ///< of the map's poses against their stamps (map_latency.h)
  double max_gap_s = 1.0;           ///< longer gaps of the motion are not bridged
  double dropout_s = 1.0;           ///< a time without a fix that is longer is reported
  bool estimate_lever_arm = false;  ///< about the given one
  double lever_arm_sigma_m = 2.0;   ///< its prior
  bool estimate_clock_offset = false;
  double clock_offset_sigma_s = 0.2;  ///< its prior, and that of the map's delay
  GpsAlignmentOptions alignment;
  PoseGraphOptions solver;  ///< its start is of no account: the alignment is the start
  std::uint64_t seed = 1;   ///< of the search for the alignment
  void check() const;
};
void visit(OptionVisitor& field, GeoreferenceOptions& options);

}  // namespace placegraph
