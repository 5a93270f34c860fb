#pragma once
#include <placegraph/graph/geometry/trajectory_edit.h>
#include <placegraph/io/calibration/rectification.h>
#include <placegraph/io/datasets/dataset.h>

#include <functional>

namespace placegraph {

/// The common form of a folder of images: the reader of every format fills one of these. Image
/// lists are empty or as long as `stamps_ns`.
struct RecordedSequence {
  std::string name, format;
  std::vector<std::int64_t> stamps_ns;
  std::vector<std::string> left, right, depth;  ///< paths of the raw images
  Camera raw_camera;        ///< camera of the raw left images: only the size is used
  Calibration calibration;  ///< calibration of all images, after remapping
  bool rectified = false;   ///< Dataset::images_rectified; a baseline implies it
  Remap left_remap, right_remap, depth_remap;
  double depth_unit_m = 0.001;  ///< metres of one step of the depth images
  std::optional<Trajectory> ground_truth;
  std::vector<DataNote> notes;  ///< notes of the reader; make_dataset adds those about times
};

/// Reads images on demand. Throws ArgumentError if the lists' lengths disagree.
std::unique_ptr<Dataset> make_dataset(RecordedSequence sequence);

/// The part of `calibration` that belongs to `sensor`; throws ArgumentError "name: has no ...".
Calibration calibration_for(Sensor sensor, const Calibration& calibration, const std::string& name);
/// The sensors that such a calibration supports, best first.
std::vector<Sensor> sensors_of(const Calibration& calibration);

/// Last folder of a path, which may end in dots and slashes.
std::string folder_name(const std::string& path);

/// Stamps for a recording without times: 10 Hz from 0, or another rate.
inline constexpr double kDefaultRateHz = 10;
std::vector<std::int64_t> synthetic_stamps_ns(std::size_t count, double rate_hz = kDefaultRateHz);

}  // namespace placegraph
