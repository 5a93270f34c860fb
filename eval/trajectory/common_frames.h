#pragma once
#include <placegraph/eval/trajectory/evaluate.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Several estimates of one ground truth judged where all of them have poses.
struct CommonResult {
  bool needed = false;  ///< false: all estimates are posed at the same times, or there is but one
  std::vector<EvaluationResult> results;  ///< one for each estimate, if needed
};

/// Judges estimates again on the frames that all of them have.
///
/// An estimate that loses track before the hard part has the smaller error of what is left: figures
/// of different frames do not compare. A posed frame is common if every other estimate is posed within
/// three quarters of its own spacing of it, so that rates may differ. All other frames count as
/// lost. `paired`: of the same ground truth, with names in the same order; those without a pairing
/// are left out of the comparison and keep their outcome.
[[nodiscard]] CommonResult on_common_frames(const std::vector<PairingResult>& paired,
                                            const std::vector<std::string>& names,
                                            const EvaluationOptions& options);

}  // namespace placegraph
