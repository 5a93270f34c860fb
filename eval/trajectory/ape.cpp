#include <placegraph/eval/trajectory/ape.h>

namespace placegraph {

ApeResult ape(const std::vector<FramePair>& aligned_pairs) {
  ApeResult result;
  for (const FramePair& pair : aligned_pairs) {
    if (!pair.T_world_estimate) continue;
    result.frames.push_back(pair.frame);
    result.frame_errors_m.push_back(
        (pair.T_world_estimate->translation() - pair.T_world_truth.translation()).norm());
  }
  if (result.frames.empty()) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no frame has an estimate");
    return result;
  }
  result.error_m = statistics_of(result.frame_errors_m);
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
