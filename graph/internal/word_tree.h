#pragma once
#include <placegraph/graph/landmark.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph {

/// A tree of visual words, as it is trained, saved and looked up: whoever descends from the root to
/// the nearest child each time ends at a word. Centres are binary descriptors or vectors of
/// `dimension` numbers, one per node (that of the root means nothing).
struct WordTree {
  enum class Kind { kBinary, kFloat };
  struct Node {
    std::int32_t first_child = -1, children = 0;  ///< they stand together, after their parent
    std::int32_t word = -1;                       ///< of a leaf
  };

  Kind kind = Kind::kBinary;
  int dimension = 0;                          ///< of kFloat
  int words = 0;                              ///< leaves, numbered 0, 1, ...
  std::vector<Node> nodes;                    ///< [0] is the root
  std::vector<BinaryDescriptor> bit_centres;  ///< of kBinary
  std::vector<float> centres;                 ///< of kFloat, nodes x dimension
  /// log((1 + images) / (1 + images with the word)) over the images it was trained on; by word.
  std::vector<float> idf;

  /// What is wrong with it, in words; nothing if every descent ends at a word, every word is
  /// reached and all numbers are finite.
  std::optional<std::string> problem() const;
};

}  // namespace placegraph
