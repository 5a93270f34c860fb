#pragma once
#include <placegraph/frontend/places/classifiers/place_machine.h>
#include <placegraph/frontend/places/classifiers/platt_scaling.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace placegraph {

/// Cues of an image for the place classifier, one vector of unit length each.
///
/// The cues are the colours of the whole image, the colours of its quarters, the layout of edges,
/// the tiny image and texture. The colour cues are empty for grey images; to leave a cue out, empty
/// it in all views.
using PlaceCueVectors = std::array<Eigen::VectorXf, kClassifierCues>;

/// Describes an image for the classifier. `image`: grey or BGR, 8 bits (ArgumentError otherwise).
PlaceCueVectors describe_for_classes(const Image& image);

/// Classifies an image as one of the labelled places.
///
/// One-vs-rest machines (place_machine.h) use squared distances in every cue. They are either
/// support vector machines, least-squares (Suykens & Vandewalle 1999) or of maximal margin, with
/// one kernel exp(-sum_m w_m d_m^2 / sum_m w_m), where d_m^2 is divided by its median and the
/// weights are those of {0, 1/2, 1} with the least squared error on parts of visits left out of the
/// training; or boosted stumps over the outputs of one machine per cue. The outputs for the parts
/// left out also calibrate the probabilities (Platt's sigmoid per place).
class PlaceClassifier {
 public:
  /// Trains a classifier. `labels`: one per view, from 0, in the order in which the views were
  /// taken. Throws ArgumentError unless there are as many labels as views, at least two places, and
  /// all views are grey or all in colour.
  static PlaceClassifier train(std::vector<PlaceCueVectors> views, const std::vector<int>& labels,
                               const PlaceClassifierOptions& options);

  /// P(place | image), by label; the sum is one.
  Eigen::VectorXd classify(const PlaceCueVectors& view) const;
  const PerCue& weights() const { return weights_; }
  /// Cross-validation on views left out of the training: the share of correct labels, and the mean
  /// of minus the logarithm of the probability of the correct label.
  double cross_validated_accuracy() const { return accuracy_; }
  double cross_validated_log_loss() const { return log_loss_; }

 private:
  Eigen::VectorXd calibrated(const Eigen::VectorXd& outputs) const;

  std::vector<PlaceCueVectors> views_;
  PerCue weights_ = {}, median_ = {};
  std::shared_ptr<const PlaceMachine> machine_;
  std::vector<PlattScaling> scaling_;  ///< scaling of each place
  double accuracy_ = 0, log_loss_ = 0;
};

/// Entropy of probabilities as a share of its maximum, that of equal probabilities: 0 certain, 1
/// unknown.
double entropy_share(const Eigen::VectorXd& probabilities);

/// Forward Bayes filter over the labels of consecutive images.
///
/// The transitions from a place lead to itself and to the places that followed it in the training.
class LabelFilter {
 public:
  /// Estimates the transitions. `labels`: labels of consecutive training images.
  explicit LabelFilter(const std::vector<int>& labels);
  /// Returns the posterior after the probabilities of one more image.
  Eigen::VectorXd update(const Eigen::VectorXd& probabilities);

 private:
  Eigen::MatrixXd transition_;  ///< transition probabilities, to x from
  Eigen::VectorXd belief_;
};

}  // namespace placegraph
