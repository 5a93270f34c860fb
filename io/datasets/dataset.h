#pragma once
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/measurements/data_note.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A recorded sequence. Everything foreign ends here: frames are grey, undistorted and (stereo)
/// rectified, stamps are ns and strictly increasing, poses are T_world_cam of the (left) camera.
/// `frame()` may be called from several threads at once.
class Dataset {
 public:
  virtual ~Dataset() = default;
  virtual const std::string& name() const = 0;    ///< last folder of its path
  virtual const std::string& format() const = 0;  ///< "kitti", "tum", "euroc", "images", "video"
  virtual std::size_t size() const = 0;
  /// What it can be run as, best first (stereo, rgbd, mono).
  virtual std::vector<Sensor> sensors() const = 0;
  /// Of the frames it hands out for `sensor`. Throws ArgumentError if it lacks that sensor.
  virtual Calibration calibration(Sensor sensor) const = 0;
  virtual std::int64_t stamp_ns(std::size_t index) const = 0;
  /// Reads one frame with the images `sensor` needs. Throws FileError naming the image that is
  /// missing, unreadable or of another size than the calibration says.
  virtual Frame frame(std::size_t index, Sensor sensor) const = 0;
  virtual const std::optional<Trajectory>& ground_truth() const = 0;
  /// What was left out in reading, and what is odd.
  virtual std::vector<DataNote> notes() const { return {}; }
};

}  // namespace placegraph
