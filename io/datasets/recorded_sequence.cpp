#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/measurements/stamp_plausibility.h>
#include <placegraph/io/calibration/calibration_plausibility.h>
#include <placegraph/io/datasets/image_levels.h>
#include <placegraph/io/datasets/recorded_sequence.h>
#include <placegraph/io/files/image_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace placegraph {
namespace {

class RecordedDataset : public Dataset {
 public:
  explicit RecordedDataset(RecordedSequence sequence) : s_(std::move(sequence)) {
    const std::size_t n = s_.stamps_ns.size();
    const auto fits = [n](const auto& list) { return list.empty() || list.size() == n; };
    require(n > 0 && s_.left.size() == n && fits(s_.right) && fits(s_.depth) &&
                (!s_.ground_truth || s_.ground_truth->size() == n),
            "recorded sequence: lists of different lengths");
    try {
      s_.calibration.check();
    } catch (const ArgumentError& error) {
      throw FileError(s_.name, error.what());
    }
    for (DataNote& note : odd_calibration(s_.calibration)) s_.notes.push_back(std::move(note));
    ImageLevels levels = sample_levels(s_.left);
    bits_ = levels.bits;
    if (levels.of_16 && !s_.right.empty()) bits_ = std::max(bits_, sample_levels(s_.right).bits);
    for (DataNote& note : levels.notes) s_.notes.push_back(std::move(note));
    for (const std::string& odd :
         {odd_spacing(s_.stamps_ns, "frame"), irregular_spacing(s_.stamps_ns)})
      if (!odd.empty()) s_.notes.push_back({odd, false, NoteCause::kTimes, ""});
    if (s_.ground_truth)
      for (const std::string& warning : s_.ground_truth->warnings) s_.notes.push_back({warning});
    if (s_.ground_truth && s_.ground_truth->posed() < n)
      s_.notes.push_back(
          {fmt::format("{} of {} frames have no ground truth", n - s_.ground_truth->posed(), n)});
  }

  const std::string& name() const override { return s_.name; }
  const std::string& format() const override { return s_.format; }
  std::size_t size() const override { return s_.stamps_ns.size(); }
  std::vector<Sensor> sensors() const override { return sensors_of(s_.calibration); }
  Calibration calibration(Sensor sensor) const override {
    return calibration_for(sensor, s_.calibration, s_.name);
  }
  std::string image_path(std::size_t index) const override {
    require(index < size(), "image_path: no such frame");
    return s_.left[index];
  }
  std::int64_t stamp_ns(std::size_t index) const override {
    check_index(index);
    return s_.stamps_ns[index];
  }
  bool images_rectified() const override { return s_.rectified || s_.calibration.baseline_m > 0; }
  const std::optional<Trajectory>& ground_truth() const override { return s_.ground_truth; }
  std::vector<DataNote> notes() const override { return s_.notes; }

  Frame frame(std::size_t index, Sensor sensor) const override {
    check_index(index);
    calibration_for(sensor, s_.calibration, s_.name);
    Frame frame;
    frame.id = FrameId(index);
    frame.stamp_ns = s_.stamps_ns[index];
    const GreyAndColour left = read_camera_images(s_.left[index], s_.left_remap);
    frame.image = left.grey;
    frame.colour = left.colour;
    if (sensor == Sensor::kStereo) {
      frame.right = read_camera_images(s_.right[index], s_.right_remap).grey;
    }
    if (sensor == Sensor::kRgbd) {
      const Camera& camera = s_.calibration.depth->camera;
      const Image raw = read_depth(s_.depth[index], s_.depth_unit_m);
      require_size(s_.depth[index], raw, camera.width, camera.height);
      frame.depth = s_.depth_remap.nearest(raw);
    }
    return frame;
  }

 private:
  void check_index(std::size_t index) const {
    if (index < size()) return;
    throw ArgumentError(fmt::format("{}: frame {} of {}", s_.name, index, size()));
  }

  GreyAndColour read_camera_images(const std::string& path, const Remap& remap) const {
    GreyAndColour images = read_image(path, bits_);
    require_size(path, images.grey, s_.raw_camera.width, s_.raw_camera.height);
    if (remap.is_identity()) return images;
    if (images.colour.empty()) return {remap.bilinear(images.grey), {}};
    images.colour = remap.bilinear(images.colour);
    images.grey = to_grey(images.colour);
    return images;
  }

  RecordedSequence s_;
  int bits_ = 16;  ///< number of used bits of 16-bit images
};

}  // namespace

std::unique_ptr<Dataset> make_dataset(RecordedSequence sequence) {
  return std::make_unique<RecordedDataset>(std::move(sequence));
}

Calibration calibration_for(Sensor sensor, const Calibration& calibration,
                            const std::string& name) {
  Calibration result = calibration;
  if (sensor == Sensor::kStereo && !(calibration.baseline_m > 0)) {
    throw ArgumentError(name +
                        ": has no calibrated right camera, so that it cannot be run as stereo");
  }
  if (sensor == Sensor::kRgbd && !calibration.depth) {
    throw ArgumentError(name + ": has no depth images, so that it cannot be run as rgbd");
  }
  if (sensor != Sensor::kStereo) result.baseline_m = 0;
  if (sensor != Sensor::kRgbd) result.depth.reset();
  return result;
}

std::vector<Sensor> sensors_of(const Calibration& calibration) {
  std::vector<Sensor> sensors;
  if (calibration.baseline_m > 0) sensors.push_back(Sensor::kStereo);
  if (calibration.depth) sensors.push_back(Sensor::kRgbd);
  sensors.push_back(Sensor::kMono);
  return sensors;
}

std::string folder_name(const std::string& path) {
  const auto normal = std::filesystem::absolute(path).lexically_normal();
  return (normal.has_filename() ? normal : normal.parent_path()).filename().string();
}

std::vector<std::int64_t> synthetic_stamps_ns(std::size_t count, double rate_hz) {
  std::vector<std::int64_t> stamps_ns(count);
  for (std::size_t i = 0; i < count; ++i) {
    stamps_ns[i] = std::llround(static_cast<double>(i) * 1e9 / rate_hz);
  }
  return stamps_ns;
}

}  // namespace placegraph
