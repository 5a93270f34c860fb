#include <placegraph/frontend/places/cues/colour_histogram.h>
#include <placegraph/frontend/places/cues/gradient_layout.h>
#include <placegraph/frontend/places/cues/tiny_image.h>
#include <placegraph/frontend/places/place_classifier.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
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

/// Runs of one label are visits; each is cut into so many parts.
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

Eigen::MatrixXd targets_of(const std::vector<int>& labels) {
  const int count = *std::max_element(labels.begin(), labels.end()) + 1;
  Eigen::MatrixXd targets =
      Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(labels.size()), count, -1);
  for (std::size_t i = 0; i < labels.size(); ++i)
    targets(static_cast<Eigen::Index>(i), labels[i]) = 1;
  return targets;
}

Eigen::MatrixXd solve(Eigen::MatrixXd kernel, const Eigen::MatrixXd& targets, double ridge) {
  kernel.diagonal().array() += ridge;
  return kernel.ldlt().solve(targets);
}

/// What machines trained without a fold say of it.
Eigen::MatrixXd left_out(const Eigen::MatrixXd& kernel, const Eigen::MatrixXd& targets,
                         const std::vector<int>& fold, const PlaceClassifierOptions& options) {
  Eigen::MatrixXd outputs = Eigen::MatrixXd::Zero(targets.rows(), targets.cols());
  for (int f = 0; f < options.folds; ++f) {
    std::vector<Eigen::Index> in, out;
    for (std::size_t i = 0; i < fold.size(); ++i)
      (fold[i] == f ? out : in).push_back(static_cast<Eigen::Index>(i));
    if (in.empty() || out.empty()) continue;
    const Eigen::MatrixXd coefficients =
        solve(kernel(in, in), targets(in, Eigen::all), options.ridge);
    outputs(out, Eigen::all) = kernel(out, in) * coefficients;
  }
  return outputs;
}

Eigen::VectorXd softmax(const Eigen::VectorXd& outputs, double temperature) {
  const Eigen::VectorXd powers =
      ((outputs.array() - outputs.maxCoeff()) / temperature).exp().matrix();
  return powers / powers.sum();
}

double log_loss(const Eigen::MatrixXd& outputs, const std::vector<int>& labels,
                double temperature) {
  double loss = 0;
  for (Eigen::Index i = 0; i < outputs.rows(); ++i)
    loss -= std::log(
        std::max(softmax(outputs.row(i), temperature)[labels[static_cast<std::size_t>(i)]], 1e-12));
  return loss;
}

/// Powers of two by quarters are fine enough for a temperature.
double best_temperature(const Eigen::MatrixXd& outputs, const std::vector<int>& labels) {
  double best = 1, least = std::numeric_limits<double>::infinity();
  for (int quarter = -28; quarter <= 8; ++quarter) {
    const double temperature = std::exp2(quarter / 4.0);
    const double loss = log_loss(outputs, labels, temperature);
    if (loss < least) {
      least = loss;
      best = temperature;
    }
  }
  return best;
}

using Weights = std::array<double, kClassifierCues>;

/// All of {0, 1/2, 1} per cue there is, with at least one 1.
std::vector<Weights> weights_to_try(const PlaceCueVectors& view) {
  std::vector<Weights> result;
  for (int code = 0; code < 81; ++code) {
    Weights weights;
    int rest = code;
    bool known = true;
    for (std::size_t m = 0; m < weights.size(); ++m, rest /= 3) {
      weights[m] = 0.5 * (rest % 3);
      known = known && (weights[m] == 0 || view[m].size() > 0);
    }
    if (known && *std::max_element(weights.begin(), weights.end()) == 1) result.push_back(weights);
  }
  return result;
}

double sum_of(const Weights& weights) {
  double sum = 0;
  for (const double weight : weights) sum += weight;
  return sum;
}

void check(const std::vector<PlaceCueVectors>& views, const std::vector<int>& labels) {
  require(!views.empty() && views.size() == labels.size(),
          "PlaceClassifier: as many labels as views needed");
  require(*std::min_element(labels.begin(), labels.end()) >= 0,
          "PlaceClassifier: a negative label");
  require(std::any_of(labels.begin(), labels.end(), [&](int l) { return l != labels.front(); }),
          "PlaceClassifier: two places or more needed");
  for (const PlaceCueVectors& view : views)
    for (std::size_t m = 0; m < view.size(); ++m)
      require(view[m].size() == views.front()[m].size(),
              "PlaceClassifier: images differ in shape, or some are grey and some in colour");
}

}  // namespace

void PlaceClassifierOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceClassifierOptions& o) {
  field("ridge", o.ridge, "added to the diagonal of the kernel matrix", {1e-9, 1e3});
  field("folds", o.folds, "parts of a visit, each left out of the training once", {2, 20});
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
  return vectors;
}

PlaceClassifier PlaceClassifier::train(std::vector<PlaceCueVectors> views,
                                       const std::vector<int>& labels,
                                       const PlaceClassifierOptions& options) {
  options.check();
  check(views, labels);
  const auto count = static_cast<Eigen::Index>(views.size());
  PlaceClassifier result;
  std::array<Eigen::MatrixXd, kClassifierCues> distances;
  for (std::size_t m = 0; m < distances.size(); ++m) {
    distances[m] = Eigen::MatrixXd::Zero(count, count);
    for (Eigen::Index j = 0; j < count; ++j)
      for (Eigen::Index i = 0; i < j; ++i)
        distances[m](i, j) = distances[m](j, i) = squared_distance(
            views[static_cast<std::size_t>(i)][m], views[static_cast<std::size_t>(j)][m]);
    result.median_[m] = median_above_diagonal(distances[m]);
  }
  const auto kernel_of = [&](const Weights& weights) {
    Eigen::MatrixXd exponent = Eigen::MatrixXd::Zero(count, count);
    for (std::size_t m = 0; m < weights.size(); ++m)
      if (weights[m] > 0)
        exponent += weights[m] / (sum_of(weights) * result.median_[m]) * distances[m];
    return Eigen::MatrixXd((-exponent.array()).exp());
  };
  const Eigen::MatrixXd targets = targets_of(labels);
  const std::vector<int> fold = folds_of(labels, options.folds);
  double least = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd outputs;
  for (const Weights& weights : weights_to_try(views.front())) {
    Eigen::MatrixXd said = left_out(kernel_of(weights), targets, fold, options);
    const double error = (said - targets).squaredNorm();
    if (error >= least) continue;
    least = error;
    result.weights_ = weights;
    outputs = std::move(said);
  }
  result.temperature_ = best_temperature(outputs, labels);
  int right = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::Index best = 0;
    outputs.row(i).maxCoeff(&best);
    right += best == labels[static_cast<std::size_t>(i)];
  }
  result.accuracy_ = static_cast<double>(right) / static_cast<double>(count);
  result.coefficients_ = solve(kernel_of(result.weights_), targets, options.ridge);
  result.views_ = std::move(views);
  return result;
}

Eigen::VectorXd PlaceClassifier::classify(const PlaceCueVectors& view) const {
  const double sum = sum_of(weights_);
  Eigen::VectorXd kernel(static_cast<Eigen::Index>(views_.size()));
  for (std::size_t i = 0; i < views_.size(); ++i) {
    double exponent = 0;
    for (std::size_t m = 0; m < weights_.size(); ++m) {
      if (weights_[m] == 0) continue;
      require(view[m].size() == views_[i][m].size(),
              "PlaceClassifier: an image of another shape, or grey and not in colour");
      exponent += weights_[m] / (sum * median_[m]) * squared_distance(view[m], views_[i][m]);
    }
    kernel[static_cast<Eigen::Index>(i)] = std::exp(-exponent);
  }
  return softmax(coefficients_.transpose() * kernel, temperature_);
}

LabelFilter::LabelFilter(const std::vector<int>& labels) {
  require(!labels.empty() && *std::min_element(labels.begin(), labels.end()) >= 0,
          "LabelFilter: labels from 0 needed");
  const int count = *std::max_element(labels.begin(), labels.end()) + 1;
  // Half a transition that was not seen: a way may be taken for the first time.
  transition_ = Eigen::MatrixXd::Constant(count, count, 0.5);
  for (std::size_t i = 1; i < labels.size(); ++i) {
    transition_(labels[i], labels[i - 1]) += 1;
    if (labels[i] != labels[i - 1]) transition_(labels[i - 1], labels[i]) += 1;
  }
  for (int from = 0; from < count; ++from) transition_.col(from) /= transition_.col(from).sum();
  belief_ = Eigen::VectorXd::Constant(count, 1.0 / count);
}

Eigen::VectorXd LabelFilter::update(const Eigen::VectorXd& probabilities) {
  require(probabilities.size() == belief_.size(), "LabelFilter: another number of places");
  belief_ = (transition_ * belief_).cwiseProduct(probabilities);
  belief_ /= belief_.sum();
  return belief_;
}

}  // namespace placegraph
