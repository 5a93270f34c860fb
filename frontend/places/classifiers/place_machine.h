#pragma once
#include <placegraph/frontend/places/classifiers/place_classifier.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

namespace placegraph {

/// Labelled views, represented by the distances between them.
struct PlaceTrainingSet {
  /// Squared distances in each cue over their median; empty for a missing cue.
  std::array<Eigen::MatrixXd, kClassifierCues> distances;
  std::vector<int> labels;
  int places = 0;         ///< labels 0 .. places-1
  std::vector<int> fold;  ///< fold of each view; the views of a fold are left out together
};

/// One-vs-rest machine: one output per place, larger is more certain, about 0 for a probability of
/// 0.5.
class PlaceMachine {
 public:
  virtual ~PlaceMachine() = default;
  /// Returns the outputs for a view. `distances`: from the view to those of the training set, in
  /// the same units.
  virtual Eigen::VectorXd outputs(
      const std::array<Eigen::VectorXd, kClassifierCues>& distances) const = 0;
};

struct TrainedPlaceMachine {
  std::shared_ptr<const PlaceMachine> machine;
  Eigen::MatrixXd left_out;  ///< outputs for views by machines trained without their fold
  PerCue weights{};          ///< weight of each cue; the largest is 1
};

/// Trains the machine of `options.machine`. The same training set gives the same bits.
TrainedPlaceMachine train_place_machine(const PlaceTrainingSet& training_set,
                                        const PlaceClassifierOptions& options);

/// Trainers of the single kinds.
TrainedPlaceMachine train_kernel_machine(const PlaceTrainingSet& training_set,
                                         const PlaceClassifierOptions& options);
TrainedPlaceMachine train_support_vectors(const PlaceTrainingSet& training_set,
                                          const PlaceClassifierOptions& options);
TrainedPlaceMachine train_boosted_machine(const PlaceTrainingSet& training_set,
                                          const PlaceClassifierOptions& options);

}  // namespace placegraph
