#include <placegraph/frontend/places/classifiers/kernel_machine.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <numeric>

namespace placegraph {
namespace {

double sum_of(const PerCue& weights) {
  return std::accumulate(weights.begin(), weights.end(), 0.0);
}

/// All combinations of {0, 1/2, 1} per available cue with at least one 1.
std::vector<PerCue> weights_to_try(const PlaceTrainingSet& training_set) {
  std::vector<PerCue> result;
  int codes = 1;
  for (int m = 0; m < kClassifierCues; ++m) codes *= 3;
  for (int code = 0; code < codes; ++code) {
    PerCue weights;
    int rest = code;
    bool known = true;
    for (std::size_t m = 0; m < weights.size(); ++m, rest /= 3) {
      weights[m] = 0.5 * (rest % 3);
      known = known && (weights[m] == 0 || training_set.distances[m].size() > 0);
    }
    if (known && *std::max_element(weights.begin(), weights.end()) == 1) result.push_back(weights);
  }
  return result;
}

class KernelMachine final : public PlaceMachine {
 public:
  KernelMachine(const PerCue& weights, Eigen::MatrixXd coefficients)
      : weights_(weights), coefficients_(std::move(coefficients)) {}
  Eigen::VectorXd outputs(
      const std::array<Eigen::VectorXd, kClassifierCues>& distances) const override {
    return coefficients_.transpose() * kernel_of(distances, weights_);
  }

 private:
  PerCue weights_;
  Eigen::MatrixXd coefficients_;  ///< views x labels
};

}  // namespace

Eigen::MatrixXd kernel_of(const PlaceTrainingSet& training_set, const PerCue& weights) {
  const auto count = static_cast<Eigen::Index>(training_set.labels.size());
  Eigen::MatrixXd exponent = Eigen::MatrixXd::Zero(count, count);
  for (std::size_t m = 0; m < weights.size(); ++m)
    if (weights[m] > 0) exponent += weights[m] / sum_of(weights) * training_set.distances[m];
  return (-exponent.array()).exp();
}

Eigen::VectorXd kernel_of(const std::array<Eigen::VectorXd, kClassifierCues>& distances,
                          const PerCue& weights) {
  Eigen::VectorXd exponent;
  for (std::size_t m = 0; m < weights.size(); ++m) {
    if (weights[m] == 0) continue;
    if (exponent.size() == 0) exponent.setZero(distances[m].size());
    exponent += weights[m] / sum_of(weights) * distances[m];
  }
  return (-exponent.array()).exp();
}

Eigen::MatrixXd targets_of(const PlaceTrainingSet& training_set) {
  Eigen::MatrixXd targets = Eigen::MatrixXd::Constant(
      static_cast<Eigen::Index>(training_set.labels.size()), training_set.places, -1);
  for (std::size_t i = 0; i < training_set.labels.size(); ++i)
    targets(static_cast<Eigen::Index>(i), training_set.labels[i]) = 1;
  return targets;
}

FoldSplit split_fold(const PlaceTrainingSet& training_set, int fold) {
  FoldSplit split;
  for (std::size_t i = 0; i < training_set.fold.size(); ++i)
    (training_set.fold[i] == fold ? split.out : split.in).push_back(static_cast<Eigen::Index>(i));
  return split;
}

Eigen::MatrixXd solve_kernel(Eigen::MatrixXd kernel, const Eigen::MatrixXd& targets, double ridge) {
  kernel.diagonal().array() += ridge;
  return kernel.ldlt().solve(targets);
}

Eigen::MatrixXd left_out_outputs(const PlaceTrainingSet& training_set,
                                 const Eigen::MatrixXd& kernel,
                                 const PlaceClassifierOptions& options) {
  const Eigen::MatrixXd targets = targets_of(training_set);
  Eigen::MatrixXd outputs = Eigen::MatrixXd::Zero(targets.rows(), targets.cols());
  for (int f = 0; f < options.folds; ++f) {
    const auto [in, out] = split_fold(training_set, f);
    if (in.empty() || out.empty()) continue;
    outputs(out, Eigen::all) =
        kernel(out, in) * solve_kernel(kernel(in, in), targets(in, Eigen::all), options.ridge);
  }
  return outputs;
}

PerCue best_kernel_weights(const PlaceTrainingSet& training_set,
                           const PlaceClassifierOptions& options) {
  const Eigen::MatrixXd targets = targets_of(training_set);
  double least = std::numeric_limits<double>::infinity();
  PerCue best{};
  for (const PerCue& weights : weights_to_try(training_set)) {
    const double error =
        (left_out_outputs(training_set, kernel_of(training_set, weights), options) - targets)
            .squaredNorm();
    if (error >= least) continue;
    least = error;
    best = weights;
  }
  return best;
}

TrainedPlaceMachine train_kernel_machine(const PlaceTrainingSet& training_set,
                                         const PlaceClassifierOptions& options) {
  TrainedPlaceMachine result;
  result.weights = best_kernel_weights(training_set, options);
  const Eigen::MatrixXd kernel = kernel_of(training_set, result.weights);
  result.left_out = left_out_outputs(training_set, kernel, options);
  result.machine = std::make_shared<KernelMachine>(
      result.weights, solve_kernel(kernel, targets_of(training_set), options.ridge));
  return result;
}

}  // namespace placegraph
