#pragma once
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/measurements/data_note.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A recorded sequence of images, with one interface for all file layouts.
///
/// Frames are grey, undistorted and (stereo) rectified, stamps [ns] strictly increase, and poses
/// are T_world_cam of the (left) camera. `frame()` may be called from several threads at once. To
/// process another kind of recording, derive from this class and pass the object to run_sequence.
class Dataset {
 public:
  virtual ~Dataset() = default;
  /// A name for messages and results: the last folder of the path it was opened from.
  virtual const std::string& name() const = 0;
  /// The kind of recording, for messages: "kitti", "tum", "euroc", "images", "video", ...
  virtual const std::string& format() const = 0;
  /// The number of frames, at least 1.
  virtual std::size_t size() const = 0;
  /// The sensors that the recording supports, best first (stereo, rgbd, mono); never empty.
  virtual std::vector<Sensor> sensors() const = 0;
  /// Calibration of the images that `frame()` returns for a sensor.
  ///
  /// Throws ArgumentError if the recording lacks that sensor.
  virtual Calibration calibration(Sensor sensor) const = 0;
  /// Time of a frame [ns], without reading it. Throws ArgumentError for an index beyond size().
  virtual std::int64_t stamp_ns(std::size_t index) const = 0;
  /// Path of the (left) image of a frame; empty where frames are not single files (videos).
  virtual std::string image_path(std::size_t /*index*/) const { return ""; }
  /// Reads one frame with the images that `sensor` needs.
  ///
  /// Throws FileError that names the image if it is missing, unreadable or of another size than the
  /// calibration, ArgumentError for an index beyond size() or a sensor that is not in sensors().
  virtual Frame frame(std::size_t index, Sensor sensor) const = 0;
  /// Ground truth T_world_cam, one entry per frame (no pose where it is unknown), if any.
  virtual const std::optional<Trajectory>& ground_truth() const = 0;
  /// Whether the recording states that its images are rectified, as those of a stereo pair are.
  /// run_sequence then removes no lens distortion, whichever sensor it uses.
  virtual bool images_rectified() const { return false; }
  /// Notes about skipped data and implausible data, one line each.
  virtual std::vector<DataNote> notes() const { return {}; }
};

}  // namespace placegraph
