#pragma once
#include <placegraph/graph/core/options.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

namespace placegraph {

constexpr int kClassifierCues = 5;
/// One number per cue: a weight, or the squared distance of two views.
using PerCue = std::array<double, kClassifierCues>;

/// The kernel machine is the default. The two of OpenCV are there to compare: on the same views and
/// cues they name 0.994 and 0.955 of the places rightly, the kernel machine 0.994 (docs/results.md,
/// section place_classifiers).
enum class PlaceMachineKind {
  kKernel,    ///< least-squares support vector machines over one kernel of all cues
  kSvm,       ///< support vector machines over the same kernel (OpenCV)
  kAdaboost,  ///< boosted stumps over what one machine per cue says (OpenCV)
};

struct PlaceClassifierOptions {
  PlaceMachineKind machine = PlaceMachineKind::kKernel;
  double ridge = 0.01;  ///< of the kernel matrix
  int folds = 4;        ///< parts that every visit to a place is cut into, each left out once
  int rounds = 60;      ///< stumps of one boosted machine
  void check() const;
};
void visit(OptionVisitor& field, PlaceClassifierOptions& options);

/// Labelled views by their distances to each other.
struct PlaceTrainingSet {
  /// Squared distances in each cue over their median; empty for a cue that there is not.
  std::array<Eigen::MatrixXd, kClassifierCues> distances;
  std::vector<int> labels;
  int places = 0;         ///< labels 0 .. places-1
  std::vector<int> fold;  ///< of each view, what is left out together
};

/// One-vs-rest: an output per place, larger is surer, 0 about where it is as likely as not.
class PlaceMachine {
 public:
  virtual ~PlaceMachine() = default;
  /// `distances`: of a view to those of the lesson, as there.
  virtual Eigen::VectorXd outputs(
      const std::array<Eigen::VectorXd, kClassifierCues>& distances) const = 0;
};

struct TrainedPlaceMachine {
  std::shared_ptr<const PlaceMachine> machine;
  Eigen::MatrixXd left_out;  ///< outputs for views by machines trained without their fold
  PerCue weights{};          ///< how much each cue counts, the most important 1
};

/// The machine of `options.machine`. Same lesson, same bits.
TrainedPlaceMachine train_place_machine(const PlaceTrainingSet& training_set,
                                        const PlaceClassifierOptions& options);

/// Each kind by itself.
TrainedPlaceMachine train_kernel_machine(const PlaceTrainingSet& training_set,
                                         const PlaceClassifierOptions& options);
TrainedPlaceMachine train_support_vectors(const PlaceTrainingSet& training_set,
                                          const PlaceClassifierOptions& options);
TrainedPlaceMachine train_boosted_machine(const PlaceTrainingSet& training_set,
                                          const PlaceClassifierOptions& options);

}  // namespace placegraph
