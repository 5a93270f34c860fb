#pragma once
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/dataset.h>

#include <string>
#include <vector>

#include "tests/support/scenes/scene.h"

namespace placegraph::test {

/// A recording of small black images, ten a second, for tests of what surrounds the tracking. The
/// frame at `unreadable` is a broken file.
class BlankDataset : public Dataset {
 public:
  explicit BlankDataset(std::size_t frames, std::vector<Sensor> sensors = {Sensor::kMono},
                        std::size_t unreadable = 1000)
      : frames_(frames), sensors_(std::move(sensors)), unreadable_(unreadable) {}
  const std::string& name() const override { return name_; }
  const std::string& format() const override { return name_; }
  std::size_t size() const override { return frames_; }
  std::vector<Sensor> sensors() const override { return sensors_; }
  Calibration calibration(Sensor sensor) const override {
    Calibration calibration;
    calibration.camera = pinhole(96, 64, 80);
    if (sensor == Sensor::kStereo) calibration.baseline_m = 0.5;
    if (sensor == Sensor::kRgbd) calibration.depth = DepthCamera{calibration.camera, SE3(), 0.005};
    return calibration;
  }
  std::int64_t stamp_ns(std::size_t index) const override {
    return static_cast<std::int64_t>(index) * 100'000'000;
  }
  Frame frame(std::size_t index, Sensor) const override {
    if (index == unreadable_) throw FileError("image_7.png", "cannot be read");
    Frame frame;
    frame.id = FrameId(static_cast<std::int64_t>(index));
    frame.stamp_ns = stamp_ns(index);
    frame.image = Image(64, 96, CV_8UC1, cv::Scalar(0));
    return frame;
  }
  const std::optional<Trajectory>& ground_truth() const override { return truth_; }

 private:
  std::string name_ = "blank";
  std::size_t frames_;
  std::vector<Sensor> sensors_;
  std::size_t unreadable_;
  std::optional<Trajectory> truth_;
};

}  // namespace placegraph::test
