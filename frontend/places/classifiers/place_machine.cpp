#include <placegraph/frontend/places/classifiers/place_machine.h>

namespace placegraph {

void PlaceClassifierOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceClassifierOptions& o) {
  field.choice("machine", o.machine, {"kernel", "svm", "adaboost"},
               "machine that learns the places");
  field("ridge", o.ridge, "value added to the diagonal of the kernel matrix", {1e-9, 1e3});
  field("folds", o.folds, "number of parts of a visit, each left out of the training once",
        {2, 20});
  field("rounds", o.rounds, "number of stumps of one boosted machine", {1, 10000});
}

TrainedPlaceMachine train_place_machine(const PlaceTrainingSet& training_set,
                                        const PlaceClassifierOptions& options) {
  switch (options.machine) {
    case PlaceMachineKind::kSvm:
      return train_support_vectors(training_set, options);
    case PlaceMachineKind::kAdaboost:
      return train_boosted_machine(training_set, options);
    case PlaceMachineKind::kKernel:
      break;
  }
  return train_kernel_machine(training_set, options);
}

}  // namespace placegraph
