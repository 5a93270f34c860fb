#pragma once
#include <placegraph/graph/core/image.h>
#include <placegraph/graph/core/options.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace placegraph {

/// An image as a classifier of places sees it: one vector of unit length per cue, colours of the
/// whole image, colours of its quarters, the layout of edges, the tiny image. Those of colour are
/// empty for grey images.
constexpr int kClassifierCues = 4;
using PlaceCueVectors = std::array<Eigen::VectorXf, kClassifierCues>;

/// `image`: grey or BGR, 8 bits (ArgumentError otherwise).
PlaceCueVectors describe_for_classes(const Image& image);

struct PlaceClassifierOptions {
  double ridge = 0.01;  ///< of the kernel matrix
  int folds = 4;        ///< parts that every visit to a place is cut into, each left out once
  void check() const;
};
void visit(OptionVisitor& field, PlaceClassifierOptions& options);

/// Which of the labelled places an image shows. One-vs-rest least-squares support vector machines
/// (Suykens & Vandewalle 1999) over one kernel of all cues, exp(-sum_m w_m d_m^2 / mean of w),
/// d_m^2 the squared distance in cue m over its median. The weights w are those of {0, 1/2, 1} with
/// the least squared error on parts of visits left out of the training; what the machines say there
/// also calibrates the probabilities (softmax of one temperature).
class PlaceClassifier {
 public:
  /// `labels`: of the views, from 0, in the order the views were taken. Throws ArgumentError unless
  /// there are as many labels as views, of two places or more, all views grey or all in colour.
  static PlaceClassifier train(std::vector<PlaceCueVectors> views, const std::vector<int>& labels,
                               const PlaceClassifierOptions& options);

  /// P(place | image), by label; they sum to one.
  Eigen::VectorXd classify(const PlaceCueVectors& view) const;
  const std::array<double, kClassifierCues>& weights() const { return weights_; }
  /// Share of views left out of the training that were given their label.
  double cross_validated_accuracy() const { return accuracy_; }

 private:
  std::vector<PlaceCueVectors> views_;
  std::array<double, kClassifierCues> weights_ = {}, median_ = {};
  Eigen::MatrixXd coefficients_;  ///< views x labels
  double temperature_ = 1, accuracy_ = 0;
};

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
