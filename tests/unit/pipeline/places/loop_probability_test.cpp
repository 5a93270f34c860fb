#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/loop_probability.h>

namespace placegraph {
namespace {

LoopRecord record(const std::string& stage, double likeness, int inliers) {
  LoopRecord record;
  record.stage = stage;
  record.likeness = likeness;
  record.inliers = inliers;
  return record;
}

TEST(LoopOdds, GrowWithWhatSpeaksForALoop) {
  const double p = loop_probability(record("geometry", 0.4, 20));
  EXPECT_GT(p, 0);
  EXPECT_LT(p, 1);
  EXPECT_GT(loop_probability(record("geometry", 0.8, 20)), p);
  EXPECT_GT(loop_probability(record("geometry", 0.4, 60)), p);
  EXPECT_GT(loop_probability(record("accepted", 0.4, 60)), 0.9);
  EXPECT_LT(loop_probability(record("retrieval", 0.1, 0)), 0.01);
  EXPECT_GT(loop_probability(record("accepted", 0.4, 60)),
            loop_probability(record("covariance", 0.4, 60)));
}

TEST(LoopOdds, LinesCountAsPointsDo) {
  LoopRecord with_lines = record("support", 0.5, 30);
  with_lines.lines = 10;
  EXPECT_EQ(loop_probability(with_lines), loop_probability(record("support", 0.5, 40)));
}

TEST(LoopOdds, StayFiniteAtTheBounds) {
  for (const char* stage : {"retrieval", "geometry", "drift", "covariance", "support", "accepted"})
    for (const double likeness : {0.0, 1e9}) {
      const double p = loop_probability(record(stage, likeness, 0));
      EXPECT_GE(p, 0);
      EXPECT_LE(p, 1);
    }
  EXPECT_THROW((void)loop_probability(record("none such", 1, 1)), ArgumentError);
}

}  // namespace
}  // namespace placegraph
