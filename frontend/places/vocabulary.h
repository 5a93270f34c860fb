#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/landmark.h>

#include <cstdint>
#include <vector>

namespace placegraph {

struct VocabularyOptions {
  int branching = 16;
  int depth = 3;  ///< at most branching^depth words
  int iterations = 5;
  void check() const;
};
void visit(OptionVisitor& field, VocabularyOptions& options);

/// A tree of binary words: hierarchical k-majority clustering (Nister & Stewenius 2006;
/// Galvez-Lopez & Tardos 2012). Deterministic for a given `random`.
class Vocabulary {
 public:
  /// Clusters the descriptors; throws ArgumentError if there are none.
  static Vocabulary train(const std::vector<BinaryDescriptor>& descriptors,
                          const VocabularyOptions& options, Random& random);

  bool empty() const { return nodes_.empty(); }
  int words() const { return words_; }
  /// The word [0, words()) of a descriptor.
  std::uint32_t word(const BinaryDescriptor& descriptor) const;

 private:
  struct Node {
    BinaryDescriptor centre{};
    int first_child = -1, children = 0;
    std::int32_t word = -1;  // of a leaf
  };
  std::vector<Node> nodes_;  // [0] is the root
  int words_ = 0;
};

}  // namespace placegraph
