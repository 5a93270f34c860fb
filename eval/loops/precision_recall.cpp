#include <placegraph/eval/loops/precision_recall.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

void check(const std::vector<ScoredPrediction>& predictions, int positives) {
  int correct = 0;
  for (const ScoredPrediction& prediction : predictions) {
    require(std::isfinite(prediction.score), "precision_recall: a score is not finite");
    correct += prediction.correct;
  }
  require(correct <= positives, "precision_recall: " + std::to_string(correct) +
                                    " correct predictions, but only " + std::to_string(positives) +
                                    " positives");
}

/// The figures over the recall of the right predictions alone.
void add_figures_of_answers(PrecisionRecall& result) {
  if (result.curve.empty() || result.curve.back().hits == 0) return;
  const double hits = result.curve.back().hits;
  double steps = 0, trapezoids = 0, recall = 0, precision = 1;
  for (const PrecisionRecallPoint& point : result.curve) {
    const double gained = point.hits / hits - recall;
    steps += point.precision * gained;
    trapezoids += (point.precision + precision) / 2 * gained;
    recall = point.hits / hits;
    precision = point.precision;
  }
  result.average_precision_of_answers = steps;
  result.area_of_answers = trapezoids;
}

}  // namespace

PrecisionRecall precision_recall(std::vector<ScoredPrediction> predictions, int positives) {
  check(predictions, positives);
  std::sort(predictions.begin(), predictions.end(),
            [](const ScoredPrediction& a, const ScoredPrediction& b) { return a.score > b.score; });
  PrecisionRecall result;
  PrecisionRecallPoint point;
  double area = 0, full = 0, f1 = 0, recall_before = 0;
  for (auto first = predictions.begin(); first != predictions.end();) {
    auto last = first;
    for (; last != predictions.end() && last->score == first->score; ++last)
      ++(last->correct ? point.hits : point.misses);
    point.threshold = first->score;
    point.precision = static_cast<double>(point.hits) / (point.hits + point.misses);
    if (positives > 0) point.recall = static_cast<double>(point.hits) / positives;
    result.curve.push_back(point);
    area += point.precision * (point.recall - recall_before);
    recall_before = point.recall;
    if (point.misses == 0) full = point.recall;
    if (point.hits > 0)
      f1 = std::max(f1, 2 * point.precision * point.recall / (point.precision + point.recall));
    first = last;
  }
  if (positives == 0) return result;
  result.average_precision = area;
  result.recall_at_full_precision = full;
  result.f1_max = f1;
  add_figures_of_answers(result);
  return result;
}

}  // namespace placegraph
