#pragma once
#include <placegraph/io/datasets/dataset.h>

#include <functional>

#include "tests/support/scenes/scene.h"
#include "tests/support/scenes/texture.h"

namespace placegraph::test {

/// A short textured street between house fronts, with a wall at its end. World: x right, y down, z
/// forward, the road is y = 0.
inline std::vector<TexturedPlane> street() {
  const auto facing = [](const Eigen::Vector3d& x, const Eigen::Vector3d& y,
                         const Eigen::Vector3d& origin) {
    Eigen::Matrix3d R;
    R << x, y, x.cross(y);
    return SE3(R, origin);
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  return {{facing(x, z, {0, 0, 0}), 100, 100, {101, 2.5, 2, 55}},
          {facing(z, y, {-5, -5, 15}), 40, 5, {102, 1.6, 4, 45}},
          {facing(z, y, {5, -5, 15}), 40, 5, {103, 1.6, 4, 45}},
          {facing(x, y, {0, -5, 32}), 5, 5, {104, 1.6, 4, 45}}};
}

inline constexpr double kStreetHeight_m = 1.65, kStreetBaseline_m = 0.5;
/// Coarser ones do not see the far road well enough for a scale to a percent.
inline Camera street_camera() { return pinhole(448, 280, 330); }

/// Frame `i` of the drive: 0.4 m a frame, a slight bend.
inline SE3 street_T_world_cam(int i) {
  return pose({0, 0.004 * i, 0}, {0.02 * i + 0.001 * i * i, -kStreetHeight_m, 0.4 * i});
}

/// The drive, or another way along the street, as a recorded sequence in memory. Frames in
/// [dark_begin, dark_end) are black.
class StreetDataset : public Dataset {
 public:
  explicit StreetDataset(int frames, int dark_begin = 0, int dark_end = 0, bool with_depth = false,
                         const std::function<SE3(int)>& T_world_cam = street_T_world_cam)
      : with_depth_(with_depth) {
    const auto planes = street();
    Trajectory truth;
    for (int i = 0; i < frames; ++i) {
      const SE3 T_world_left = T_world_cam(i);
      const SE3 T_world_right = T_world_left * pose({0, 0, 0}, {kStreetBaseline_m, 0, 0});
      Picture left = render(street_camera(), T_world_left, planes, 2);
      Picture right = render(street_camera(), T_world_right, planes, 2);
      if (i >= dark_begin && i < dark_end) left.grey.setTo(0), right.grey.setTo(0);
      Frame frame;
      frame.id = FrameId(i);
      frame.stamp_ns = stamp_ns(static_cast<std::size_t>(i));
      frame.image = left.grey;
      frame.right = right.grey;
      frame.depth = left.depth;
      frames_.push_back(frame);
      truth.poses.push_back({frame.stamp_ns, T_world_left.isometry()});
    }
    truth_ = truth;
  }
  const std::string& name() const override { return name_; }
  const std::string& format() const override { return format_; }
  std::size_t size() const override { return frames_.size(); }
  std::vector<Sensor> sensors() const override {
    return with_depth_ ? std::vector{Sensor::kRgbd, Sensor::kMono}
                       : std::vector{Sensor::kStereo, Sensor::kMono};
  }
  Calibration calibration(Sensor sensor) const override {
    Calibration calibration;
    calibration.camera = street_camera();
    if (sensor == Sensor::kStereo) calibration.baseline_m = kStreetBaseline_m;
    if (sensor == Sensor::kRgbd) calibration.depth = DepthCamera{street_camera(), SE3(), 0.005};
    return calibration;
  }
  std::int64_t stamp_ns(std::size_t index) const override {
    return static_cast<std::int64_t>(index) * 100'000'000;
  }
  Frame frame(std::size_t index, Sensor sensor) const override {
    Frame frame = frames_.at(index);
    if (sensor != Sensor::kStereo) frame.right = Image();
    if (sensor != Sensor::kRgbd) frame.depth = Image();
    return frame;
  }
  const std::optional<Trajectory>& ground_truth() const override { return truth_; }

 private:
  std::string name_ = "street", format_ = "memory";
  bool with_depth_;
  std::vector<Frame> frames_;
  std::optional<Trajectory> truth_;
};

}  // namespace placegraph::test
