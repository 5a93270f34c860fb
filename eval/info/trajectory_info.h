#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// How the values of a quantity are spread.
struct Spread {
  std::size_t count = 0;  ///< number of values; without any the others are 0
  double min = 0;         ///< least value
  double p05 = 0;         ///< 5 % of the values are below
  double median = 0;      ///< half of the values are below
  double p95 = 0;         ///< 95 % of the values are below
  double max = 0;         ///< greatest value
};

/// A part of a trajectory, by the indices of its first and its last frame.
struct FrameSpan {
  std::size_t first = 0, last = 0;            ///< indices of frames
  std::int64_t first_ns = 0, last_ns = 0;     ///< their stamps
  std::int64_t length_ns() const { return last_ns - first_ns; }  ///< time between them
};

/// A step that is too fast for the motion around it.
struct ImplausibleStep {
  FrameSpan span;           ///< both frames of the step
  double distance_m = 0;    ///< length of the step
  double angle_deg = 0;     ///< angle of its rotation
  /// Its speed over that of the steps around it; nothing if the body stands there.
  std::optional<double> times_faster;
};

/// The plane in which a body moves.
struct MotionPlane {
  Outcome outcome;  ///< kDegenerate: no plane is evident; kTooFewData: less than 3 poses
  Eigen::Vector3d normal_world = Eigen::Vector3d::Zero();  ///< unit length; its sign is open
  double rms_m = 0;        ///< distance of the positions from the plane that fits best
  double share = 0;        ///< this distance over that along the shorter axis of the plane
  char axis = ' ';         ///< axis of the world nearest to the normal: x, y or z
  double tilt_deg = 0;     ///< angle between both
};

/// The axis of the body along which it moves.
struct ForwardAxis {
  Outcome outcome;  ///< kDegenerate: the direction varies, or is along no axis
  Eigen::Vector3d direction_body = Eigen::Vector3d::Zero();  ///< mean direction, unit length
  double steadiness = 0;   ///< length of the mean of unit directions: 1 if all are the same
  std::string axis;        ///< "+x", "-x", "+y" and so on: the nearest one
  double angle_deg = 0;    ///< angle between both
  std::string convention;  ///< axes of which this is typical, one line; empty: none
};

/// What is likely of a convention that a file does not state.
struct Likelihood {
  Outcome outcome;     ///< kDegenerate: not evident, with what was found
  std::string answer;  ///< what is likely, with the evidence
  bool as_read = true;  ///< whether it is what the reader has assumed
};

/// What a trajectory says about itself, without ground truth.
struct TrajectoryInfo {
  std::size_t frames = 0;       ///< lines of the file, lost frames included
  std::size_t posed = 0;        ///< frames with a pose
  bool has_times = true;        ///< otherwise "time" is the number of a frame
  bool has_orientation = true;  ///< otherwise positions alone
  std::int64_t first_ns = 0, last_ns = 0;  ///< stamps of the first and of the last frame
  double length_m = 0;                     ///< length of the path
  Eigen::Vector3d extent_m = Eigen::Vector3d::Zero();  ///< size of the box around the positions
  Spread spacing_s;             ///< between posed frames: seconds, or numbers of frames
  Spread speed;                 ///< [m/s], or [m] from frame to frame without times
  Spread turning_deg;           ///< [deg/s], or [deg] between frames; none without orientations
  std::size_t repeated = 0;     ///< poses that equal the one before in every number
  std::vector<FrameSpan> gaps;  ///< more than five median spacings without a pose
  std::vector<FrameSpan> stops;           ///< the body stands, for a second (10 frames) or longer
  std::vector<ImplausibleStep> jumps;     ///< steps that no motion explains
  MotionPlane plane;            ///< whether the motion is level, tilted or in no plane
  ForwardAxis forward;          ///< which axis of the body looks along the motion
  Likelihood quaternions;       ///< order of the numbers of quaternions, as against the reader's
  Likelihood length_unit;       ///< unit of positions
  Likelihood time_unit;         ///< unit of stamps
  std::vector<std::string> warnings;  ///< those of the reader
};

/// Describes a trajectory by its poses alone.
///
/// Speeds are over 0.1 s (or from frame to frame). A body stands where it moves less than 2 % of
/// its usual distance (95 % quantile) in 0.5 s (5 frames), and turns as little. A step is implausible
/// if it is five times as fast as all but one of the ten steps around it. A plane is evident if the
/// positions leave it by less than 5 % of its shorter extent, and the axis of the turns agrees. An
/// axis looks forward if 80 % of the directions of motion agree and it is within 30 degrees.
/// Throws ArgumentError for stamps that do not increase.
TrajectoryInfo trajectory_info(const Trajectory& trajectory);

}  // namespace placegraph
