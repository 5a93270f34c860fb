#pragma once
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/internal/core/random.h>
#include <placegraph/graph/internal/word_tree.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// A tree of binary words: hierarchical k-majority clustering (Nister & Stewenius 2006;
/// Galvez-Lopez & Tardos 2012). Deterministic for a given `random`.
class Vocabulary {
 public:
  /// Clusters the descriptors; throws ArgumentError if there are none.
  static Vocabulary train(const std::vector<BinaryDescriptor>& descriptors,
                          const VocabularyOptions& options, Random& random);

  Vocabulary() = default;
  /// One that was saved. Throws ArgumentError if it is not of binary words or has a problem().
  explicit Vocabulary(WordTree tree);

  bool empty() const { return tree_.nodes.empty(); }
  int words() const { return tree_.words; }
  /// The word [0, words()) of a descriptor.
  std::uint32_t word(const BinaryDescriptor& descriptor) const;
  /// What is to be saved; idf is 1 until it is set.
  const WordTree& tree() const { return tree_; }
  void set_idf(std::vector<float> idf);

 private:
  WordTree tree_;
};

}  // namespace placegraph
