#pragma once
#include <placegraph/eval/trajectory/frame_pair.h>
#include <placegraph/eval/trajectory/statistics.h>
#include <placegraph/graph/core/outcome.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Absolute trajectory error: distance between true and estimated position of every posed frame.
struct ApeResult {
  Outcome outcome;
  Statistics error_m;                  ///< meaningful only if outcome; the RMSE is the ATE
  std::vector<int> frames;             ///< the posed frames, as FramePair::frame
  std::vector<double> frame_errors_m;  ///< of each of them
};

/// Of pairs whose estimate is aligned already (Sturm et al. 2012, section V.B). Outcome:
/// kTooFewData if no frame is posed.
[[nodiscard]] ApeResult ape(const std::vector<FramePair>& aligned_pairs);

}  // namespace placegraph
