#pragma once
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/recognition/word_tree.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// Tree of binary words by hierarchical k-majority clustering (Nister & Stewenius 2006).
///
/// See also Galvez-Lopez & Tardos 2012. Deterministic for a given `random`.
class Vocabulary {
 public:
  /// Clusters the descriptors; throws ArgumentError if there are none.
  static Vocabulary train(const std::vector<BinaryDescriptor>& descriptors,
                          const VocabularyOptions& options, Random& random);

  Vocabulary() = default;
  /// Loads a saved vocabulary. Throws ArgumentError if its words are not binary or it has a
  /// problem().
  explicit Vocabulary(WordTree tree);

  bool empty() const { return tree_.nodes.empty(); }
  int words() const { return tree_.words; }
  /// Word of a descriptor, in [0, words()).
  std::uint32_t word(const BinaryDescriptor& descriptor) const;
  /// Tree for a file; idf is 1 until it is set.
  const WordTree& tree() const { return tree_; }
  void set_idf(std::vector<float> idf);

 private:
  WordTree tree_;
};

}  // namespace placegraph
