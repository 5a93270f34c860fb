#pragma once
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/io/internal/calibration/rectification.h>

#include <functional>

namespace placegraph {

/// What a folder of images comes down to once its format is understood: every format's reader fills
/// one of these. Image lists are empty or as long as `stamps_ns`.
struct RecordedSequence {
  std::string name, format;
  std::vector<std::int64_t> stamps_ns;
  std::vector<std::string> left, right, depth;  ///< paths of the raw images
  Camera raw_camera;                            ///< of the raw left images: only the size is used
  Calibration calibration;                      ///< of everything it can hand over, after remapping
  Remap left_remap, right_remap, depth_remap;
  double depth_unit_m = 0.001;  ///< metres of one step of the depth images
  std::optional<Trajectory> ground_truth;
  std::vector<DataNote> notes;  ///< those of the reader; odd times are added by make_dataset
};

/// Reads images on demand. Throws ArgumentError if the lists' lengths disagree.
std::unique_ptr<Dataset> make_dataset(RecordedSequence sequence);

/// The part of `calibration` that belongs to `sensor`; throws ArgumentError "name: has no ...".
Calibration calibration_for(Sensor sensor, const Calibration& calibration, const std::string& name);
/// What such a calibration can be run as, best first.
std::vector<Sensor> sensors_of(const Calibration& calibration);

/// Last folder of a path, whatever dots and slashes it ends in.
std::string folder_name(const std::string& path);

/// The poses at `stamps_ns`, interpolated in a denser or sparser recording of another clock rate;
/// frames with no pose within `max_gap_s` around them have none.
Trajectory resample(const Trajectory& recorded, const std::vector<std::int64_t>& stamps_ns,
                    double max_gap_s);

/// Stamps where a recording has no times: 10 Hz from 0, or another rate.
inline constexpr double kDefaultRateHz = 10;
std::vector<std::int64_t> synthetic_stamps_ns(std::size_t count, double rate_hz = kDefaultRateHz);

}  // namespace placegraph
