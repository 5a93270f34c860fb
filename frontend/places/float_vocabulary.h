#pragma once
#include <placegraph/frontend/places/float_features.h>
#include <placegraph/frontend/places/vocabulary.h>

namespace placegraph {

/// Tree of visual words that are vectors: hierarchical k-means (Nister & Stewenius 2006).
///
/// The descriptors of each node are clustered by k-means++ (OpenCV). Deterministic for a given
/// `random`.
class FloatVocabulary {
 public:
  /// Clusters the rows; throws ArgumentError if there are none.
  static FloatVocabulary train(const FloatDescriptors& descriptors,
                               const VocabularyOptions& options, Random& random);
  FloatVocabulary() = default;
  /// Loads a saved vocabulary. Throws ArgumentError if its words are not vectors or it has a
  /// problem().
  explicit FloatVocabulary(WordTree tree);

  bool empty() const { return tree_.nodes.empty(); }
  int words() const { return tree_.words; }
  int dimension() const { return tree_.dimension; }
  /// Word in [0, words()) at the end of the descent. ArgumentError for another dimension.
  std::uint32_t word(const Eigen::Ref<const Eigen::RowVectorXf>& descriptor) const;
  /// Centres, as rows, of the deepest level of the tree that has at most `most` of them; a word
  /// above this level is included itself. The result has at least the root's children.
  FloatDescriptors centres(int most) const;
  /// Tree for a file; idf is 1 until it is set.
  const WordTree& tree() const { return tree_; }
  void set_idf(std::vector<float> idf);

 private:
  Eigen::Map<const FloatDescriptors> children(const WordTree::Node& node) const;

  WordTree tree_;
};

}  // namespace placegraph
