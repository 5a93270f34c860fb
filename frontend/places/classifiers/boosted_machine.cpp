#include <placegraph/frontend/places/classifiers/kernel_machine.h>

#include <algorithm>
#include <cmath>
#include <opencv2/ml.hpp>

namespace placegraph {
namespace {

/// Outputs of one least-squares machine per cue for each place: cues x places columns.
class CueOpinions {
 public:
  CueOpinions(const PlaceTrainingSet& training_set, const PlaceClassifierOptions& options)
      : places_(training_set.places) {
    const Eigen::MatrixXd targets = targets_of(training_set);
    for (std::size_t m = 0; m < training_set.distances.size(); ++m) {
      if (training_set.distances[m].size() == 0) continue;
      PerCue alone{};
      alone[m] = 1;
      const Eigen::MatrixXd kernel = kernel_of(training_set, alone);
      cues_.push_back({m, alone, solve_kernel(kernel, targets, options.ridge)});
      const Eigen::MatrixXd message = left_out_outputs(training_set, kernel, options);
      const Eigen::Index column = left_out_.cols();
      left_out_.conservativeResize(targets.rows(), column + places_);
      left_out_.rightCols(places_) = message;
    }
  }
  /// Outputs for the views by machines trained without their fold.
  const Eigen::MatrixXd& left_out() const { return left_out_; }
  Eigen::VectorXd of(const std::array<Eigen::VectorXd, kClassifierCues>& distances) const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(left_out_.cols());
    Eigen::Index first = 0;
    for (const Cue& cue : cues_) {
      // No stump uses a cue without distances.
      if (distances[cue.cue].size() > 0)
        result.segment(first, places_) =
            cue.coefficients.transpose() * kernel_of(distances, cue.alone);
      first += places_;
    }
    return result;
  }
  std::size_t cue_of(int column) const {
    return cues_[static_cast<std::size_t>(column / places_)].cue;
  }

 private:
  struct Cue {
    std::size_t cue;
    PerCue alone;
    Eigen::MatrixXd coefficients;  ///< views x places
  };
  int places_;
  std::vector<Cue> cues_;
  Eigen::MatrixXd left_out_;
};

/// Stump: a vote of either sign by a threshold on one output.
struct Stump {
  int column = 0;
  double threshold = 0, below = 0, above = 0;
};

using Ensemble = std::vector<Stump>;

/// AdaBoost (Freund & Schapire 1997): votes alpha_t = log((1 - e_t) / e_t) / 2.
Ensemble boost(const Eigen::MatrixXd& opinions, const std::vector<Eigen::Index>& views,
               const PlaceTrainingSet& training_set, int place, int rounds) {
  cv::Mat samples(static_cast<int>(views.size()), static_cast<int>(opinions.cols()), CV_32F);
  cv::Mat responses(samples.rows, 1, CV_32S);
  int positives = 0;
  for (int i = 0; i < samples.rows; ++i) {
    const Eigen::Index view = views[static_cast<std::size_t>(i)];
    for (int k = 0; k < samples.cols; ++k)
      samples.at<float>(i, k) = static_cast<float>(opinions(view, k));
    const bool here = training_set.labels[static_cast<std::size_t>(view)] == place;
    responses.at<int>(i) = here;
    positives += here;
  }
  if (positives == 0 || positives == samples.rows) {
    const double sure = positives > 0 ? 1 : -1;
    return {{0, 0, sure, sure}};
  }
  const auto machine = cv::ml::Boost::create();
  machine->setBoostType(cv::ml::Boost::DISCRETE);
  machine->setWeakCount(rounds);
  machine->setWeightTrimRate(0);
  machine->setMaxDepth(1);
  machine->setUseSurrogates(false);
  machine->train(cv::ml::TrainData::create(samples, cv::ml::ROW_SAMPLE, responses));
  Ensemble ensemble;
  const auto& nodes = machine->getNodes();
  const auto& splits = machine->getSplits();
  for (const int root : machine->getRoots()) {
    const auto& node = nodes[static_cast<std::size_t>(root)];
    if (node.split < 0) {
      ensemble.push_back({0, 0, node.value, node.value});
      continue;
    }
    const auto& split = splits[static_cast<std::size_t>(node.split)];
    double below = nodes[static_cast<std::size_t>(node.left)].value;
    double above = nodes[static_cast<std::size_t>(node.right)].value;
    if (split.inversed) std::swap(below, above);
    ensemble.push_back({split.varIdx, static_cast<double>(split.c), below, above});
  }
  return ensemble;
}

/// Votes for a place, whose weights sum to one: 1 if all stumps agree on the place.
double vote(const Ensemble& ensemble, const Eigen::Ref<const Eigen::VectorXd>& opinions) {
  double sum = 0, most = 0;
  for (const Stump& stump : ensemble) {
    const bool below =
        static_cast<float>(opinions[stump.column]) <= static_cast<float>(stump.threshold);
    sum += below ? stump.below : stump.above;
    most += std::max(std::abs(stump.below), std::abs(stump.above));
  }
  return most > 0 ? sum / most : 0;
}

std::vector<Ensemble> boost_all(const Eigen::MatrixXd& opinions,
                                const std::vector<Eigen::Index>& views,
                                const PlaceTrainingSet& training_set, int rounds) {
  std::vector<Ensemble> ensembles;
  for (int place = 0; place < training_set.places; ++place)
    ensembles.push_back(boost(opinions, views, training_set, place, rounds));
  return ensembles;
}

Eigen::VectorXd votes(const std::vector<Ensemble>& ensembles,
                      const Eigen::Ref<const Eigen::VectorXd>& opinions) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(ensembles.size()));
  for (std::size_t i = 0; i < ensembles.size(); ++i)
    result[static_cast<Eigen::Index>(i)] = vote(ensembles[i], opinions);
  return result;
}

class BoostedMachine final : public PlaceMachine {
 public:
  BoostedMachine(CueOpinions opinions, std::vector<Ensemble> ensembles)
      : opinions_(std::move(opinions)), ensembles_(std::move(ensembles)) {}
  Eigen::VectorXd outputs(
      const std::array<Eigen::VectorXd, kClassifierCues>& distances) const override {
    return votes(ensembles_, opinions_.of(distances));
  }

 private:
  CueOpinions opinions_;
  std::vector<Ensemble> ensembles_;
};

/// Weight of the stumps on each cue; the largest of any cue is 1.
PerCue weights_of(const std::vector<Ensemble>& ensembles, const CueOpinions& opinions) {
  PerCue weights{};
  for (const Ensemble& ensemble : ensembles)
    for (const Stump& stump : ensemble)
      weights[opinions.cue_of(stump.column)] += std::abs(stump.above - stump.below);
  const double most = *std::max_element(weights.begin(), weights.end());
  for (double& weight : weights) weight /= std::max(most, 1e-12);
  return weights;
}

}  // namespace

TrainedPlaceMachine train_boosted_machine(const PlaceTrainingSet& training_set,
                                          const PlaceClassifierOptions& options) {
  CueOpinions opinions(training_set, options);
  const Eigen::MatrixXd& message = opinions.left_out();
  TrainedPlaceMachine result;
  result.left_out = Eigen::MatrixXd::Zero(message.rows(), training_set.places);
  for (int fold = 0; fold < options.folds; ++fold) {
    const auto [in, out] = split_fold(training_set, fold);
    if (in.empty() || out.empty()) continue;
    const std::vector<Ensemble> ensembles = boost_all(message, in, training_set, options.rounds);
    for (const Eigen::Index i : out)
      result.left_out.row(i) = votes(ensembles, message.row(i).transpose());
  }
  std::vector<Ensemble> ensembles =
      boost_all(message, split_fold(training_set, -1).in, training_set, options.rounds);
  result.weights = weights_of(ensembles, opinions);
  result.machine = std::make_shared<BoostedMachine>(std::move(opinions), std::move(ensembles));
  return result;
}

}  // namespace placegraph
