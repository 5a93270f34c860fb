#pragma once
#include <placegraph/eval/loops/precision_recall.h>
#include <placegraph/graph/recognition/loop_prediction.h>

#include <string>
#include <vector>

namespace placegraph {

/// Why the smaller of some scores seem to be the more certain ones; empty if they do not.
///
/// Either the candidates of nearly every query are given with ascending scores, as searches give
/// distances, and right ones do not have the larger scores; or right candidates have clearly smaller
/// scores than wrong ones (Mann & Whitney 1947). `predictions` in the order in which the recognizer
/// gave them; `judged`: the same, or some of them, with their truth.
std::string reversed_scores(const std::vector<LoopPrediction>& predictions,
                            const std::vector<ScoredPrediction>& judged);

}  // namespace placegraph
