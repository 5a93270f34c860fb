#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/run.h>
#include <placegraph/pipeline/run_notes.h>

#include "tests/support/message_of.h"
#include "tests/support/scenes/blank_dataset.h"

namespace placegraph {
namespace run_test {

using test::BlankDataset;
using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;

RunResult run_of(const BlankDataset& dataset, const RunOptions& options, RunInputs inputs = {}) {
  return run_sequence(dataset, options, inputs);
}

TEST(Run, ChoosesTheBestSensorOrTheOneThatIsAskedFor) {
  const BlankDataset stereo(1, {Sensor::kStereo, Sensor::kMono}),
      rgbd(1, {Sensor::kRgbd, Sensor::kMono});
  EXPECT_EQ(choose_sensor(stereo, SensorChoice::kAuto), Sensor::kStereo);
  EXPECT_EQ(choose_sensor(rgbd, SensorChoice::kAuto), Sensor::kRgbd);
  EXPECT_EQ(choose_sensor(stereo, SensorChoice::kMono), Sensor::kMono);
  EXPECT_EQ(choose_sensor(stereo, SensorChoice::kStereo), Sensor::kStereo);
  EXPECT_EQ(choose_sensor(rgbd, SensorChoice::kRgbd), Sensor::kRgbd);
  EXPECT_EQ(message_of<ArgumentError>([&] { (void)choose_sensor(rgbd, SensorChoice::kStereo); }),
            "blank: lacks the images that stereo needs; it can be run as rgbd, mono");
}

TEST(Run, CountsFramesFromTheFirstOneAndTellsEachOfThem) {
  const BlankDataset dataset(9);
  for (const int threads : {1, 3}) {
    RunOptions options;
    options.first_frame = 2;
    options.max_frames = 4;
    options.threads = threads;
    std::vector<std::size_t> done, totals;
    std::vector<std::int64_t> seen;
    RunInputs inputs;
    inputs.progress = [&](std::size_t i, std::size_t total, const FrameResult& frame) {
      done.push_back(i);
      totals.push_back(total);
      EXPECT_FALSE(frame.T_map_cam);
    };
    inputs.observer = [&](const Frame& frame, const FrameResult& result, const FrameView&) {
      seen.push_back(frame.id.value());
      EXPECT_EQ(result.frame, frame.id);
    };
    const RunResult result = run_of(dataset, options, inputs);
    EXPECT_THAT(done, ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(totals, ElementsAre(4, 4, 4, 4));
    EXPECT_THAT(seen, ElementsAre(2, 3, 4, 5));
    EXPECT_EQ(result.map.frames.size(), 4u);
    EXPECT_FALSE(result.stopped || result.broken_off || result.resumed_at);
  }
}

TEST(Run, MergesTheReasonsOfFramesWithoutAPose) {
  const RunResult result = run_of(BlankDataset(6), {});
  int frames = 0;
  for (const UnposedFrames& unposed : result.unposed) {
    frames += unposed.count;
    EXPECT_FALSE(unposed.reason.empty());
  }
  EXPECT_EQ(frames, 6);
  EXPECT_LE(result.unposed.size(), 2u);
}

TEST(Run, EndsWhereItIsStopped) {
  int asked = 0;
  RunInputs inputs;
  inputs.stop = [&] { return ++asked > 3; };
  const RunResult result = run_of(BlankDataset(8), {}, inputs);
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.map.frames.size(), 3u);
}

TEST(Run, EndsBeforeAFrameThatCannotBeRead) {
  for (const int threads : {1, 2}) {
    RunOptions options;
    options.threads = threads;
    const RunResult result = run_of(BlankDataset(8, {Sensor::kMono}, 5), options);
    ASSERT_TRUE(result.broken_off);
    EXPECT_THAT(*result.broken_off, HasSubstr("image_7.png"));
    EXPECT_EQ(result.map.frames.size(), 5u);
    EXPECT_THAT(message_of([&] { (void)run_of(BlankDataset(8, {Sensor::kMono}, 0), options); }),
                HasSubstr("image_7.png"));  // the first one is an error
  }
}

TEST(Run, RefusesABeginningBehindTheEnd) {
  RunOptions options;
  options.first_frame = 8;
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)run_of(BlankDataset(8), options); }),
              HasSubstr("first_frame: the sequence has 8 frames"));
}

TEST(RunNotes, ACameraHeightGivesTheScaleOfOneCameraOnly) {
  RunOptions options;
  const BlankDataset mono(3), rgbd(3, {Sensor::kRgbd, Sensor::kMono});
  EXPECT_TRUE(notes_of(rgbd, options).empty());
  options.camera_height_m = 1.6;
  EXPECT_TRUE(notes_of(mono, options).empty());
  ASSERT_EQ(notes_of(rgbd, options).size(), 1u);
  EXPECT_THAT(notes_of(rgbd, options)[0].text, HasSubstr("the depth does"));
  options.sensor = SensorChoice::kMono;
  EXPECT_TRUE(notes_of(rgbd, options).empty());
}

}  // namespace run_test
}  // namespace placegraph
