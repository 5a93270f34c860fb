#include <placegraph/frontend/places/classifiers/place_machine.h>

namespace placegraph {

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
