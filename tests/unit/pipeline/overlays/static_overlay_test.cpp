#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/pipeline/overlays/static_overlay.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace static_overlay_test {

using namespace test;
using ::testing::HasSubstr;

/// Blocks of random grey levels.
Image pattern(int width, int height) {
  constexpr int kBlock = 10;
  cv::RNG random(7);
  Image blocks(height, width, CV_8UC1);
  for (int v = 0; v < height; v += kBlock)
    for (int u = 0; u < width; u += kBlock)
      blocks(cv::Rect(u, v, kBlock, kBlock) & cv::Rect(0, 0, width, height))
          .setTo(random.uniform(0, 256));
  return blocks;
}

/// A part of the street's images, a fourth of them.
const cv::Rect kCovered(120, 70, 200, 150);

/// The street with something that hangs on the lens.
class CoveredStreet : public StreetDataset {
 public:
  using StreetDataset::StreetDataset;
  Frame frame(std::size_t index, Sensor sensor) const override {
    Frame frame = StreetDataset::frame(index, sensor);
    frame.image = frame.image.clone();
    pattern(kCovered.width, kCovered.height).copyTo(frame.image(kCovered));
    return frame;
  }
};

/// A drive that looks to the left and to the right.
SE3 looking_around(int i) {
  return pose({0, 0.06 * std::sin(0.5 * i), 0}, {0, -kStreetHeight_m, 0.25 * i});
}
SE3 straight_ahead(int i) { return pose({0, 0, 0}, {0, -kStreetHeight_m, 0.25 * i}); }
SE3 at_rest(int) { return straight_ahead(0); }

StaticOverlay watched(const Dataset& dataset) {
  StaticOverlay overlay({}, street_camera(), 1);
  for (std::size_t i = 0; i < dataset.size(); ++i) overlay.add(dataset.frame(i, Sensor::kMono));
  return overlay;
}

TEST(StaticOverlay, IsFoundWhereTheCameraRotates) {
  const StaticOverlay overlay = watched(CoveredStreet(40, 0, 0, false, looking_around));
  ASSERT_FALSE(overlay.mask().empty());
  const double covered = kCovered.area();
  EXPECT_LT(cv::countNonZero(overlay.mask()(kCovered)), 0.15 * covered);
  Image beside = 255 - overlay.mask();
  beside(kCovered).setTo(0);
  EXPECT_LT(cv::countNonZero(beside), 0.5 * covered);
  const auto note = overlay.note();
  ASSERT_TRUE(note);
  EXPECT_EQ(note->cause, NoteCause::kStaticOverlay);
  EXPECT_THAT(note->text, HasSubstr("is fixed to the camera"));
}

TEST(StaticOverlay, IsNotSeenInCleanImagesAndCostsNoTrackingThere) {
  for (const auto& drive : {looking_around, straight_ahead, at_rest}) {
    const StaticOverlay overlay = watched(StreetDataset(40, 0, 0, false, drive));
    EXPECT_TRUE(overlay.mask().empty());
    EXPECT_LT(overlay.tracked_images(), 10);
  }
}

TEST(StaticOverlay, IsNotClaimedWherePointsAtInfinityWouldStandStillToo) {
  EXPECT_TRUE(watched(CoveredStreet(30, 0, 0, false, straight_ahead)).mask().empty());
  EXPECT_TRUE(watched(CoveredStreet(30, 0, 0, false, at_rest)).mask().empty());
}

TEST(StaticOverlay, IsNotTheWorldBehindAMovingObjectOfACameraAtRest) {
  // The pattern stands for a lorry that turns; the street behind it stands still.
  StaticOverlay overlay({}, street_camera(), 1);
  const Image street = StreetDataset(1).frame(0, Sensor::kMono).image;
  const Image lorry = pattern(1000, 1000);
  for (int i = 0; i < 40; ++i) {
    Frame frame;
    frame.id = FrameId(i);
    frame.image = street.clone();
    const cv::Rect from(300 + 10 * i, 300 + static_cast<int>(60 * std::sin(0.5 * i)),
                        kCovered.width, kCovered.height);
    lorry(from).copyTo(frame.image(kCovered));
    overlay.add(frame);
  }
  EXPECT_TRUE(overlay.mask().empty());
}

TEST(StaticOverlay, ExtendsTheMaskOfAFrameWithoutChangingIt) {
  const CoveredStreet dataset(40, 0, 0, false, looking_around);
  const StaticOverlay overlay = watched(dataset);
  Frame frame = dataset.frame(0, Sensor::kMono);
  EXPECT_EQ(overlay.apply(frame).mask.data, overlay.mask().data);
  frame.mask = Image(street_camera().height, street_camera().width, CV_8UC1, cv::Scalar(255));
  frame.mask.row(0).setTo(0);
  const Image given = frame.mask.clone();
  const Frame masked = overlay.apply(frame);
  EXPECT_EQ(cv::countNonZero(masked.mask.row(0)), 0);
  EXPECT_EQ(masked.mask.at<std::uint8_t>(kCovered.y + 70, kCovered.x + 100), 0);
  EXPECT_EQ(cv::norm(given, frame.mask, cv::NORM_INF), 0);
}

TEST(StaticOverlay, HasCapturedAMapThatRestsOnIt) {
  const StaticOverlay overlay = watched(CoveredStreet(40, 0, 0, false, looking_around));
  ASSERT_FALSE(overlay.mask().empty());
  FrameView view;
  const auto add = [&](double u, double v) {
    view.tracks.push_back({LandmarkId(0), {u, v}, {u, v}, Eigen::Vector2d(u, v), {}});
  };
  add(200, 140), add(210, 150), add(10, 10);
  EXPECT_TRUE(overlay.has_captured(view));
  add(20, 10), add(30, 10);
  EXPECT_FALSE(overlay.has_captured(view));
  EXPECT_FALSE(overlay.has_captured({}));
}

/// The drive as it is estimated, with or without a search for overlays.
RunResult run_of(const Dataset& dataset, bool search) {
  RunOptions options;
  options.sensor = SensorChoice::kMono;
  options.threads = 1;
  options.slam.overlays.enabled = search;
  options.slam.odometry.points.tracker.max_tracks = 250;
  return run_sequence(dataset, options);
}

bool has_note(const RunResult& run) {
  return std::ranges::any_of(
      run.notes, [](const DataNote& note) { return note.cause == NoteCause::kStaticOverlay; });
}

TEST(RunWithAStaticOverlay, NamesItOnceAndBeginsAgainWithoutIt) {
  const CoveredStreet dataset(40, 0, 0, false, looking_around);
  int restarts = 0;
  RunOptions options;
  options.sensor = SensorChoice::kMono;
  options.threads = 1;
  RunInputs inputs;
  inputs.log = [&](LogLevel, const std::string& message) {
    restarts += message == "restarting without the regions that are fixed to the camera";
  };
  const RunResult run = run_sequence(dataset, options, inputs);
  EXPECT_GE(restarts, 1);
  EXPECT_LE(restarts, 2);
  EXPECT_TRUE(has_note(run));
  EXPECT_EQ(run.map.frames.size(), dataset.size());
}

TEST(RunWithAStaticOverlay, IsTheSameWithoutOne) {
  const StreetDataset dataset(25, 0, 0, false, looking_around);
  const RunResult with = run_of(dataset, true), without = run_of(dataset, false);
  EXPECT_FALSE(has_note(with));
  const Trajectory a = with.map.trajectory_optimized(), b = without.map.trajectory_optimized();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a.poses[i].T_world_body.has_value(), b.poses[i].T_world_body.has_value());
    if (a.poses[i].T_world_body) {
      EXPECT_EQ(a.poses[i].T_world_body->matrix(), b.poses[i].T_world_body->matrix());
    }
  }
}

}  // namespace static_overlay_test
}  // namespace placegraph
