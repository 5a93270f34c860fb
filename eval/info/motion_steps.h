#pragma once
#include <placegraph/eval/info/trajectory_info.h>

namespace placegraph {

/// The posed frames of a trajectory, with times in seconds or in numbers of frames.
struct PosedFrames {
  explicit PosedFrames(const Trajectory& trajectory);

  std::vector<std::size_t> indices;      ///< of the frames in the trajectory
  std::vector<std::int64_t> stamps_ns;   ///< their stamps
  std::vector<double> times;             ///< since the first one: [s], or frames
  std::vector<Eigen::Vector3d> p_world;  ///< their positions
  std::vector<Eigen::Quaterniond> q_world_body;  ///< their orientations
  std::vector<bool> after_gap;           ///< whether a gap is between a frame and the one before
  bool has_times = true, has_orientation = true;  ///< as those of the trajectory

  std::size_t size() const { return indices.size(); }
  FrameSpan span(std::size_t first, std::size_t last) const;
  double distance_m(std::size_t a, std::size_t b) const;
  double angle_deg(std::size_t a, std::size_t b) const;
};

/// A motion between two posed frames.
struct MotionOver {
  std::size_t from = 0, to = 0;  ///< positions in PosedFrames
  double time = 0;               ///< [s], or frames
};

/// From every frame the motion to the first that is `time` later, without a gap between.
/// `time`: [s], or frames without times.
std::vector<MotionOver> motions_over(const PosedFrames& frames, double time);

/// The spread of values, which may be none.
Spread spread_of(std::vector<double> values);

/// The times without a pose that are longer than five median spacings.
std::vector<FrameSpan> gaps_in(const PosedFrames& frames);
/// The times in which the body stands; see trajectory_info().
std::vector<FrameSpan> stops_in(const PosedFrames& frames);
/// The steps that no motion explains; see trajectory_info().
std::vector<ImplausibleStep> jumps_in(const PosedFrames& frames, double extent_m);

}  // namespace placegraph
