#pragma once
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// rho(s) for a squared, whitened error s, in the scaling of Ceres: rho(s) ~ s for small s.
struct RobustKernel {
  /// The function rho; kDcs is dynamic covariance scaling (Agarwal et al. 2013) as a kernel.
  enum class Kind { kNone, kHuber, kCauchy, kTukey, kGemanMcClure, kDcs, kTruncated };
  Kind kind = Kind::kNone;  ///< kNone: rho(s) = s, least squares
  /// Width in standard deviations: Huber's k, Cauchy's c, Tukey's c, sqrt(Phi) of DCS, and the
  /// error beyond which truncated least squares (rho = min(s, width^2)) has weight zero. Must be
  /// positive.
  double width = 1;

  /// The kernel and its derivatives by s.
  struct Value {
    /// rho, rho' (the weight of the error in reweighted least squares) and rho''.
    double rho, first, second;
  };
  /// rho, rho' and rho'' at s >= 0.
  Value evaluate(double s) const;
};

/// Names in the order of RobustKernel::Kind, for OptionVisitor::choice.
const std::vector<std::string>& robust_kernel_names();

}  // namespace placegraph
