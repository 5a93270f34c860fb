#pragma once
#include <placegraph/eval/loops/precision_recall.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/recognition/loop_prediction.h>
#include <placegraph/graph/recognition/loop_truth.h>

#include <array>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The verdict on a place recognizer's prediction to one image.
enum class LoopVerdict {
  kHit,         ///< its best candidate shows the same place
  kMiss,        ///< its best candidate does not show the same place
  kSilent,      ///< nothing was proposed
  kTooYoung,    ///< all candidates are younger than the truth's min_age, or no older images
  kOutOfRange,  ///< all candidates are outside the range of the query
};
/// Name of a verdict: "hit", "miss", "silent", "too_young" or "out_of_range".
std::string to_string(LoopVerdict verdict);

/// A query of a place recognizer, judged.
struct JudgedQuery {
  FrameId query;                               ///< the query image
  LoopVerdict verdict = LoopVerdict::kSilent;  ///< verdict on its best candidate
  bool has_match = false;                      ///< whether it has a true match among its candidates
  LoopPrediction best;  ///< candidate of the highest score; only for a hit or a miss
  int rank = 0;         ///< rank of the first true candidate, from 1; 0 if none is true
};

/// Figures of a place recognizer over a set of images.
struct LoopBenchmark {
  Outcome outcome;            ///< too few data: no query has a true match
  int positives = 0;          ///< queries that have a true match
  int predicted_queries = 0;  ///< queries with a valid candidate
  int dropped = 0;   ///< predictions that are neither hit nor miss: too young or out of range
  int unjudged = 0;  ///< predictions for images without ground truth
  static constexpr std::array<int, 4> kRanks = {1, 5, 10, 20};  ///< the ranks of `recall_at`
  /// Share of the positives with a true candidate among the kRanks best; nothing without positives.
  std::array<std::optional<double>, 4> recall_at;
  /// The same share of all `queries`, of which those without a match find none; nothing without
  /// queries. Benchmarks of visual geo-localization and VPR-Bench count so.
  std::array<std::optional<double>, 4> recall_at_of_all;
  LoopProtocol protocol = LoopProtocol::kWithinDrive;  ///< the one of the judgement, never undecided
  ScoreKind scores = ScoreKind::kSimilarity;           ///< as chosen; of `curve` and `queries`
  PrecisionRecall curve;  ///< over the best candidate of every query
  /// All valid candidates, not only the best; in the order of the queries. Distances are negated.
  std::vector<ScoredPrediction> candidates;
  std::vector<JudgedQuery> queries;  ///< ascending; all that the truth lists, and all answered ones
  /// What speaks against the figures: predictions that are not judged, scores that seem to be
  /// distances.
  std::vector<Doubt> doubts;
};

/// How predictions are judged.
struct LoopJudgeOptions {
  int tolerance = 0;  ///< largest distance of a hit from a true match [images]
  ScoreKind scores = ScoreKind::kSimilarity;  ///< what the scores are
};

/// Judges the loop closures that a place recognizer proposed for a set of images.
///
/// A query's prediction is its best candidate; it is a hit if it is within `tolerance` images of a
/// true match. Candidates that the truth excludes (no older images of the same drive, younger than
/// its min_age, outside a query's range) are left out, right or wrong. Candidates of equal score are
/// a set, in which the false ones come first, so that the order of the predictions has no influence.
/// Precision = hits / (hits + misses) and recall = hits / positives over the threshold on the score.
/// Throws ArgumentError for a negative tolerance, a score that is not finite, a candidate that a
/// query has twice (the ranks count images), or a truth whose protocol is doubtful (protocol_of).
LoopBenchmark judge_loops(const LoopTruth& truth, const std::vector<LoopPrediction>& predictions,
                          const LoopJudgeOptions& options);
/// The same of similarities.
/// Throws as judge_loops with options.
LoopBenchmark judge_loops(const LoopTruth& truth, const std::vector<LoopPrediction>& predictions,
                          int tolerance = 0);

}  // namespace placegraph
