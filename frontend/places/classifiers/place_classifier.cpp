#include <placegraph/frontend/places/classifiers/kernel_machine.h>
#include <placegraph/frontend/places/classifiers/place_classifier.h>
#include <placegraph/frontend/places/classifiers/platt_scaling.h>
#include <placegraph/frontend/places/cues/colour_histogram.h>
#include <placegraph/frontend/places/cues/gabor_statistics.h>
#include <placegraph/frontend/places/cues/gradient_layout.h>
#include <placegraph/frontend/places/cues/tiny_image.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

Eigen::VectorXf unit_vector(const CueGrid& grid) {
  Eigen::VectorXf vector(static_cast<Eigen::Index>(grid.values.size()));
  for (Eigen::Index i = 0; i < vector.size(); ++i)
    vector[i] = grid.values[static_cast<std::size_t>(i)];
  return vector / std::max(vector.norm(), 1e-6f);
}

double squared_distance(const Eigen::VectorXf& a, const Eigen::VectorXf& b) {
  return std::max(0.0, 2 - 2 * static_cast<double>(a.dot(b)));
}

double median_above_diagonal(const Eigen::MatrixXd& matrix) {
  std::vector<double> values;
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = 0; i < j; ++i) values.push_back(matrix(i, j));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return std::max(*middle, 1e-9);
}

/// Fold of each view. Consecutive views with one label are a visit; each visit is cut into so many
/// parts.
std::vector<int> folds_of(const std::vector<int>& labels, int folds) {
  std::vector<int> result(labels.size());
  for (std::size_t first = 0; first < labels.size();) {
    std::size_t last = first;
    while (last < labels.size() && labels[last] == labels[first]) ++last;
    for (std::size_t i = first; i < last; ++i)
      result[i] = static_cast<int>((i - first) * static_cast<std::size_t>(folds) / (last - first));
    first = last;
  }
  return result;
}

void check(const std::vector<PlaceCueVectors>& views, const std::vector<int>& labels) {
  require(!views.empty() && views.size() == labels.size(),
          "PlaceClassifier: needs as many labels as views");
  require(*std::min_element(labels.begin(), labels.end()) >= 0,
          "PlaceClassifier: a negative label");
  require(std::any_of(labels.begin(), labels.end(), [&](int l) { return l != labels.front(); }),
          "PlaceClassifier: needs two places or more");
  require(std::any_of(views.front().begin(), views.front().end(),
                      [](const Eigen::VectorXf& cue) { return cue.size() > 0; }),
          "PlaceClassifier: views without any cue");
  for (const PlaceCueVectors& view : views)
    for (std::size_t m = 0; m < view.size(); ++m)
      require(view[m].size() == views.front()[m].size(),
              "PlaceClassifier: images differ in shape, or some are grey and some in colour");
}

}  // namespace

void PlaceClassifierOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceClassifierOptions& o) {
  field.choice("machine", o.machine, {"kernel", "svm", "adaboost"},
               "machine that learns the places");
  field("ridge", o.ridge, "value added to the diagonal of the kernel matrix", {1e-9, 1e3});
  field("folds", o.folds, "number of parts of a visit, each left out of the training once",
        {2, 20});
  field("rounds", o.rounds, "number of stumps of one boosted machine", {1, 10000});
}

PlaceCueVectors describe_for_classes(const Image& image) {
  require(image.type() == CV_8UC1 || image.type() == CV_8UC3,
          "describe_for_classes: grey or BGR image needed");
  cv::Mat grey = image;
  PlaceCueVectors vectors;
  if (image.channels() == 3) {
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    vectors[0] = unit_vector(colour_histogram_cue(image, {.cells = 1}));
    vectors[1] = unit_vector(colour_histogram_cue(image, {.cells = 2}));
  }
  vectors[2] = unit_vector(gradient_layout_cue(grey));
  vectors[3] = unit_vector(tiny_image_cue(image, 24));
  vectors[4] = unit_vector(gabor_cue(grey));
  return vectors;
}

struct PlaceClassifier::Trained {
  std::vector<PlaceCueVectors> views;
  PerCue weights = {}, median = {};
  std::shared_ptr<const PlaceMachine> machine;
  std::vector<PlattScaling> scaling;  // of each place
  double accuracy = 0, log_loss = 0;

  Eigen::VectorXd calibrated(const Eigen::VectorXd& outputs) const {
    Eigen::VectorXd probabilities(outputs.size());
    for (Eigen::Index i = 0; i < outputs.size(); ++i)
      probabilities[i] = scaling[static_cast<std::size_t>(i)].probability(outputs[i]);
    return probabilities / std::max(probabilities.sum(), 1e-300);
  }
};

PlaceClassifier::PlaceClassifier(std::shared_ptr<const Trained> trained)
    : trained_(std::move(trained)) {}

const PerCue& PlaceClassifier::weights() const { return trained_->weights; }

double PlaceClassifier::cross_validated_accuracy() const { return trained_->accuracy; }

double PlaceClassifier::cross_validated_log_loss() const { return trained_->log_loss; }

PlaceClassifier PlaceClassifier::train(std::vector<PlaceCueVectors> views,
                                       const std::vector<int>& labels,
                                       const PlaceClassifierOptions& options) {
  options.check();
  check(views, labels);
  const auto count = static_cast<Eigen::Index>(views.size());
  Trained result;
  PlaceTrainingSet training_set;
  training_set.labels = labels;
  training_set.places = *std::max_element(labels.begin(), labels.end()) + 1;
  training_set.fold = folds_of(labels, options.folds);
  for (std::size_t m = 0; m < training_set.distances.size(); ++m) {
    if (views.front()[m].size() == 0) continue;
    Eigen::MatrixXd& distances = training_set.distances[m];
    distances = Eigen::MatrixXd::Zero(count, count);
    for (Eigen::Index j = 0; j < count; ++j)
      for (Eigen::Index i = 0; i < j; ++i)
        distances(i, j) = distances(j, i) = squared_distance(views[static_cast<std::size_t>(i)][m],
                                                             views[static_cast<std::size_t>(j)][m]);
    result.median[m] = median_above_diagonal(distances);
    distances /= result.median[m];
  }
  TrainedPlaceMachine trained = train_place_machine(training_set, options);
  result.weights = trained.weights;
  result.machine = std::move(trained.machine);
  for (int place = 0; place < training_set.places; ++place)
    result.scaling.push_back(fit_platt_scaling(trained.left_out.col(place),
                                               targets_of(training_set).col(place).array() > 0));
  int right = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::VectorXd probabilities = result.calibrated(trained.left_out.row(i));
    Eigen::Index best = 0;
    probabilities.maxCoeff(&best);
    const int label = labels[static_cast<std::size_t>(i)];
    right += best == label;
    result.log_loss -= std::log(std::max(probabilities[label], 1e-12));
  }
  result.accuracy = static_cast<double>(right) / static_cast<double>(count);
  result.log_loss /= static_cast<double>(count);
  result.views = std::move(views);
  return PlaceClassifier(std::make_shared<const Trained>(std::move(result)));
}

Eigen::VectorXd PlaceClassifier::classify(const PlaceCueVectors& view) const {
  std::array<Eigen::VectorXd, kClassifierCues> distances;
  for (std::size_t m = 0; m < distances.size(); ++m) {
    if (trained_->weights[m] == 0) continue;
    distances[m].resize(static_cast<Eigen::Index>(trained_->views.size()));
    for (std::size_t i = 0; i < trained_->views.size(); ++i) {
      require(view[m].size() == trained_->views[i][m].size(),
              "PlaceClassifier: the image has another shape, or is grey and not in colour");
      distances[m][static_cast<Eigen::Index>(i)] =
          squared_distance(view[m], trained_->views[i][m]) / trained_->median[m];
    }
  }
  return trained_->calibrated(trained_->machine->outputs(distances));
}

double entropy_share(const Eigen::VectorXd& probabilities) {
  if (probabilities.size() < 2) return 0;
  double entropy = 0;
  for (const double p : probabilities)
    if (p > 0) entropy -= p * std::log(p);
  return entropy / std::log(static_cast<double>(probabilities.size()));
}

LabelFilter::LabelFilter(const std::vector<int>& labels) {
  require(!labels.empty() && *std::min_element(labels.begin(), labels.end()) >= 0,
          "LabelFilter: needs labels from 0 on");
  const int count = *std::max_element(labels.begin(), labels.end()) + 1;
  // Unseen transitions count as half of one, as a path may be taken for the first time.
  transition_ = Eigen::MatrixXd::Constant(count, count, 0.5);
  for (std::size_t i = 1; i < labels.size(); ++i) {
    transition_(labels[i], labels[i - 1]) += 1;
    if (labels[i] != labels[i - 1]) transition_(labels[i - 1], labels[i]) += 1;
  }
  for (int from = 0; from < count; ++from) transition_.col(from) /= transition_.col(from).sum();
  belief_ = Eigen::VectorXd::Constant(count, 1.0 / count);
}

Eigen::VectorXd LabelFilter::update(const Eigen::VectorXd& probabilities) {
  require(probabilities.size() == belief_.size(),
          "LabelFilter: the number of places differs from that of the training");
  belief_ = (transition_ * belief_).cwiseProduct(probabilities);
  belief_ /= belief_.sum();
  return belief_;
}

}  // namespace placegraph
