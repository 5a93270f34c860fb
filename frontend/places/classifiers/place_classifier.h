#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Number of cues of the classifier, see PlaceCueVectors.
constexpr int kClassifierCues = 5;
/// One number per cue: a weight, or the squared distance between two views.
using PerCue = std::array<double, kClassifierCues>;

/// Kinds of machines that learn the places.
///
/// The kernel machine is the default. The two of OpenCV serve for comparison: on the same views and
/// cues of vtm_virtual_house they classify 0.994 and 0.955 of the places correctly, the kernel
/// machine 0.994 (`placegraph places classify --classifier KIND`).
enum class PlaceMachineKind {
  kKernel,    ///< least-squares support vector machines over one kernel of all cues
  kSvm,       ///< support vector machines over the same kernel (OpenCV)
  kAdaboost,  ///< boosted stumps over the outputs of one machine per cue (OpenCV)
};

/// Training of a PlaceClassifier.
struct PlaceClassifierOptions {
  PlaceMachineKind machine = PlaceMachineKind::kKernel;  ///< what learns the places
  double ridge = 0.01;  ///< value added to the diagonal of the kernel matrix
  int folds = 4;        ///< number of parts of every visit to a place, each left out once
  int rounds = 60;      ///< number of stumps of one boosted machine
  void check() const;
};
void visit(OptionVisitor& field, PlaceClassifierOptions& options);

/// Cues of an image for the place classifier, one vector of unit length each.
///
/// The cues are the colours of the whole image, the colours of its quarters, the layout of edges,
/// the tiny image and texture. The colour cues are empty for grey images; to leave a cue out, empty
/// it in all views.
using PlaceCueVectors = std::array<Eigen::VectorXf, kClassifierCues>;

/// Describes an image for the classifier.
///
/// `image`: grey or BGR, 8 bits (ArgumentError otherwise).
PlaceCueVectors describe_for_classes(const Image& image);

/// Classifies an image as one of the labelled places.
///
/// One-vs-rest machines use squared distances in every cue. They are either support vector
/// machines, least-squares (Suykens & Vandewalle 1999) or of maximal margin, with one kernel
/// exp(-sum_m w_m d_m^2 / sum_m w_m), where d_m^2 is divided by its median and the weights are
/// those of {0, 1/2, 1} with the least squared error on parts of visits left out of the training;
/// or boosted stumps over the outputs of one machine per cue. The outputs for the parts left out
/// also calibrate the probabilities (Platt's sigmoid per place).
class PlaceClassifier {
 public:
  /// Trains a classifier. `labels`: one per view, from 0, in the order in which the views were
  /// taken. Throws ArgumentError unless there are as many labels as views, at least two places, and
  /// all views are grey or all in colour.
  static PlaceClassifier train(std::vector<PlaceCueVectors> views, const std::vector<int>& labels,
                               const PlaceClassifierOptions& options);

  /// P(place | image), by label; the sum is one.
  Eigen::VectorXd classify(const PlaceCueVectors& view) const;
  /// Weight of each cue; the largest is 1, that of a missing cue 0.
  const PerCue& weights() const;
  /// Share of correct labels among views left out of the training.
  double cross_validated_accuracy() const;
  /// Mean of minus the logarithm of the probability of the correct label of such views.
  double cross_validated_log_loss() const;

 private:
  struct Trained;
  explicit PlaceClassifier(std::shared_ptr<const Trained> trained);

  std::shared_ptr<const Trained> trained_;
};

/// Entropy of probabilities as a share of its maximum: 0 certain, 1 unknown.
///
/// The maximum is that of equal probabilities.
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
