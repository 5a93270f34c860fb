#include <gtest/gtest.h>
#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/loops/loop_truth_from_poses.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/loops/loop_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <numbers>

#include "tests/support/data.h"
#include "tests/support/ids.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace loop_benchmark_test {

using test::isometry;

LoopPrediction message(std::int64_t query, std::int64_t candidate, double score) {
  return {FrameId(query), FrameId(candidate), score, "", 0};
}

/// Queries 10, 11 and 12 among the candidates 0 to 5; 12 shows nothing known.
LoopTruth three_queries() {
  LoopTruth truth;
  truth.queries = {{FrameId(10), {FrameId(0), FrameId(5), test::ids<FrameId>({1, 2})}},
                   {FrameId(11), {FrameId(0), FrameId(5), test::ids<FrameId>({3})}},
                   {FrameId(12), {FrameId(0), FrameId(5), {}}}};
  return truth;
}

TEST(LoopBenchmark, JudgesTheBestCandidateOfEachQuery) {
  const LoopBenchmark b =
      judge_loops(three_queries(), {message(10, 0, 0.2), message(10, 2, 0.9), message(11, 4, 0.8),
                                    message(11, 3, 0.7), message(12, 5, 0.1)});
  EXPECT_EQ(b.positives, 2);
  EXPECT_EQ(b.predicted_queries, 3);
  EXPECT_DOUBLE_EQ(b.recall_at[0].value(), 0.5);
  EXPECT_DOUBLE_EQ(b.recall_at[1].value(), 1);
  EXPECT_DOUBLE_EQ(b.curve.recall_at_full_precision.value(), 0.5);
  EXPECT_DOUBLE_EQ(b.curve.average_precision.value(), 0.5);
  EXPECT_DOUBLE_EQ(b.curve.curve.back().precision, 1.0 / 3);
  ASSERT_EQ(b.queries.size(), 3u);
  EXPECT_EQ(b.queries[0].verdict, LoopVerdict::kHit);
  EXPECT_EQ(b.queries[1].verdict, LoopVerdict::kMiss);
  EXPECT_EQ(b.queries[1].rank, 2);
  EXPECT_EQ(b.queries[2].verdict, LoopVerdict::kMiss);
  EXPECT_FALSE(b.queries[2].has_match);
}

// A recognizer that answers for descriptors names an image several times: a rank would count it as
// often.
TEST(LoopBenchmark, RefusesACandidateThatAQueryHasTwice) {
  try {
    (void)judge_loops(three_queries(),
                      {message(10, 0, 0.9), message(11, 0, 0.9), message(10, 0, 0.8)});
    FAIL() << "it was judged";
  } catch (const ArgumentError& error) {
    EXPECT_STREQ(error.what(), "judge_loops: query 10 has candidate 0 twice");
  }
}

TEST(LoopBenchmark, LeavesOutWhatIsNoCandidateWhetherRightOrWrong) {
  LoopTruth truth = three_queries();
  truth.min_age = 9;  // 11 may match 2 at most: its match is none, nor is 2 one of 10's
  const LoopBenchmark b = judge_loops(
      truth, {message(10, 2, 0.9), message(10, 7, 0.8), message(10, 1, 0.3), message(11, 3, 1)});
  EXPECT_EQ(b.positives, 1);
  EXPECT_EQ(b.dropped, 3);
  EXPECT_EQ(b.queries[0].best.candidate, FrameId(1));
  EXPECT_EQ(b.queries[1].verdict, LoopVerdict::kTooYoung);
  EXPECT_EQ(b.queries[2].verdict, LoopVerdict::kSilent);
  EXPECT_DOUBLE_EQ(b.curve.average_precision.value(), 1);
  const LoopBenchmark outside = judge_loops(three_queries(), {message(10, 7, 0.8)});
  EXPECT_EQ(outside.queries[0].verdict, LoopVerdict::kOutOfRange);
  EXPECT_EQ(outside.predicted_queries, 0);
}

TEST(LoopBenchmark, CountsImagesThatAreNotListedOnlyWhereTheTruthIsWhole) {
  LoopTruth truth = three_queries();
  EXPECT_EQ(judge_loops(truth, {message(99, 1, 1)}).unjudged, 1);
  truth.unlisted_have_none = true;
  const LoopBenchmark b = judge_loops(truth, {message(99, 1, 1)});
  EXPECT_EQ(b.unjudged, 0);
  EXPECT_EQ(b.queries.back().verdict, LoopVerdict::kMiss);
}

TEST(LoopBenchmark, PutsFalseCandidatesOfTheSameScoreFirst) {
  const LoopBenchmark b = judge_loops(three_queries(), {message(10, 1, 0.5), message(10, 4, 0.5)});
  EXPECT_EQ(b.queries[0].verdict, LoopVerdict::kMiss);
  EXPECT_EQ(b.queries[0].rank, 2);
}

TEST(LoopBenchmark, AcceptsMatchesWithinTheTolerance) {
  EXPECT_EQ(judge_loops(three_queries(), {message(11, 5, 1)}, 1).queries[1].verdict,
            LoopVerdict::kMiss);
  EXPECT_EQ(judge_loops(three_queries(), {message(11, 5, 1)}, 2).queries[1].verdict,
            LoopVerdict::kHit);
  EXPECT_THROW((void)judge_loops(three_queries(), {}, -1), ArgumentError);
}

TEST(LoopBenchmark, DefinesNoRecallWhereNothingIsToBeFound) {
  LoopTruth truth;
  truth.queries = {{FrameId(7), {FrameId(0), FrameId(5), {}}}};
  const LoopBenchmark b = judge_loops(truth, {message(7, 1, 1)});
  EXPECT_EQ(b.positives, 0);
  EXPECT_FALSE(b.recall_at[0]);
  EXPECT_EQ(b.curve.curve.back().misses, 1);
}

TEST(LoopTruthFromPoses, AsksForDistanceHeadingAndAge) {
  Trajectory truth;
  const auto add = [&](double x, double yaw_deg) {
    truth.poses.push_back({0, isometry({0, deg_to_rad(yaw_deg), 0}, {x, 0, 0})});
  };
  add(0, 0), add(1, 0), add(20, 0), add(4, 40), add(5, 20);
  truth.poses.push_back({0, std::nullopt});
  const LoopTruth revisits = loop_truth_from_poses(truth, {{5, 30}, 2});
  EXPECT_EQ(revisits.min_age, 2);
  EXPECT_EQ(revisits.queries.size(), 5u);  // a lost image is not judged
  EXPECT_TRUE(revisits.queries.at(FrameId(1)).matches.empty());
  EXPECT_TRUE(revisits.queries.at(FrameId(3)).matches.empty());  // turned too far
  EXPECT_EQ(revisits.queries.at(FrameId(4)).matches, test::ids<FrameId>({0, 1}));
  EXPECT_EQ(revisits.queries.at(FrameId(4)).last, FrameId(2));
  EXPECT_THROW((void)loop_truth_from_poses(truth, {{5, 30}, 0}), ArgumentError);
}

struct Published {
  const char* sequence;
  double recall, average_precision;
};

class GoldenLoops : public ::testing::TestWithParam<Published> {};

TEST_P(GoldenLoops, ScoreAsPublished) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "golden/loops");
  const std::string name = std::string("KITTI") + GetParam().sequence;
  LoopTruth truth =
      read_loop_truth(folder + "/KITTI_" + GetParam().sequence + "_loops_10m.txt").truth;
  truth.min_age = 300;
  const LoopBenchmark b = judge_loops(
      truth, read_loop_predictions(folder + "/ibow_" + name + "_loops.txt", LoopFileFormat::kIbow));
  EXPECT_NEAR(b.curve.recall_at_full_precision.value(), GetParam().recall, 0.002);
  EXPECT_NEAR(b.curve.average_precision.value(), GetParam().average_precision, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Kitti, GoldenLoops,
                         ::testing::Values(Published{"00", 0.818, 0.870},
                                           Published{"06", 0.814, 0.814}),
                         [](const auto& published) {
                           return std::string("Sequence") + published.param.sequence;
                         });

TEST(LoopTruthFromPoses, CountsTheRevisitsOfRealDrives) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "kitti_gt/06");
  const LoopTruth revisits = loop_truth_from_poses(read_trajectory(folder + "/poses.txt"), {});
  EXPECT_EQ(judge_loops(revisits, {}).positives, 270);
}

}  // namespace loop_benchmark_test
}  // namespace placegraph
