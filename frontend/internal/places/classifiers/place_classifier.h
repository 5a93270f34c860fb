#pragma once
#include <placegraph/frontend/internal/places/classifiers/place_machine.h>
#include <placegraph/frontend/internal/places/classifiers/platt_scaling.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace placegraph {

/// An image as a classifier of places sees it: one vector of unit length per cue, colours of the
/// whole image, colours of its quarters, the layout of edges, the tiny image, texture. Those of
/// colour are empty for grey images; whoever leaves a cue out empties it in all views.
using PlaceCueVectors = std::array<Eigen::VectorXf, kClassifierCues>;

/// `image`: grey or BGR, 8 bits (ArgumentError otherwise).
PlaceCueVectors describe_for_classes(const Image& image);

/// Which of the labelled places an image shows. One-vs-rest machines (place_machine.h) over
/// squared distances in every cue: support vector machines, least-squares (Suykens & Vandewalle
/// 1999) or of maximal margin, over one kernel exp(-sum_m w_m d_m^2 / sum_m w_m), d_m^2 over its
/// median, the weights those of {0, 1/2, 1} with the least squared error on parts of visits left
/// out of the training; or boosted stumps over what a machine of each cue says. What the machines
/// say of the parts left out also calibrates the probabilities (Platt's sigmoid per place).
class PlaceClassifier {
 public:
  /// `labels`: of the views, from 0, in the order the views were taken. Throws ArgumentError unless
  /// there are as many labels as views, of two places or more, all views grey or all in colour.
  static PlaceClassifier train(std::vector<PlaceCueVectors> views, const std::vector<int>& labels,
                               const PlaceClassifierOptions& options);

  /// P(place | image), by label; they sum to one.
  Eigen::VectorXd classify(const PlaceCueVectors& view) const;
  const PerCue& weights() const { return weights_; }
  /// Share of views left out of the training that were given their label, and the mean of minus
  /// the logarithm of the probability it was given.
  double cross_validated_accuracy() const { return accuracy_; }
  double cross_validated_log_loss() const { return log_loss_; }

 private:
  Eigen::VectorXd calibrated(const Eigen::VectorXd& outputs) const;

  std::vector<PlaceCueVectors> views_;
  PerCue weights_ = {}, median_ = {};
  std::shared_ptr<const PlaceMachine> machine_;
  std::vector<PlattScaling> scaling_;  ///< by place
  double accuracy_ = 0, log_loss_ = 0;
};

/// The entropy of probabilities as a share of what it is where all are alike: 0 sure, 1 unknown.
double entropy_share(const Eigen::VectorXd& probabilities);

/// Forward Bayes filter over the labels of consecutive images: from one place to itself and to
/// those that followed it in the training.
class LabelFilter {
 public:
  /// `labels`: of consecutive training images.
  explicit LabelFilter(const std::vector<int>& labels);
  /// The posterior after one more image's probabilities.
  Eigen::VectorXd update(const Eigen::VectorXd& probabilities);

 private:
  Eigen::MatrixXd transition_;  ///< to x from
  Eigen::VectorXd belief_;
};

}  // namespace placegraph
