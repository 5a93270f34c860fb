#include <gtest/gtest.h>
#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <set>

namespace placegraph {
namespace loop_benchmark_test {

constexpr int kTrials = 40, kImages = 60, kMinAge = 10;

/// Random truth and random answers with many equal scores, up to three candidates a query.
struct Scene {
  LoopTruth truth;
  std::vector<LoopPrediction> predictions;
};

int below(Random& random, int n) { return static_cast<int>(random.uniform(0, n - 1e-9)); }

Scene scene_of(Random& random) {
  Scene scene;
  scene.truth.min_age = kMinAge;
  for (int q = 0; q < kImages; ++q) {
    LoopQuery query;
    query.last = FrameId(q - kMinAge);
    for (int m = 0; m <= q - kMinAge; ++m)
      if (below(random, 12) == 0) query.matches.push_back(FrameId(m));
    scene.truth.queries.emplace(FrameId(q), query);
    std::set<int> candidates;
    for (int k = below(random, 4); k > 0; --k) candidates.insert(below(random, kImages));
    for (const int candidate : candidates)
      scene.predictions.push_back({FrameId(q), FrameId(candidate), 0.1 * below(random, 8), "", 0});
  }
  return scene;
}

template <class Body>
void for_random_scenes(const Body& body) {
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("seed 5, stream " + std::to_string(trial));
    Random random(5, static_cast<std::uint64_t>(trial));
    body(scene_of(random), random);
  }
}

void expect_same(const LoopBenchmark& a, const LoopBenchmark& b) {
  EXPECT_EQ(a.recall_at, b.recall_at);
  EXPECT_EQ(a.curve.average_precision, b.curve.average_precision);
  EXPECT_EQ(a.curve.recall_at_full_precision, b.curve.recall_at_full_precision);
  EXPECT_EQ(a.curve.f1_max, b.curve.f1_max);
}

TEST(LoopBenchmark, DoesNotDependOnTheOrderOfPredictionsEvenOfEqualScore) {
  for_random_scenes([](const Scene& scene, Random& random) {
    std::vector<LoopPrediction> shuffled = scene.predictions;
    for (std::size_t i = shuffled.size(); i > 1; --i)
      std::swap(shuffled[i - 1],
                shuffled[static_cast<std::size_t>(below(random, static_cast<int>(i)))]);
    expect_same(judge_loops(scene.truth, scene.predictions), judge_loops(scene.truth, shuffled));
  });
}

TEST(LoopBenchmark, DependsOnTheOrderOfScoresOnly) {
  for_random_scenes([](const Scene& scene, Random&) {
    std::vector<LoopPrediction> bent = scene.predictions;
    for (LoopPrediction& p : bent) p.score = 3 * p.score * p.score * p.score - 7;
    expect_same(judge_loops(scene.truth, scene.predictions), judge_loops(scene.truth, bent));
  });
}

TEST(LoopBenchmark, NeverGainsByAFalsePrediction) {
  for_random_scenes([](const Scene& scene, Random& random) {
    const LoopBenchmark before = judge_loops(scene.truth, scene.predictions);
    std::vector<LoopPrediction> more = scene.predictions;
    const auto& query = scene.truth.queries.at(FrameId(kMinAge + below(random, kImages - kMinAge)));
    const FrameId id(query.last.value() + kMinAge);
    for (FrameId candidate; candidate <= query.last; ++candidate)
      if (!std::binary_search(query.matches.begin(), query.matches.end(), candidate) &&
          std::none_of(more.begin(), more.end(), [&](const LoopPrediction& p) {
            return p.query == id && p.candidate == candidate;
          })) {
        more.push_back({id, candidate, 0.1 * below(random, 9), "", 0});
        break;
      }
    const LoopBenchmark after = judge_loops(scene.truth, more);
    EXPECT_LE(after.curve.average_precision.value(),
              before.curve.average_precision.value() + 1e-12);
    EXPECT_LE(after.recall_at[0].value(), before.recall_at[0].value());
    EXPECT_LE(after.curve.recall_at_full_precision.value(),
              before.curve.recall_at_full_precision.value());
  });
}

TEST(LoopBenchmark, IsNotTouchedByPredictionsThatAreTooYoung) {
  for_random_scenes([](const Scene& scene, Random&) {
    std::vector<LoopPrediction> old = scene.predictions;
    std::erase_if(old, [](const LoopPrediction& p) {
      return p.query.value() - p.candidate.value() < kMinAge;
    });
    expect_same(judge_loops(scene.truth, scene.predictions), judge_loops(scene.truth, old));
  });
}

}  // namespace loop_benchmark_test
}  // namespace placegraph
