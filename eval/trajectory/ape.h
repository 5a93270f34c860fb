#pragma once
#include <placegraph/eval/trajectory/frame_pair.h>
#include <placegraph/eval/trajectory/statistics.h>
#include <placegraph/graph/core/outcome.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Absolute trajectory error: distances of true and estimated positions of the posed frames.
struct ApeResult {
  Outcome outcome;                     ///< kTooFewData if no frame is posed
  Statistics error_m;                  ///< meaningful only if outcome; the RMSE is the ATE
  std::vector<int> frames;             ///< the posed frames, as FramePair::frame
  std::vector<double> frame_errors_m;  ///< error of each of them [m]
};

/// Computes the absolute trajectory error of pairs whose estimate is aligned already.
///
/// Sturm et al. 2012, section V.B. Lost frames are left out.
[[nodiscard]] ApeResult ape(const std::vector<FramePair>& aligned_pairs);

}  // namespace placegraph
