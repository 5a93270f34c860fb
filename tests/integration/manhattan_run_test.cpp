// Rectangular worlds in a run through a rendered corridor.
#include <gtest/gtest.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/vanishing/manhattan_frame.h>
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/slam.h>

#include <Eigen/Dense>
#include <cmath>
#include <iostream>

namespace placegraph {
namespace manhattan_run_test {

const SyntheticWorld& corridor() {
  static const SyntheticWorld world([] {
    SyntheticOptions options;
    options.world = "corridor-loop";
    return options;
  }());
  return world;
}

SO3 true_rotation(std::size_t index) {
  return SO3::from_matrix(corridor().ground_truth().poses[index].T_world_body->linear());
}

TEST(DirectionsOfARenderedCorridor, AreKnownAsWellAsTheyClaim) {
  // The corridor lies along the axes of its first camera.
  double nees = 0, squared = 0;
  int found = 0, observed = 0;
  for (std::size_t i = 0; i < corridor().size(); i += 40) {
    ++observed;
    const Image image = corridor().render(i, {}).frame.image;
    SegmentDetectorOptions detector;
    detector.min_length_px = 20;
    Random random(1, i);
    const SceneDirections scene = find_scene_directions(
        segments_of(detect_segments(image, detector)), corridor().calibration().camera, {}, random);
    if (scene.frames.empty()) continue;
    const ManhattanFrame& frame = scene.frames[0];
    const SO3 R_cam_map = true_rotation(i).inverse();
    const Eigen::Vector3d e =
        (nearest_axes(frame.R_cam_manhattan, R_cam_map).inverse() * R_cam_map).log();
    if (e.norm() > 2 * kRadPerDeg) continue;  // counted below
    // The frame is named anew along the same axes: its information is turned with it.
    const Eigen::Matrix3d rotation_part =
        (frame.R_cam_manhattan.inverse() * nearest_axes(frame.R_cam_manhattan, R_cam_map)).matrix();
    nees += e.dot(rotation_part.transpose() * frame.information * rotation_part * e);
    squared += e.squaredNorm();
    ++found;
  }
  ASSERT_GT(found, 0.8 * observed);
  const double anees = nees / (3 * found), rms_deg = std::sqrt(squared / found) / kRadPerDeg;
  std::cout << found << " of " << observed << " views, error " << rms_deg
            << " deg, ANEES per degree of freedom " << anees << "\n";
  EXPECT_LT(anees, 2);
  EXPECT_GT(anees, 0.1);
  EXPECT_LT(rms_deg, 0.3);
}

TEST(SlamInARenderedCorridor, TakesDirectionsOfARectangularWorld) {
  SlamOptions options;
  options.odometry.cues = "points,manhattan";
  options.loops.enabled = false;
  Calibration calibration = corridor().calibration();
  calibration.baseline_m = 0;
  Slam slam(options, calibration);
  constexpr std::size_t kFrames = 30;
  int keyframes = 0, seen = 0;
  SE3 T_last;
  for (std::size_t i = 0; i < kFrames; ++i) {
    SyntheticContents contents;
    contents.depth = true;
    const Frame frame = corridor().render(i, contents).frame;
    const FrameResult result = slam.add_frame(frame);
    ASSERT_EQ(result.state, TrackingState::kTracking) << "frame " << i;
    T_last = *result.T_map_cam;
    const FrameView view = slam.view();
    if (!result.keyframe) {
      EXPECT_TRUE(view.directed.empty());
      continue;
    }
    ++keyframes;
    int along = 0;
    for (const FrameView::DirectedLine& line : view.directed) along += line.axis.has_value();
    seen += along >= 8;
  }
  // Two views wait for a third before a world begins.
  EXPECT_GE(keyframes, 4);
  EXPECT_GE(seen, keyframes - 2);
  EXPECT_LT((T_last.rotation().inverse() * true_rotation(kFrames - 1)).log().norm(),
            0.3 * kRadPerDeg);
}

}  // namespace manhattan_run_test
}  // namespace placegraph
