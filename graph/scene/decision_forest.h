#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Trees that ask one byte of a row at a time and end in a distribution over classes
/// (Breiman 2001).
struct DecisionForest {
  static constexpr std::uint16_t kLeaf = 0xffff;
  /// Goes on with the next node where row[feature] <= threshold, else with node `other`. A leaf:
  /// feature = kLeaf, `other` its number.
  struct Node {
    std::uint16_t feature = kLeaf;
    std::uint16_t threshold = 0;
    std::uint32_t other = 0;
  };
  int classes = 0, dimension = 0;    ///< of an answer and of a row
  std::vector<std::uint32_t> roots;  ///< one a tree
  std::vector<Node> nodes;
  std::vector<std::uint8_t> leaves;  ///< leaf x classes, 255 = 1

  /// The leaf a row falls into.
  const std::uint8_t* leaf_of(std::uint32_t root, const std::uint8_t* row) const {
    const Node* node = &nodes[root];
    while (node->feature != kLeaf)
      node = row[node->feature] <= node->threshold ? node + 1 : &nodes[node->other];
    return leaves.data() +
           static_cast<std::size_t>(node->other) * static_cast<std::size_t>(classes);
  }

  /// The mean of the trees' answers as shares that sum to 1: `shares`, one a class.
  void predict(const std::uint8_t* row, float* shares) const;

  /// What keeps it from being walked safely: a node that leads back or outside, sizes that do not
  /// agree. Nothing if it is sound.
  std::optional<std::string> problem() const;
};

}  // namespace placegraph
