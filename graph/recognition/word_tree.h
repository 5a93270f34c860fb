#pragma once
#include <placegraph/graph/measurements/landmark.h>

#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A tree of visual words, as it is trained, saved and looked up.
/// A descent from the root to the nearest child at every level ends at a word. Centres are binary
/// descriptors or vectors of `dimension` numbers, one per node (the root's is unused).
struct WordTree {
  enum class Kind { kBinary, kFloat };
  struct Node {
    std::int32_t first_child = -1, children = 0;  ///< children are consecutive, after their parent
    std::int32_t word = -1;                       ///< word of a leaf
  };

  Kind kind = Kind::kBinary;
  int dimension = 0;                          ///< length of a centre of kFloat
  int words = 0;                              ///< leaves, numbered 0, 1, ...
  std::vector<Node> nodes;                    ///< [0] is the root
  std::vector<BinaryDescriptor> bit_centres;  ///< centres of kBinary
  std::vector<float> centres;                 ///< centres of kFloat, nodes x dimension
  /// log((1 + images) / (1 + images with the word)) over the images it was trained on; by word.
  std::vector<float> idf;

  /// A short description of a fault; nothing if every descent ends at a word, every word is reached
  /// and all numbers are finite.
  std::optional<std::string> problem() const;
};

}  // namespace placegraph
