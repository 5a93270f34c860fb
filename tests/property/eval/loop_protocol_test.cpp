#include <gtest/gtest.h>
#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/loops/loop_protocol.h>
#include <placegraph/eval/loops/loop_truth_from_poses.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/loops/loop_file.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace loop_protocol_test {

constexpr int kTrials = 30;

int below(Random& random, int n) { return static_cast<int>(random.uniform(0, n - 1e-9)); }

/// Two drives along one road: image q of the one shows images near `shift + pace * q` of the other.
struct TwoDrives {
  std::size_t queries = 0, images = 0;
  std::vector<bool> matches;
  std::vector<LoopPrediction> perfect;
};

TwoDrives two_drives(Random& random) {
  TwoDrives drives;
  drives.queries = static_cast<std::size_t>(5 + below(random, 60));
  drives.images = static_cast<std::size_t>(5 + below(random, 60));
  drives.matches.assign(drives.queries * drives.images, false);
  const double pace = static_cast<double>(drives.images) / static_cast<double>(drives.queries);
  const int reach = 1 + below(random, 3);
  for (std::size_t q = 0; q < drives.queries; ++q) {
    const auto at = static_cast<int>(pace * static_cast<double>(q));
    for (int m = std::max(0, at - reach);
         m <= std::min(static_cast<int>(drives.images) - 1, at + reach); ++m) {
      drives.matches[q * drives.images + static_cast<std::size_t>(m)] = true;
      drives.perfect.push_back({FrameId(static_cast<std::int64_t>(q)), FrameId(m),
                                1 - 0.01 * std::abs(m - at) + 0.001 * random.uniform(), "", 0});
    }
  }
  return drives;
}

template <class Body>
void for_random(const Body& body) {
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("seed 7, stream " + std::to_string(trial));
    Random random(7, static_cast<std::uint64_t>(trial));
    body(random);
  }
}

TEST(LoopProtocol, APerfectRecognizerOfTwoDrivesIsPerfectOrRefused) {
  for_random([](Random& random) {
    const TwoDrives drives = two_drives(random);
    const LoopTruth truth = loop_truth_of_matrix(drives.matches, drives.images);
    LoopTruth chosen = truth;
    choose_protocol(chosen, {std::nullopt, 0}, 300);
    const LoopBenchmark told = judge_loops(chosen, drives.perfect);
    EXPECT_EQ(told.protocol, LoopProtocol::kQueryDatabase);
    EXPECT_EQ(told.recall_at[0], 1.0);
    EXPECT_DOUBLE_EQ(told.curve.average_precision.value(), 1);
    try {
      const LoopBenchmark found = judge_loops(truth, drives.perfect);
      EXPECT_EQ(found.recall_at[0], 1.0);
      EXPECT_DOUBLE_EQ(found.curve.average_precision.value(), 1);
    } catch (const ArgumentError&) {
      EXPECT_EQ(drives.queries, drives.images) << "a matrix that is not square is of two sets";
    }
  });
}

TEST(LoopProtocol, OneDriveIsJudgedTheSameByAMatrixByListsAndByItsLowerTriangle) {
  for_random([](Random& random) {
    const auto n = static_cast<std::size_t>(20 + below(random, 40));
    const int age = 1 + below(random, 8);
    std::vector<bool> matches(n * n, false), lower(n * n, false);
    LoopTruth lists;
    lists.unlisted_have_none = true;
    for (std::size_t q = 0; q < n; ++q) {
      matches[q * n + q] = true;
      LoopQuery& query = lists.queries[FrameId(static_cast<std::int64_t>(q))];
      for (std::size_t m = 0; m < q; ++m)
        if (below(random, 6) == 0) {
          matches[q * n + m] = matches[m * n + q] = lower[q * n + m] = true;
          query.matches.push_back(FrameId(static_cast<std::int64_t>(m)));
        }
    }
    std::vector<LoopPrediction> predictions;
    for (std::size_t q = 1; q < n; ++q)
      predictions.push_back({FrameId(static_cast<std::int64_t>(q)),
                             FrameId(below(random, static_cast<int>(q))), random.uniform(), "", 0});
    std::vector<LoopBenchmark> results;
    for (LoopTruth truth : {loop_truth_of_matrix(matches, n), loop_truth_of_matrix(lower, n), lists}) {
      choose_protocol(truth, {std::nullopt, age}, 300);
      results.push_back(judge_loops(truth, predictions));
    }
    for (const LoopBenchmark& result : results) {
      EXPECT_EQ(result.protocol, LoopProtocol::kWithinDrive);
      EXPECT_EQ(result.recall_at, results.front().recall_at);
      EXPECT_EQ(result.positives, results.front().positives);
      EXPECT_EQ(result.curve.average_precision, results.front().curve.average_precision);
    }
  });
}

/// Images along a winding road, with headings or without.
Trajectory road(Random& random, std::size_t n, bool headings) {
  Trajectory poses;
  poses.has_times = false;
  poses.has_orientation = headings;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  double heading = 0;
  for (std::size_t i = 0; i < n; ++i) {
    heading += random.uniform(-0.6, 0.6);
    at += Eigen::Vector3d(std::cos(heading), std::sin(heading), 0);
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() = at;
    if (headings) T.linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).matrix();
    poses.poses.push_back({static_cast<std::int64_t>(i), T});
    if (below(random, 15) == 0) poses.poses.back().T_world_body.reset();
  }
  return poses;
}

TEST(LoopProtocol, TruthOfPositionsIsThatOfAllPairs) {
  for_random([](Random& random) {
    const bool headings = below(random, 2) == 0;
    const Trajectory queries = road(random, 40, headings), database = road(random, 70, headings);
    SameView same;
    same.radius_m = random.uniform(0.5, 8);
    same.heading_deg = random.uniform(5, 180);
    const LoopTruth truth = loop_truth_between(queries, database, same);
    SameView criteria = same;
    if (!headings) criteria.heading_deg = 180;
    for (std::size_t q = 0; q < queries.size(); ++q) {
      const auto& pose = queries.poses[q].T_world_body;
      const FrameId id(static_cast<std::int64_t>(q));
      ASSERT_EQ(truth.queries.contains(id), pose.has_value());
      if (!pose) continue;
      std::vector<FrameId> expected;
      for (std::size_t m = 0; m < database.size(); ++m)
        if (const auto& other = database.poses[m].T_world_body; other && criteria.holds(*other, *pose))
          expected.push_back(FrameId(static_cast<std::int64_t>(m)));
      EXPECT_EQ(truth.queries.at(id).matches, expected);
    }
  });
}

TEST(LoopProtocol, DistancesHaveTheFiguresOfTheirNegatives) {
  for_random([](Random& random) {
    const TwoDrives drives = two_drives(random);
    LoopTruth truth = loop_truth_of_matrix(drives.matches, drives.images);
    choose_protocol(truth, {false, std::nullopt}, 300);
    std::vector<LoopPrediction> similar = drives.perfect;
    for (LoopPrediction& p : similar) p.score = random.uniform();
    std::vector<LoopPrediction> distances = similar;
    for (LoopPrediction& p : distances) p.score = -p.score;
    LoopJudgeOptions as_distances;
    as_distances.scores = ScoreKind::kDistance;
    const LoopBenchmark a = judge_loops(truth, similar);
    const LoopBenchmark b = judge_loops(truth, distances, as_distances);
    EXPECT_EQ(a.recall_at, b.recall_at);
    EXPECT_EQ(a.curve.average_precision, b.curve.average_precision);
    ASSERT_EQ(a.curve.curve.size(), b.curve.curve.size());
    for (std::size_t i = 0; i < a.curve.curve.size(); ++i)
      EXPECT_EQ(a.curve.curve[i].threshold, -b.curve.curve[i].threshold);
  });
}

/// Whether judging says that the scores seem to be reversed.
bool says_reversed(const LoopTruth& truth, const std::vector<LoopPrediction>& predictions) {
  const LoopBenchmark result = judge_loops(truth, predictions);
  return std::any_of(result.doubts.begin(), result.doubts.end(),
                     [](const Doubt& doubt) { return doubt.kind == DoubtKind::kScoreOrder; });
}

/// Queries of a database of 200 images, with candidates whose scores are larger for right ones.
struct Recognizer {
  LoopTruth truth;
  std::vector<LoopPrediction> predictions;  ///< the best first
};

Recognizer recognizer(Random& random, int candidates, double separation) {
  Recognizer made;
  made.truth.protocol = LoopProtocol::kQueryDatabase;
  made.truth.unlisted_have_none = true;
  for (int q = 0; q < 120; ++q) {
    const int right = 20 + below(random, 100);
    made.truth.queries[FrameId(q)].matches = {FrameId(right)};
    std::vector<LoopPrediction> list;
    for (int k = 0; k < candidates; ++k) {
      const bool hit = k == 0 && below(random, 3) > 0;
      list.push_back({FrameId(q), FrameId(hit ? right : 150 + k),
                      random.normal() + (hit ? separation : 0), "", 0});
    }
    std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
    made.predictions.insert(made.predictions.end(), list.begin(), list.end());
  }
  return made;
}

TEST(LoopProtocol, DistancesAreToldAndSimilaritiesAreNot) {
  for_random([](Random& random) {
    const int candidates = 1 + below(random, 6);
    const Recognizer good = recognizer(random, candidates, 3);
    EXPECT_FALSE(says_reversed(good.truth, good.predictions)) << candidates;
    for (const auto& [name, distance] :
         {std::pair<const char*, double (*)(double)>{"negative", [](double s) { return -s; }},
          {"exponential", [](double s) { return std::exp(-s); }}}) {
      std::vector<LoopPrediction> reversed = good.predictions;
      for (LoopPrediction& p : reversed) p.score = distance(p.score);
      EXPECT_TRUE(says_reversed(good.truth, reversed)) << name << " of " << candidates;
      for (LoopPrediction& p : reversed) p.score = -p.score;
      EXPECT_FALSE(says_reversed(good.truth, reversed)) << name << " of " << candidates;
    }
    const Recognizer useless = recognizer(random, candidates, 0);
    EXPECT_FALSE(says_reversed(useless.truth, useless.predictions)) << candidates;
  });
}

}  // namespace loop_protocol_test
}  // namespace placegraph
