#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>
#include <placegraph/graph/core/robust_kernel.h>

#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

/// Options of the alignment of a map's component to the fixes before optimization.
struct GpsAlignmentOptions {
  /// Maximum deformation of the map by drift, in percent of the path length.
  double max_bend_percent = 3;
  double max_angle_sigma_deg = 10;  ///< maximum sigma of the rotation [deg]; above it: kDegenerate
  RansacOptions ransac{1000, 0.9999, 3};  ///< search for consistent fixes
  void check() const;
};
void visit(OptionVisitor& field, GpsAlignmentOptions& options);

/// Options of georeference: the estimated quantities and the weights of the fixes.
struct GeoreferenceOptions {
  /// Robust kernel of a fix's error in standard deviations. The default gives gross errors no
  /// weight.
  RobustKernel kernel{RobustKernel::Kind::kTukey, 6.0};
  double min_accuracy_m = 0.02;        ///< smallest standard deviation assumed for a fix [m]
  bool estimate_accuracy = true;       ///< increase the sigmas of fixes that scatter more
  bool estimate_odometry = true;       ///< scale covariances of edges that the fixes contradict
  bool estimate_delay = true;          ///< correct the latency of the map's poses if significant
  double max_gap_s = 1.0;              ///< longest gap of the motion that is interpolated [s]
  double dropout_s = 1.0;              ///< longer gaps between fixes are reported [s]
  bool estimate_lever_arm = false;     ///< estimate it, with a prior at the given one
  double lever_arm_sigma_m = 2.0;      ///< standard deviation of each component of the prior [m]
  bool estimate_clock_offset = false;  ///< estimate it instead of a delay, with a prior
  double clock_offset_sigma_s = 0.2;   ///< sigma of that prior and of that of the map's delay [s]
  GpsAlignmentOptions alignment;       ///< alignment of each component before optimization
  PoseGraphOptions
      solver;              ///< its `initialization` is ignored: the alignment is the initialization
  std::uint64_t seed = 1;  ///< seed of the random search for the alignment
  void check() const;
};
void visit(OptionVisitor& field, GeoreferenceOptions& options);

}  // namespace placegraph
