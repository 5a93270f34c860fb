#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/places/loop_feed.h>

#include "tests/support/place_links.h"
#include "tests/support/saved_state.h"

namespace placegraph {
namespace loop_feed_test {

using namespace test;

constexpr double kSigma_m = 0.02, kSigma_rad = 0.004;

SE3 disturbed(const SE3& T, double sigma_m, double sigma_rad, Random& random) {
  Vector6d xi;
  for (Eigen::Index i = 0; i < 6; ++i) xi[i] = (i < 3 ? sigma_m : sigma_rad) * random.normal();
  return T * SE3::exp(xi);
}

/// Rounds along a square with sides of 5 m; from the second round on each corner has a loop to the
/// round before, with `times` the errors that it states.
struct Rounds {
  PlaceMapper mapper;
  LoopFeed loops;
  double variance_of_first_loop() const {
    for (const RelativePoseConstraint& each : mapper.place_graph().constraints)
      if (each.source == ConstraintSource::kLoop) return 1 / each.information(0, 0);
    return 0;
  }
};

/// Every `wrong_every`-th loop errs by a metre; before corner `interrupted_at` the loops are saved
/// and taken up again.
Rounds rounds(int corners, double times_m, double times_rad, int wrong_every = 0,
              int interrupted_at = -1) {
  PlaceOptions options;
  options.merge = false;
  Rounds result{PlaceMapper(options), {}};
  Random random(7);
  const SE3 side = pose({0, std::numbers::pi / 2, 0}, {0, 0, 5});
  result.mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  for (int i = 1; i < corners; ++i) {
    result.mapper.add_keyframe(
        KeyframeId(i),
        link(i - 1, disturbed(side, kSigma_m, kSigma_rad, random), kSigma_m, kSigma_rad), {},
        kDepth_m);
    (void)result.mapper.optimize();
    if (i == interrupted_at) result.loops = resumed(result.loops, LoopFeed());
    if (i < 4) continue;
    SE3 measured = disturbed(SE3(), times_m * kSigma_m, times_rad * kSigma_rad, random);
    if (wrong_every && i % wrong_every == 0) measured = measured * pose({0, 0, 0}, {1, 0, 0});
    result.loops.add({loop(i, i - 4, measured, kSigma_m, kSigma_rad)}, result.mapper);
    (void)result.mapper.optimize();
  }
  return result;
}

TEST(LoopFeed, LeavesLoopsWithTheErrorsThatTheyStateAsTheyAre) {
  EXPECT_LT(rounds(100, 1, 1).loops.factor(), 1.6);
}

TEST(LoopFeed, LearnsByHowMuchErrorsExceedTheStatedOnes) {
  const double factor = rounds(100, 6, 6).loops.factor();
  EXPECT_GT(factor, 36 / 2.0);
  EXPECT_LT(factor, 36 * 2.0);
}

TEST(LoopFeed, AFewWrongLoopsDoNotMakeTheOthersUncertain) {
  EXPECT_LT(rounds(100, 1, 1, 10).loops.factor(), 2);
}

TEST(LoopFeed, DrawsNoConclusionFromTwoLoops) { EXPECT_EQ(rounds(6, 10, 10).loops.factor(), 1); }

TEST(LoopFeed, LoopsThatAreFoundAtOnceAreOneObservationOfTheMap) {
  // The map is off by a metre, and five loops say so.
  PlaceOptions options;
  options.merge = false;
  PlaceMapper mapper(options);
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  for (int i = 1; i < 12; ++i)
    mapper.add_keyframe(KeyframeId(i), link(i - 1, kLong, kSigma_m, kSigma_rad), {}, kDepth_m);
  (void)mapper.optimize();
  std::vector<Loop> found;
  for (int i = 7; i < 12; ++i) {
    const auto predicted = mapper.predicted(KeyframeId(i - 6), KeyframeId(i));
    found.push_back(loop(i, i - 6, rigid_part(predicted->S_a_b) * pose({0, 0, 0}, {1, 0, 0}),
                         kSigma_m, kSigma_rad));
  }
  LoopFeed loops;
  loops.add(found, mapper);
  EXPECT_EQ(loops.factor(), 1);
}

TEST(LoopFeed, KnowsTheSameAfterAnInterruption) {
  Rounds whole = rounds(100, 6, 6);
  whole.loops.finish(whole.mapper);
  for (const int at : {1, 10, 50, 99}) {
    Rounds interrupted = rounds(100, 6, 6, 0, at);
    EXPECT_EQ(interrupted.loops.factor(), whole.loops.factor()) << at;
    interrupted.loops.finish(interrupted.mapper);
    EXPECT_EQ(interrupted.variance_of_first_loop(), whole.variance_of_first_loop()) << at;
  }
}

TEST(LoopFeed, EarlierLoopsGetWhatWasLearnedLater) {
  Rounds run = rounds(100, 6, 6);
  const double before = run.variance_of_first_loop();
  run.loops.finish(run.mapper);
  EXPECT_NEAR(run.variance_of_first_loop() / before, run.loops.factor(), 1e-6 * run.loops.factor());
}

}  // namespace loop_feed_test
}  // namespace placegraph
