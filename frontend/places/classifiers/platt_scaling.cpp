#include <placegraph/frontend/places/classifiers/platt_scaling.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/LU>
#include <cmath>

namespace placegraph {
namespace {

/// log(1 + exp(x)) without overflow.
double soft_plus(double x) {
  return x > 0 ? x + std::log1p(std::exp(-x)) : std::log1p(std::exp(x));
}

double cost_of(const Eigen::VectorXd& outputs, const Eigen::VectorXd& targets,
               const Eigen::Vector2d& parameters) {
  double cost = 0;
  for (Eigen::Index i = 0; i < outputs.size(); ++i) {
    const double x = parameters[0] * outputs[i] + parameters[1];
    cost += soft_plus(x) - (1 - targets[i]) * x;
  }
  return cost;
}

}  // namespace

double PlattScaling::probability(double output) const {
  const double x = slope * output + offset;
  return x > 0 ? std::exp(-x) / (1 + std::exp(-x)) : 1 / (1 + std::exp(x));
}

PlattScaling fit_platt_scaling(const Eigen::VectorXd& outputs,
                               const Eigen::Array<bool, Eigen::Dynamic, 1>& positive) {
  require(outputs.size() > 0 && outputs.size() == positive.size(),
          "fit_platt_scaling: one output per view needed");
  const auto ones = static_cast<double>(positive.count());
  const double zeros = static_cast<double>(positive.size()) - ones;
  const Eigen::VectorXd targets =
      positive.select(Eigen::ArrayXd::Constant(positive.size(), (ones + 1) / (ones + 2)),
                      Eigen::ArrayXd::Constant(positive.size(), 1 / (zeros + 2)));
  Eigen::Vector2d parameters(0, std::log((zeros + 1) / (ones + 1)));
  double cost = cost_of(outputs, targets, parameters);
  // Those of the algorithm (Lin, Lin & Weng 2007): 100 rounds, ridge 1e-12, gradient 1e-5, step
  // 1e-10, descent 1e-4.
  constexpr int kRounds = 100;
  constexpr double kRidge = 1e-12, kEnough = 1e-5, kShortest = 1e-10, kDescent = 1e-4;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix2d hessian = kRidge * Eigen::Matrix2d::Identity();
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    for (Eigen::Index i = 0; i < outputs.size(); ++i) {
      const double p = PlattScaling{parameters[0], parameters[1]}.probability(outputs[i]);
      const Eigen::Vector2d row(outputs[i], 1);
      hessian += p * (1 - p) * row * row.transpose();
      gradient += (targets[i] - p) * row;
    }
    if (gradient.cwiseAbs().maxCoeff() < kEnough) break;
    const Eigen::Vector2d step = -hessian.inverse() * gradient;
    double length = 1;
    for (; length > kShortest; length /= 2) {
      const Eigen::Vector2d next = parameters + length * step;
      const double less = cost_of(outputs, targets, next);
      if (less < cost + kDescent * length * gradient.dot(step)) {
        parameters = next;
        cost = less;
        break;
      }
    }
    if (length <= kShortest) break;
  }
  return {parameters[0], parameters[1]};
}

}  // namespace placegraph
