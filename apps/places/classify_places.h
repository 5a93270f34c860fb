#pragma once
#include <placegraph/graph/core/ids.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// What learns places, in the order of PlaceMachineKind.
const std::vector<std::string>& place_machines();
/// The cues that views are told apart by, in the order of PlaceCueVectors.
const std::vector<std::string>& place_cues();

struct ClassifyPlacesArguments {
  /// With images (or images/), labels.txt, and gt.txt, whose candidates are learned and whose
  /// queries are told.
  std::string folder;
  std::string out;           ///< file of the answers
  std::optional<int> train;  ///< the first so many are learned, whatever gt.txt says
  double reject = 0;         ///< nothing is told below this probability
  double max_entropy = 1;    ///< nor above this entropy, a share of that of knowing nothing
  std::string classifier = place_machines().front();
  std::vector<std::string> cues = place_cues();  ///< those that count
  bool sequence = false;                         ///< the evidence of the images before is added
  bool force = false;                            ///< overwrite `out`
};

struct ClassifiedPlace {
  FrameId image;
  int label = -1;  ///< -1 where it was refused
  double probability = 0;
};

struct ClassifyPlacesResult {
  std::string out;
  std::size_t learned = 0;            ///< views
  std::vector<ClassifiedPlace> told;  ///< one an image that was asked for
  std::size_t refused = 0;            ///< of those
  std::vector<double> weights;        ///< of the cues
  double accuracy = 0;                ///< on left out parts of what was learned
  double log_loss = 0;                ///< there
};

/// `placegraph places classify`: learns the labels of some images, tells those of the others and
/// writes them. Warnings go to stderr. Throws ArgumentError, FileError.
ClassifyPlacesResult classify_places(const ClassifyPlacesArguments& arguments);

/// One line.
std::string to_text(const ClassifyPlacesResult& result);

}  // namespace placegraph::apps
