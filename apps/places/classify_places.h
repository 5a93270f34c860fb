#pragma once
#include <placegraph/graph/core/ids.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Names of the classifiers, in the order of PlaceMachineKind.
const std::vector<std::string>& place_machines();
/// Names of the cues of a view, in the order of PlaceCueVectors.
const std::vector<std::string>& place_cues();

struct ClassifyPlacesArguments {
  /// Folder with images (or images/), labels.txt, and gt.txt, whose candidates are the training set
  /// and whose queries are classified.
  std::string folder;
  std::string out;  ///< file for the predictions
  std::optional<int>
      train;  ///< number of images at the beginning that are the training set, instead of gt.txt
  double reject = 0;  ///< predictions below this probability are rejected
  double max_entropy =
      1;  ///< predictions above this entropy are rejected, as a share of a uniform distribution's
  std::string classifier = place_machines().front();
  std::vector<std::string> cues = place_cues();  ///< cues to compare
  bool sequence = false;                         ///< add the evidence of the previous images
  bool force = false;                            ///< overwrite `out`
};

struct ClassifiedPlace {
  FrameId image;
  int label = -1;  ///< -1 if rejected
  double probability = 0;
};

struct ClassifyPlacesResult {
  std::string out;
  std::size_t learned = 0;                   ///< number of training views
  std::vector<ClassifiedPlace> predictions;  ///< one prediction per query image
  std::size_t refused = 0;                   ///< number of rejected predictions
  std::vector<double> weights;               ///< weights of the cues
  double accuracy = 0;                       ///< cross-validated accuracy on the training set
  double log_loss = 0;                       ///< cross-validated log loss
};

/// Learns the labels of some images and predicts those of the others: `places classify`.
/// The predictions are written to a file, warnings go to stderr. Throws ArgumentError, FileError.
ClassifyPlacesResult classify_places(const ClassifyPlacesArguments& arguments);

/// One line.
std::string to_text(const ClassifyPlacesResult& result);

}  // namespace placegraph::apps
