#pragma once
#include <ceres/loss_function.h>
#include <placegraph/graph/core/robust_kernel.h>

namespace placegraph {

/// Adapts a RobustKernel to Ceres; both scale rho in the same way.
class KernelLoss final : public ceres::LossFunction {
 public:
  explicit KernelLoss(const RobustKernel& kernel) : kernel_(kernel) {}
  void Evaluate(double s, double rho[3]) const override {
    const RobustKernel::Value value = kernel_.evaluate(s);
    rho[0] = value.rho;
    rho[1] = value.first;
    rho[2] = value.second;
  }

 private:
  RobustKernel kernel_;
};

}  // namespace placegraph
