// A run that is killed and resumed says in the end what the whole run says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/core.hpp>

#include "tests/support/scenes/street.h"
#include "tests/support/seed.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace interrupted_run_test {

using namespace test;

constexpr int kFrames = 44;

SE3 looking_around(int i) {
  return pose({0, 0.06 * std::sin(0.5 * i), 0}, {0, -kStreetHeight_m, 0.25 * i});
}

/// The street, with blocks that hang on the lens, and with copies of some of the first images.
class FaultyStreet : public StreetDataset {
 public:
  FaultyStreet(bool covered, bool copies)
      : StreetDataset(kFrames, 0, 0, false, looking_around), covered_(covered), copies_(copies) {}
  Frame frame(std::size_t index, Sensor sensor) const override {
    const bool copied = copies_ && index >= 4 && index < 12 && index % 2 == 1;
    Frame frame = StreetDataset::frame(copied ? index - 1 : index, sensor);
    frame.id = FrameId(index);
    frame.stamp_ns = stamp_ns(index);
    if (!covered_) return frame;
    for (Image* image : {&frame.image, &frame.right}) {
      if (image->empty()) continue;
      *image = image->clone();
      cv::RNG random(7);
      for (int v = 70; v < 220; v += 10)
        for (int u = 120; u < 320; u += 10)
          (*image)(cv::Rect(u, v, 10, 10)).setTo(random.uniform(0, 256));
    }
    return frame;
  }

 private:
  bool covered_, copies_;
};

struct Killed {};

/// A run that ends without a word after so many frames, or runs to its end.
class KilledRun {
 public:
  KilledRun(const Dataset& dataset, Sensor sensor, const std::string& path)
      : dataset_(dataset), path_(path) {
    options_.sensor = sensor == Sensor::kMono ? SensorChoice::kMono : SensorChoice::kStereo;
    options_.threads = 1;
    options_.slam.odometry.points.tracker.max_tracks = 250;
  }

  /// Nothing if it was killed.
  std::optional<RunResult> run(std::optional<int> frames) {
    RunInputs inputs;
    inputs.map_file = {path_, "street", std::filesystem::exists(path_)};
    int seen = 0;
    inputs.observer = [&](const Frame&, const FrameResult&, const FrameView&) {
      if (frames && ++seen > *frames) throw Killed();
    };
    try {
      return run_sequence(dataset_, options_, inputs);
    } catch (const Killed&) {
      return std::nullopt;
    }
  }

 private:
  const Dataset& dataset_;
  std::string path_;
  RunOptions options_;
};

std::vector<NoteCause> causes_of(const std::vector<DataNote>& notes) {
  std::vector<NoteCause> causes;
  for (const DataNote& note : notes) causes.push_back(note.cause);
  return causes;
}

std::size_t saved_frames(const std::string& path) {
  return std::filesystem::exists(path) ? read_map(path).map.frames.size() : 0;
}

TEST(InterruptedRun, LosesNothingAndIsJudgedAsTheWholeRun) {
  Random random = seeded_random(11);
  for (int round = 0; round < 2; ++round) {
    const bool covered = round == 0;
    const FaultyStreet street(covered, true);
    const Sensor sensor = covered ? Sensor::kMono : Sensor::kStereo;
    const TemporaryFolder dir;
    RunResult whole = *KilledRun(street, sensor, dir / "whole.db").run(std::nullopt);
    const std::vector<DataNote> expected = whole.notes;
    const std::string path = dir / "map.db";
    KilledRun run(street, sensor, path);
    std::string kills;
    std::optional<RunResult> result;
    for (int kill = 0; kill < 3 && !result; ++kill) {
      const int frames = 1 + random.index(2 * kFrames);
      kills += " " + std::to_string(frames);
      const std::size_t before = saved_frames(path);
      result = run.run(frames);
      EXPECT_GE(saved_frames(path), before) << "round " << round << ", killed after" << kills;
    }
    if (!result) result = run.run(std::nullopt);
    SCOPED_TRACE("round " + std::to_string(round) + ", killed after" + kills);
    EXPECT_EQ(result->map.frames.size(), whole.map.frames.size());
    EXPECT_EQ(causes_of(result->notes), causes_of(expected));
    for (std::size_t i = 0; i < expected.size() && i < result->notes.size(); ++i)
      if (expected[i].cause == NoteCause::kRepeatedFrames) {
        EXPECT_EQ(result->notes[i].text, expected[i].text);
      }
    const Judgement judged = judge(*result, {}, 0.5), as_whole = judge(whole, {}, 0.5);
    EXPECT_EQ(judged.verdict, as_whole.verdict);
    // What a finished run says, it says again.
    RunResult again = *run.run(std::nullopt);
    EXPECT_EQ(causes_of(again.notes), causes_of(result->notes));
    const Judgement judged_again = judge(again, {}, 0.5);
    EXPECT_EQ(causes_of(judged_again.findings), causes_of(judged.findings));
    EXPECT_EQ(judged_again.expected_drift_m, judged.expected_drift_m);
    ASSERT_EQ(again.stages.size(), result->stages.size());
    for (const StageTime& stage : result->stages)
      if (stage.name == "reading") {
        EXPECT_GE(stage.calls, kFrames);
      }
    EXPECT_FALSE(std::filesystem::exists(path + ".restart"));
  }
}

}  // namespace interrupted_run_test
}  // namespace placegraph
