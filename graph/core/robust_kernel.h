#pragma once
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// rho(s) for a squared, whitened error s, in the scaling of Ceres: rho(s) ~ s for small s.
struct RobustKernel {
  enum class Kind { kNone, kHuber, kCauchy, kTukey, kGemanMcClure, kDcs, kTruncated };
  Kind kind = Kind::kNone;
  /// In standard deviations: Huber's k, Cauchy's c, Tukey's c, DCS's sqrt(Phi), and beyond which
  /// truncated least squares (rho = min(s, width^2)) gives an error no weight.
  double width = 1;

  /// {rho, rho', rho''} at s >= 0. Weight of an error in reweighted least squares = rho'.
  struct Value {
    double rho, first, second;
  };
  Value evaluate(double s) const;
};

/// Names in the order of RobustKernel::Kind: for OptionVisitor::choice.
const std::vector<std::string>& robust_kernel_names();

}  // namespace placegraph
