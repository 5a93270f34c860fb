#pragma once
#include <string>
#include <utility>

namespace [[gnu::visibility("default")]] placegraph {

/// Whether an estimator's result may be used. It is the first member of every result struct whose
/// computation the data may not allow; the evidence beside it (inliers, condition, residual) is
/// always filled. Test it before using the estimate: `if (!result.outcome) ...`.
struct [[nodiscard]] Outcome {
  enum class Code {
    kOk,
    kTooFewData,    ///< fewer measurements than the method needs
    kNoConsensus,   ///< RANSAC found no model with enough support
    kDegenerate,    ///< the measurements leave the wanted quantity unobservable
    kNotConverged,  ///< the iteration stopped without reaching a minimum
    kInconsistent,  ///< an estimate exists but contradicts a prior or a gate
    kNotAttempted,  ///< the default: nothing was computed yet
  };

  Code code = Code::kNotAttempted;
  std::string reason;  ///< one line for people; empty when ok

  explicit operator bool() const { return code == Code::kOk; }

  static Outcome ok() { return {Code::kOk, {}}; }
  static Outcome failure(Code code, std::string reason) { return {code, std::move(reason)}; }
};

/// "ok", "too few data", ...
const char* to_string(Outcome::Code code);

}  // namespace placegraph
