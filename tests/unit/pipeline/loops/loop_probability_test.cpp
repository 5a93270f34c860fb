#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/loops/loop_probability.h>

namespace placegraph {
namespace loop_probability_test {

LoopRecord record(LoopStage stage, double similarity, int inliers) {
  LoopRecord record;
  record.stage = stage;
  record.similarity = similarity;
  record.inliers = inliers;
  return record;
}

TEST(LoopProbability, GrowWithWhatSpeaksForALoop) {
  const double p = loop_probability(record(LoopStage::kGeometry, 0.4, 20));
  EXPECT_GT(p, 0);
  EXPECT_LT(p, 1);
  EXPECT_GT(loop_probability(record(LoopStage::kGeometry, 0.8, 20)), p);
  EXPECT_GT(loop_probability(record(LoopStage::kGeometry, 0.4, 60)), p);
  EXPECT_GT(loop_probability(record(LoopStage::kAccepted, 0.4, 60)), 0.9);
  EXPECT_LT(loop_probability(record(LoopStage::kRetrieval, 0.1, 0)), 0.01);
  EXPECT_GT(loop_probability(record(LoopStage::kAccepted, 0.4, 60)),
            loop_probability(record(LoopStage::kCovariance, 0.4, 60)));
}

TEST(LoopProbability, LinesCountAsPointsDo) {
  LoopRecord with_lines = record(LoopStage::kSupport, 0.5, 30);
  with_lines.lines = 10;
  EXPECT_EQ(loop_probability(with_lines), loop_probability(record(LoopStage::kSupport, 0.5, 40)));
}

TEST(LoopProbability, StayFiniteAtTheBounds) {
  for (const LoopStage stage : {LoopStage::kRetrieval, LoopStage::kGeometry, LoopStage::kDrift,
                                LoopStage::kCovariance, LoopStage::kSupport, LoopStage::kAccepted})
    for (const double similarity : {0.0, 1e9}) {
      const double p = loop_probability(record(stage, similarity, 0));
      EXPECT_GE(p, 0);
      EXPECT_LE(p, 1);
    }
}

}  // namespace loop_probability_test
}  // namespace placegraph
