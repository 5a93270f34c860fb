#include <placegraph/frontend/places/classifiers/kernel_machine.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/ml.hpp>

namespace placegraph {
namespace {

/// Kernel that reads its values from a table: a sample is the index of a view.
class KernelTable final : public cv::ml::SVM::Kernel {
 public:
  explicit KernelTable(const Eigen::MatrixXd& kernel) : kernel_(&kernel) {}
  int getType() const override { return cv::ml::SVM::CUSTOM; }
  void calc(int count, int, const float* views, const float* other, float* results) override {
    const auto column = static_cast<Eigen::Index>(*other);
    for (int i = 0; i < count; ++i)
      results[i] = static_cast<float>((*kernel_)(static_cast<Eigen::Index>(views[i]), column));
  }

 private:
  const Eigen::MatrixXd* kernel_;
};

/// The decision function of one place against the others: coefficients of views, and a constant.
struct Decision {
  Eigen::VectorXd coefficients;
  double constant = 0;
};

Decision train_one(const Eigen::MatrixXd& kernel, const std::vector<Eigen::Index>& views,
                   const PlaceTrainingSet& training_set, int place, double cost) {
  cv::Mat samples(static_cast<int>(views.size()), 1, CV_32F), responses(samples.size(), CV_32S);
  bool some = false, others = false;
  for (int i = 0; i < samples.rows; ++i) {
    const Eigen::Index view = views[static_cast<std::size_t>(i)];
    const bool here = training_set.labels[static_cast<std::size_t>(view)] == place;
    samples.at<float>(i) = static_cast<float>(view);
    responses.at<int>(i) = here ? 1 : -1;
    (here ? some : others) = true;
  }
  Decision decision{Eigen::VectorXd::Zero(kernel.rows()), 0};
  if (!some || !others) {
    decision.constant = some ? 1 : -1;
    return decision;
  }
  const auto machine = cv::ml::SVM::create();
  machine->setType(cv::ml::SVM::C_SVC);
  machine->setCustomKernel(cv::makePtr<KernelTable>(kernel));
  machine->setC(cost);
  // Iterations at most, and the accuracy of the dual. Chosen.
  constexpr int kIterations = 100000;
  constexpr double kAccuracy = 1e-6;
  machine->setTermCriteria(
      {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kIterations, kAccuracy});
  machine->train(samples, cv::ml::ROW_SAMPLE, responses);
  cv::Mat alpha, index;
  const double rho = machine->getDecisionFunction(0, alpha, index);
  const cv::Mat vectors = machine->getSupportVectors();
  // OpenCV's sum is positive for the smaller label, -1.
  for (int i = 0; i < static_cast<int>(alpha.total()); ++i)
    decision.coefficients[static_cast<Eigen::Index>(vectors.at<float>(index.at<int>(i), 0))] -=
        alpha.at<double>(i);
  decision.constant = rho;
  return decision;
}

class SupportVectors final : public PlaceMachine {
 public:
  SupportVectors(const PlaceTrainingSet& training_set, const Eigen::MatrixXd& kernel,
                 const std::vector<Eigen::Index>& views, double cost, const PerCue& weights)
      : weights_(weights),
        coefficients_(kernel.rows(), training_set.places),
        constants_(training_set.places) {
    for (int place = 0; place < training_set.places; ++place) {
      const Decision decision = train_one(kernel, views, training_set, place, cost);
      coefficients_.col(place) = decision.coefficients;
      constants_[place] = decision.constant;
    }
  }
  Eigen::VectorXd outputs(
      const std::array<Eigen::VectorXd, kClassifierCues>& distances) const override {
    return outputs_of(kernel_of(distances, weights_));
  }
  Eigen::VectorXd outputs_of(const Eigen::VectorXd& kernel) const {
    return coefficients_.transpose() * kernel + constants_;
  }

 private:
  PerCue weights_;
  Eigen::MatrixXd coefficients_;  ///< views x places
  Eigen::VectorXd constants_;
};

Eigen::MatrixXd left_out(const PlaceTrainingSet& training_set, const Eigen::MatrixXd& kernel,
                         double cost, const PerCue& weights, int folds) {
  Eigen::MatrixXd outputs = Eigen::MatrixXd::Zero(kernel.rows(), training_set.places);
  for (int fold = 0; fold < folds; ++fold) {
    const auto [in, out] = split_fold(training_set, fold);
    if (in.empty() || out.empty()) continue;
    const SupportVectors machine(training_set, kernel, in, cost, weights);
    for (const Eigen::Index i : out) outputs.row(i) = machine.outputs_of(kernel.col(i));
  }
  return outputs;
}

/// Loss of views on the wrong side of the margin.
double hinge_loss(const Eigen::MatrixXd& outputs, const Eigen::MatrixXd& targets) {
  return (1 - outputs.array() * targets.array()).max(0).sum();
}

}  // namespace

TrainedPlaceMachine train_support_vectors(const PlaceTrainingSet& training_set,
                                          const PlaceClassifierOptions& options) {
  TrainedPlaceMachine result;
  result.weights = best_kernel_weights(training_set, options);
  const Eigen::MatrixXd kernel = kernel_of(training_set, result.weights);
  double least = std::numeric_limits<double>::infinity(), best = 1;
  for (const double cost : {0.5, 2.0, 8.0, 32.0, 128.0}) {
    Eigen::MatrixXd outputs = left_out(training_set, kernel, cost, result.weights, options.folds);
    const double loss = hinge_loss(outputs, targets_of(training_set));
    if (loss >= least) continue;
    least = loss;
    best = cost;
    result.left_out = std::move(outputs);
  }
  const FoldSplit all = split_fold(training_set, -1);
  result.machine =
      std::make_shared<SupportVectors>(training_set, kernel, all.in, best, result.weights);
  return result;
}

}  // namespace placegraph
