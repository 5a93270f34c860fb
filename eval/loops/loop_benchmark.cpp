#include <fmt/format.h>
#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/loops/loop_protocol.h>
#include <placegraph/eval/loops/score_order.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace placegraph {
namespace {

enum class RangeTest { kInside, kTooYoung, kOutOfRange };

RangeTest range_test_of(std::int64_t min_age, FrameId id, const LoopQuery& query,
                        FrameId candidate) {
  if (min_age > 0 && id.value() - candidate.value() < min_age) return RangeTest::kTooYoung;
  const bool inside = candidate >= query.first && candidate <= query.last;
  return inside ? RangeTest::kInside : RangeTest::kOutOfRange;
}

/// The ground truth of an image, without matches that are no candidates.
LoopQuery query_of(const LoopTruth& truth, FrameId id) {
  const auto listed = truth.queries.find(id);
  if (listed == truth.queries.end()) return {};
  LoopQuery query = listed->second;
  std::erase_if(query.matches, [&](FrameId match) {
    return range_test_of(truth.min_age, id, query, match) != RangeTest::kInside;
  });
  return query;
}

bool is_true(const LoopQuery& query, FrameId candidate, int tolerance) {
  const auto next = std::lower_bound(query.matches.begin(), query.matches.end(),
                                     FrameId(candidate.value() - tolerance));
  return next != query.matches.end() && next->value() <= candidate.value() + tolerance;
}

struct Candidate {
  LoopPrediction prediction;
  bool correct = false;
};

// Best first, false ones before true ones of the same score, independent of their order.
bool stands_before(const Candidate& a, const Candidate& b) {
  if (a.prediction.score != b.prediction.score) return a.prediction.score > b.prediction.score;
  if (a.correct != b.correct) return b.correct;
  return a.prediction.candidate < b.prediction.candidate;
}

struct Gathered {
  LoopQuery query;
  std::vector<Candidate> candidates;
  bool too_young = false, out_of_range = false;
};

/// Throws ArgumentError, which names query and candidate, if a query has a candidate twice.
void require_distinct(const std::vector<LoopPrediction>& predictions) {
  std::set<std::pair<FrameId, FrameId>> seen;
  for (const LoopPrediction& prediction : predictions)
    if (!seen.emplace(prediction.query, prediction.candidate).second)
      throw ArgumentError("judge_loops: query " + to_string(prediction.query) + " has candidate " +
                          to_string(prediction.candidate) + " twice");
}

JudgedQuery judge(FrameId id, Gathered& gathered) {
  JudgedQuery judged;
  judged.query = id;
  judged.has_match = !gathered.query.matches.empty();
  std::vector<Candidate>& candidates = gathered.candidates;
  if (candidates.empty()) {
    if (gathered.too_young) judged.verdict = LoopVerdict::kTooYoung;
    if (gathered.out_of_range) judged.verdict = LoopVerdict::kOutOfRange;
    return judged;
  }
  std::sort(candidates.begin(), candidates.end(), stands_before);
  judged.best = candidates.front().prediction;
  judged.verdict = candidates.front().correct ? LoopVerdict::kHit : LoopVerdict::kMiss;
  const auto first = std::find_if(candidates.begin(), candidates.end(),
                                  [](const Candidate& candidate) { return candidate.correct; });
  if (first != candidates.end()) judged.rank = static_cast<int>(first - candidates.begin()) + 1;
  return judged;
}

}  // namespace

std::string to_string(LoopVerdict verdict) {
  switch (verdict) {
    case LoopVerdict::kHit:
      return "hit";
    case LoopVerdict::kMiss:
      return "miss";
    case LoopVerdict::kSilent:
      return "silent";
    case LoopVerdict::kTooYoung:
      return "too_young";
    case LoopVerdict::kOutOfRange:
      return "out_of_range";
  }
  return {};
}

namespace {

/// The truth with the protocol of these predictions.
LoopTruth decided(const LoopTruth& truth, const std::vector<LoopPrediction>& predictions) {
  LoopTruth result = truth;
  result.protocol = protocol_of(truth, predictions);
  if (result.protocol == LoopProtocol::kQueryDatabase) result.min_age = 0;
  // A query's own past; ranges may name other candidates.
  if (result.protocol == LoopProtocol::kWithinDrive && truth.protocol == LoopProtocol::kUndecided)
    result.min_age = std::max<std::int64_t>(result.min_age, 1);
  return result;
}

/// The candidates of every query, judged one by one.
std::map<FrameId, Gathered> gather(const LoopTruth& truth,
                                   const std::vector<LoopPrediction>& predictions, int tolerance,
                                   LoopBenchmark& result) {
  std::map<FrameId, Gathered> gathered;
  for (const auto& [id, query] : truth.queries) gathered[id].query = query_of(truth, id);
  for (const LoopPrediction& prediction : predictions) {
    if (!truth.unlisted_have_none && !truth.queries.contains(prediction.query)) {
      ++result.unjudged;
      continue;
    }
    Gathered& of_query = gathered[prediction.query];
    const RangeTest place =
        range_test_of(truth.min_age, prediction.query, of_query.query, prediction.candidate);
    of_query.too_young |= place == RangeTest::kTooYoung;
    of_query.out_of_range |= place == RangeTest::kOutOfRange;
    if (place == RangeTest::kInside)
      of_query.candidates.push_back(
          {prediction, is_true(of_query.query, prediction.candidate, tolerance)});
    else
      ++result.dropped;
  }
  return gathered;
}

void count(std::map<FrameId, Gathered>& gathered, LoopBenchmark& result) {
  std::vector<ScoredPrediction> scored;
  std::array<int, LoopBenchmark::kRanks.size()> found = {};
  for (auto& [id, of_query] : gathered) {
    const JudgedQuery judged = judge(id, of_query);
    result.positives += judged.has_match;
    for (const Candidate& candidate : of_query.candidates)
      result.candidates.push_back({candidate.prediction.score, candidate.correct});
    if (!of_query.candidates.empty())
      scored.push_back({judged.best.score, judged.verdict == LoopVerdict::kHit});
    for (std::size_t i = 0; i < found.size(); ++i)
      found[i] += judged.rank > 0 && judged.rank <= LoopBenchmark::kRanks[i];
    result.queries.push_back(judged);
  }
  result.predicted_queries = static_cast<int>(scored.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (result.positives > 0)
      result.recall_at[i] = static_cast<double>(found[i]) / result.positives;
    if (!result.queries.empty())
      result.recall_at_of_all[i] =
          static_cast<double>(found[i]) / static_cast<double>(result.queries.size());
  }
  result.curve = precision_recall(std::move(scored), result.positives);
}

/// Scores as the recognizer gave them.
void give_distances_back(LoopBenchmark& result) {
  for (PrecisionRecallPoint& point : result.curve.curve) point.threshold = -point.threshold;
  for (JudgedQuery& query : result.queries)
    if (query.verdict == LoopVerdict::kHit || query.verdict == LoopVerdict::kMiss)
      query.best.score = -query.best.score;
}

}  // namespace

LoopBenchmark judge_loops(const LoopTruth& truth, const std::vector<LoopPrediction>& predictions,
                          const LoopJudgeOptions& options) {
  require(options.tolerance >= 0, "judge_loops: tolerance is negative");
  require_distinct(predictions);
  const bool distances = options.scores == ScoreKind::kDistance;
  LoopBenchmark result;
  const LoopTruth judged = decided(truth, predictions);
  result.protocol = judged.protocol;
  result.scores = options.scores;
  std::vector<LoopPrediction> similar = predictions;
  if (distances)
    for (LoopPrediction& prediction : similar) prediction.score = -prediction.score;
  std::map<FrameId, Gathered> gathered = gather(judged, similar, options.tolerance, result);
  count(gathered, result);
  result.outcome = result.positives > 0
                       ? Outcome::ok()
                       : Outcome::failure(Outcome::Code::kTooFewData,
                                          "no query has a true match; recall is not defined");
  if (result.unjudged > 0)
    result.doubts.push_back(
        {DoubtKind::kNotJudged,
         fmt::format("{} predictions for images without ground truth are not judged",
                     result.unjudged)});
  const std::string order = reversed_scores(similar, result.candidates);
  if (!order.empty())
    result.doubts.push_back(
        {DoubtKind::kScoreOrder,
         fmt::format("{}: they seem to be {}, and are judged as {} (--scores {})", order,
                     distances ? "similarities" : "distances",
                     distances ? "distances" : "similarities",
                     distances ? "similarity" : "distance")});
  if (distances) give_distances_back(result);
  return result;
}

LoopBenchmark judge_loops(const LoopTruth& truth, const std::vector<LoopPrediction>& predictions,
                          int tolerance) {
  LoopJudgeOptions options;
  options.tolerance = tolerance;
  return judge_loops(truth, predictions, options);
}

}  // namespace placegraph
