#pragma once
#include <placegraph/graph/image/frame.h>
#include <placegraph/io/datasets/dataset.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph::faults {

/// Numbers of the first and the last frame of a stretch; both belong to it.
struct Span {
  std::size_t first = 0, last = 0;
  /// Whether a frame belongs to the stretch.
  bool contains(std::size_t index) const { return index >= first && index <= last; }
};

/// A sequence in memory. Images may be CV_8UC3 where a fault gives them colour.
struct Recording {
  std::vector<Frame> frames;   ///< at least one; only images of the sensors that were recorded
  Calibration calibration;     ///< as it is written, right or not
  double depth_unit_m = 1e-3;  ///< of one step of the depth images that are written
  double stated_depth_unit_m = 1e-3;  ///< what is written about that
  /// Ground truth T_world_cam of the left camera, one entry a frame; empty: there is none.
  std::vector<Eigen::Isometry3d> T_world_cam;
  Span faulty;  ///< the frames that a fault has changed

  std::size_t size() const { return frames.size(); }
  bool has_right() const { return !frames[0].right.empty(); }
  bool has_depth() const { return !frames[0].depth.empty(); }
};

/// What is read of a sequence.
struct ReadingOptions {
  std::size_t most_frames = 0;            ///< 0: all
  double scale = 1;                       ///< of the images' size, in (0, 1]
  std::optional<double> camera_height_m;  ///< replaces that of the sequence
};

/// Reads a sequence of any layout with the images of all its sensors.
/// Throws ArgumentError for an option out of range, FileError as open_dataset.
Recording read_recording(const std::string& path, const ReadingOptions& options);

/// Writes a sequence in KITTI's odometry layout, and fault.json with `name` and the faulty frames.
/// Throws ArgumentError if `path` exists and is not an empty folder, FileError if it cannot be
/// written.
void write_recording(const Recording& recording, const std::string& name, const std::string& path);

}  // namespace placegraph::faults
