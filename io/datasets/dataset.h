#pragma once
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/measurements/data_note.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A recorded sequence of images, in one form whatever its files look like.
///
/// Frames are grey, undistorted and (stereo) rectified, stamps [ns] strictly increase, and poses
/// are T_world_cam of the (left) camera. `frame()` may be called from several threads at once. To
/// run own recordings, derive from this class and hand the object to run_sequence.
class Dataset {
 public:
  virtual ~Dataset() = default;
  /// A name for messages and results: the last folder of the path it was opened from.
  virtual const std::string& name() const = 0;
  /// The kind of recording, for messages: "kitti", "tum", "euroc", "images", "video", ...
  virtual const std::string& format() const = 0;
  /// The number of frames, at least 1.
  virtual std::size_t size() const = 0;
  /// What it can be run as, best first (stereo, rgbd, mono); never empty.
  virtual std::vector<Sensor> sensors() const = 0;
  /// Calibration of the images that `frame()` returns for a sensor.
  ///
  /// Throws ArgumentError if the recording lacks that sensor.
  virtual Calibration calibration(Sensor sensor) const = 0;
  /// Time of a frame [ns], without reading it. Throws ArgumentError for an index beyond size().
  virtual std::int64_t stamp_ns(std::size_t index) const = 0;
  /// Reads one frame with the images that `sensor` needs.
  ///
  /// Throws FileError naming the image that is missing, unreadable or of another size than the
  /// calibration says, ArgumentError for an index beyond size() or a sensor that is not offered.
  virtual Frame frame(std::size_t index, Sensor sensor) const = 0;
  /// True poses T_world_cam, one entry per frame (without a pose where none is known), if any.
  virtual const std::optional<Trajectory>& ground_truth() const = 0;
  /// What was left out in reading, and what is odd about the data; one line each.
  virtual std::vector<DataNote> notes() const { return {}; }
};

}  // namespace placegraph
