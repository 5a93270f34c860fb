// Images from memory: a stereo camera moves along a textured wall, which is one large picture.
#include <placegraph/pipeline/slam.h>
#include <placegraph/pipeline/slam/slam_events.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <vector>

using namespace placegraph;

constexpr int kWidth = 640, kHeight = 480, kWall = 1200;
constexpr double kFocal = 400, kBaseline = 0.2, kDistance = 4;  // [px], [m], [m]

/// Grey values of a wall, row by row: patches of all sizes.
std::vector<unsigned char> paint_wall() {
  std::vector<unsigned char> wall(std::size_t{kWall} * kHeight, 128);
  std::mt19937 random(1);
  for (int patch = 0; patch < 20000; ++patch) {
    const unsigned size = 2 + random() % 12;
    const unsigned u = random() % (kWall - size), v = random() % (kHeight - size);
    const auto grey = static_cast<unsigned char>(random() % 256);
    for (unsigned row = v; row < v + size; ++row)
      std::fill_n(wall.begin() + row * kWall + u, size, grey);
  }
  return wall;
}

/// The events that this program receives.
struct KeyframeCount final : SlamEvents {
  void keyframe_added(const KeyframeAdded&) override { ++keyframes; }
  int keyframes = 0;
};

int main() {
  std::vector<unsigned char> wall = paint_wall();
  // An Image is a cv::Mat: this one refers to the buffer, and clone() copies a part of it.
  const Image picture(kHeight, kWall, CV_8UC1, wall.data());
  const auto seen_from = [&](int u) { return picture.colRange(u, u + kWidth).clone(); };

  Calibration calibration;
  calibration.camera = {kWidth, kHeight, kFocal, kFocal, kWidth / 2.0, kHeight / 2.0};
  calibration.baseline_m = kBaseline;  // a stereo pair, rectified

  KeyframeCount count;
  Slam slam(SlamOptions{}, calibration, {.events = &count});
  const int disparity_px = static_cast<int>(kFocal * kBaseline / kDistance), step_px = 10;
  FrameResult last;
  for (int i = 0; i < 40; ++i) {
    Frame frame;
    frame.id = FrameId(i);
    frame.stamp_ns = i * 100'000'000ll;
    frame.image = seen_from(i * step_px);
    frame.right = seen_from(i * step_px + disparity_px);
    last = slam.add_frame(frame);
  }
  if (!last.T_map_cam) return 1;
  std::printf("moved %.3f m to the right, %d keyframes\n", last.T_map_cam->translation().x(),
              count.keyframes);
}
