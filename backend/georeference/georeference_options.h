#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>
#include <placegraph/graph/core/robust_kernel.h>

#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

/// How a component of a map is aligned to the fixes before optimization.
struct GpsAlignmentOptions {
  /// How far drift may have bent the map, in percent of the length of the path.
  double max_bend_percent = 3;
  double max_angle_sigma_deg = 10;        ///< of the rotation; if it is less certain: kDegenerate
  RansacOptions ransac{1000, 0.9999, 3};  ///< search for fixes that agree
  void check() const;
};
void visit(OptionVisitor& field, GpsAlignmentOptions& options);

/// What georeference estimates, and how it weights the fixes.
struct GeoreferenceOptions {
  /// Of the error of a fix in standard deviations. The default gives gross errors no weight.
  RobustKernel kernel{RobustKernel::Kind::kTukey, 6.0};
  double min_accuracy_m = 0.02;     ///< least standard deviation of a fix, whatever it states
  bool estimate_accuracy = true;    ///< raise the standard deviations of fixes that scatter more
  bool estimate_odometry = true;    ///< scale covariances of edges that the fixes contradict
  bool estimate_delay = true;       ///< of the map's poses against their stamps, if that is clear
  double max_gap_s = 1.0;           ///< longer gaps of the motion are not bridged
  double dropout_s = 1.0;           ///< longer times without a fix are reported
  bool estimate_lever_arm = false;  ///< with a prior at the given one
  double lever_arm_sigma_m = 2.0;   ///< standard deviation of that prior, each component
  bool estimate_clock_offset = false;  ///< with a prior at the given one; then no delay
  double clock_offset_sigma_s = 0.2;   ///< of that prior, and of one of the map's delay
  GpsAlignmentOptions alignment;       ///< of each component, before optimization
  PoseGraphOptions solver;             ///< its `start` is ignored: the alignment is the start
  std::uint64_t seed = 1;              ///< of the random search for the alignment
  void check() const;
};
void visit(OptionVisitor& field, GeoreferenceOptions& options);

}  // namespace placegraph
