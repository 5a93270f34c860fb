#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/pipeline/run.h>

#include "tests/support/scenes/posed_map.h"
#include "tests/support/scenes/scene.h"

namespace placegraph {
namespace judgement_test {

using testing::HasSubstr;
using testing::IsEmpty;

/// A monocular run in metres: a letter a frame, its component ('0', '1') or '.' for no pose.
RunResult run_of(const std::string& frames) {
  RunResult run;
  run.calibration.camera_height_m = 1.65;
  std::vector<SE3> poses;
  for (std::size_t i = 0; i < frames.size(); ++i)
    poses.push_back(test::pose({0, 0, 0}, {0, 0, 1.0 * static_cast<double>(i)}));
  run.map = test::posed_map(poses);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    FrameRecord record;
    record.frame = FrameId(static_cast<std::int64_t>(i));
    record.stamp_ns = 100 * static_cast<std::int64_t>(i);
    if (frames[i] != '.') {
      record.keyframe = KeyframeId(static_cast<std::int64_t>(i));
      record.T_keyframe_frame = SE3();
      run.map.place_graph.places[i].component = frames[i] - '0';
    }
    run.map.frames.push_back(record);
    if (i > 0 && frames[i] != '.' && frames[i - 1] == frames[i]) {
      RelativePoseConstraint edge{.from = NodeId(static_cast<std::int64_t>(i) - 1),
                                  .to = NodeId(static_cast<std::int64_t>(i)),
                                  .T_from_to = test::pose({0, 0, 0}, {0, 0, 1}),
                                  .information = 1e6 * Matrix6d::Identity(),
                                  .kernel = {}};
      run.map.place_graph.constraints.push_back(edge);
    }
  }
  return run;
}

Judgement judged(RunResult run, const std::vector<DataNote>& notes, double min_posed) {
  return judge(run, notes, min_posed);
}

std::vector<std::string> causes_of(const Judgement& judgement) {
  std::vector<std::string> causes;
  for (const DataNote& finding : judgement.findings) causes.push_back(to_string(finding.cause));
  return causes;
}

TEST(Judgement, IsGoodWhereNothingContradicts) {
  const Judgement judgement = judged(run_of("00000000"), {}, 0.2);
  EXPECT_EQ(judgement.verdict, Verdict::kGood);
  EXPECT_TRUE(judgement.metric);
  EXPECT_THAT(judgement.why_metric, HasSubstr("camera height of 1.65 m"));
  EXPECT_THAT(judgement.findings, IsEmpty());
}

TEST(Judgement, NamesWhatGivesTheScale) {
  RunResult run = run_of("0000");
  run.sensor = Sensor::kStereo;
  run.calibration.baseline_m = 0.54;
  EXPECT_THAT(judge(run, {}, 0.2).why_metric, HasSubstr("baseline of 0.54 m"));
  run.sensor = Sensor::kRgbd;
  EXPECT_THAT(judge(run, {}, 0.2).why_metric, HasSubstr("depth images"));
  run.sensor = Sensor::kMono;
  run.calibration.camera_height_m.reset();
  EXPECT_THAT(judge(run, {}, 0.2).why_metric, HasSubstr("other sensors"));
  run.map.metric = false;
  const Judgement unknown = judge(run, {}, 0.2);
  EXPECT_FALSE(unknown.metric);
  EXPECT_EQ(unknown.verdict, Verdict::kGood);
  EXPECT_THAT(unknown.why_metric, HasSubstr("does not observe the scale"));
}

TEST(Judgement, DoubtsTheScaleByANoteThatDoes) {
  const DataNote doubt{"the ground is not below", true, NoteCause::kCameraHeight, "measure it"};
  for (const bool of_data : {true, false}) {
    RunResult run = run_of("0000");
    if (!of_data) run.notes = {doubt};
    const Judgement judgement =
        judge(run, of_data ? std::vector{doubt} : std::vector<DataNote>(), 0.2);
    EXPECT_EQ(judgement.verdict, Verdict::kDoubtful);
    EXPECT_FALSE(judgement.metric);
    EXPECT_FALSE(run.map.metric);
    EXPECT_EQ(judgement.why_metric, "in doubt: the ground is not below");
    EXPECT_THAT(causes_of(judgement), testing::ElementsAre("camera_height_questionable"));
  }
}

TEST(Judgement, IgnoresNotesWithoutACause) {
  EXPECT_EQ(judged(run_of("0000"), {{"2 of 4 frames have no ground truth"}}, 0.2).verdict,
            Verdict::kGood);
}

TEST(Judgement, FailsBelowTheShareOfFramesWithAPose) {
  EXPECT_EQ(judged(run_of("00......"), {}, 0.3).verdict, Verdict::kFailed);
  EXPECT_THAT(causes_of(judged(run_of("00......"), {}, 0.3)), testing::Contains("few_posed"));
  EXPECT_NE(judged(run_of("00......"), {}, 0.25).verdict, Verdict::kFailed);
  EXPECT_EQ(judged(run_of("...."), {}, 0).verdict, Verdict::kFailed);
}

TEST(Judgement, DoubtsARunThatLeavesMostFramesWithoutAPose) {
  const Judgement few = judged(run_of("000....."), {}, 0.2);
  EXPECT_EQ(few.verdict, Verdict::kDoubtful);
  EXPECT_THAT(causes_of(few), testing::Contains("few_posed"));
  EXPECT_EQ(few.findings[0].text, "3 of 8 frames have a pose");
  EXPECT_THAT(causes_of(judged(run_of("0000...."), {}, 0.2)),
              testing::Not(testing::Contains("few_posed")));
}

TEST(Judgement, NamesFramesOfLowConfidence) {
  RunResult run = run_of("0000000000");
  for (FrameRecord& frame : run.map.frames) frame.confidence = 0.8;
  run.map.frames[3].confidence = 0.45;
  run.map.frames[5].confidence = 0.2;
  EXPECT_THAT(causes_of(judge(run, {}, 0.2)), IsEmpty());
  run.map.frames[6].confidence = 0.1;
  run.map.frames[7].confidence.reset();
  const Judgement judgement = judge(run, {}, 0.2);
  ASSERT_THAT(causes_of(judgement), testing::ElementsAre("jump"));
  EXPECT_THAT(judgement.findings[0].text, HasSubstr("in 2 frames"));
  EXPECT_THAT(judgement.findings[0].text, HasSubstr("the first is frame 5"));
}

TEST(Judgement, NamesSpansOfLowConfidence) {
  RunResult run = run_of(std::string(40, '0'));
  for (std::size_t i = 0; i < 40; ++i) run.map.frames[i].confidence = i < 20 ? 0.8 : 0.81;
  for (std::size_t i = 12; i < 17; ++i) run.map.frames[i].confidence = 0.5;
  EXPECT_THAT(causes_of(judge(run, {}, 0.2)), IsEmpty());  // too short
  for (std::size_t i = 17; i < 22; ++i) run.map.frames[i].confidence = 0.5;
  const Judgement judgement = judge(run, {}, 0.2);
  ASSERT_THAT(causes_of(judgement), testing::ElementsAre("drift_large"));
  EXPECT_THAT(judgement.findings[0].text, HasSubstr("less than two thirds of the usual share"));
}

TEST(Judgement, SaysWhetherTheScaleIsChecked) {
  RunResult run = run_of("0000");
  run.map.metric = true;
  run.sensor = Sensor::kStereo;
  run.calibration.baseline_m = 0.5;
  run.calibration.camera_height_m.reset();
  EXPECT_EQ(judge(run, {}, 0.2).why_metric,
            "by the baseline of 0.5 m; nothing in the recording checks it");
  run.calibration.camera_height_m = 1.65;
  EXPECT_EQ(judge(run, {}, 0.2).why_metric,
            "by the baseline of 0.5 m; the camera height checks it to 40 % only");
}

TEST(Judgement, ListsLostSpansAndComponents) {
  const Judgement judgement = judged(run_of("..000..0.111"), {}, 0.2);
  EXPECT_EQ(judgement.verdict, Verdict::kDoubtful);
  ASSERT_THAT(causes_of(judgement), testing::ElementsAre("components", "lost_frames"));
  EXPECT_THAT(judgement.findings[0].text, HasSubstr("frames 2 to 7 (main), frames 9 to 11"));
  EXPECT_THAT(judgement.findings[1].text,
              HasSubstr("3 of 12 frames are lost after the beginning: in 2 spans, the longest is "
                        "frames 5 to 6"));
}

}  // namespace judgement_test
}  // namespace placegraph
