#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/graph/place_history.h>
#include <placegraph/pipeline/slam.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "tests/support/message_of.h"
#include "tests/support/scenes/blank_dataset.h"

namespace placegraph {
namespace slam_test {

using test::BlankDataset;
using test::message_of;
using testing::HasSubstr;

const BlankDataset kFrames(100);

Slam empty_slam() { return {SlamOptions(), kFrames.calibration(Sensor::kMono)}; }

Frame frame_at(std::size_t index) { return kFrames.frame(index, Sensor::kMono); }

TEST(Slam, RefusesAFrameThatDoesNotFitAndGoesOnWithTheNext) {
  Slam slam = empty_slam();
  (void)slam.add_frame(frame_at(3));
  const auto refusal = [&](const Frame& frame) {
    return message_of<ArgumentError>([&] { (void)slam.add_frame(frame); });
  };
  Frame wrong = frame_at(4);
  wrong.image = Image(64, 95, CV_8UC1, cv::Scalar(0));
  EXPECT_THAT(refusal(wrong), HasSubstr("frame 4: grey image of 96x64 needed"));
  wrong.image = Image(64, 96, CV_8UC3, cv::Scalar::all(0));
  EXPECT_THAT(refusal(wrong), HasSubstr("frame 4"));
  wrong = frame_at(4);
  wrong.mask = Image(64, 96, CV_16UC1, cv::Scalar(0));
  EXPECT_THAT(refusal(wrong), HasSubstr("mask"));
  EXPECT_THAT(refusal(frame_at(3)), HasSubstr("frame 3: ids and stamps must increase"));
  wrong = frame_at(4);
  wrong.stamp_ns = frame_at(3).stamp_ns;
  EXPECT_THAT(refusal(wrong), HasSubstr("must increase"));
  (void)slam.add_frame(frame_at(4));
  EXPECT_EQ(slam.finish().frames.size(), 2u);
}

TEST(Slam, EndsOnce) {
  Slam slam = empty_slam();
  (void)slam.add_frame(frame_at(0));
  const Map map = slam.finish();
  EXPECT_EQ(map.frames.size(), 1u);
  EXPECT_TRUE(map.keyframes.empty());
  EXPECT_THROW((void)slam.finish(), ArgumentError);
  EXPECT_THROW((void)slam.add_frame(frame_at(1)), ArgumentError);
  EXPECT_EQ(slam.snapshot().frames.size(), 1u);
}

TEST(Slam, AnInterruptedEndLeavesNoMap) {
  Slam slam = empty_slam();
  (void)slam.add_frame(frame_at(0));
  {
    const InterruptionScope scope([] { throw std::runtime_error("enough"); });
    std::this_thread::sleep_for(std::chrono::milliseconds(120));  // until the next check is due
    EXPECT_THROW((void)slam.finish(), std::runtime_error);
  }
  EXPECT_THROW((void)slam.finish(), ArgumentError);
  EXPECT_THROW((void)slam.snapshot(), ArgumentError);
}

TEST(Slam, LabelsNeedAModel) {
  for (const bool context : {false, true}) {
    SlamOptions options;
    (context ? options.context.enabled : options.semantics.enabled) = true;
    EXPECT_THAT(message_of<ArgumentError>(
                    [&] { Slam slam(options, kFrames.calibration(Sensor::kMono)); }),
                HasSubstr("SlamInputs::surfaces"));
  }
}

TEST(Slam, ResumesOnlyBeforeTheFirstFrameAndAtTheLastKeyframe) {
  Slam begun = empty_slam();
  (void)begun.add_frame(frame_at(0));
  EXPECT_THROW(begun.resume({}, {}, frame_at(0)), ArgumentError);
  EXPECT_THROW((void)begun.add_frame(frame_at(1)), ArgumentError);  // it is of no use any more
  Slam fresh = empty_slam();
  EXPECT_THROW(fresh.resume({}, {}, frame_at(0)), ArgumentError);  // a map without keyframes
}

TEST(Slam, KnowsNothingOfALensOrAnOverlayBeforeItMoves) {
  Slam slam = empty_slam();
  for (std::size_t i = 0; i < 4; ++i) (void)slam.add_frame(frame_at(i));
  EXPECT_EQ(slam.lens().k1, 0);
  EXPECT_EQ(slam.lens().stretches, 0);
  EXPECT_TRUE(slam.overlay_mask().empty());
  EXPECT_FALSE(slam.odometry_error());
  EXPECT_TRUE(slam.environments().empty());
}

}  // namespace slam_test
}  // namespace placegraph
