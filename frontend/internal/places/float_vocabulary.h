#pragma once
#include <placegraph/frontend/internal/places/float_features.h>
#include <placegraph/frontend/internal/places/vocabulary.h>

namespace placegraph {

/// A tree of words that are vectors: hierarchical k-means (Nister & Stewenius 2006), each node's
/// descriptors clustered by k-means++ (OpenCV). Deterministic for a given `random`.
class FloatVocabulary {
 public:
  /// Clusters the rows; throws ArgumentError if there are none.
  static FloatVocabulary train(const FloatDescriptors& descriptors,
                               const VocabularyOptions& options, Random& random);
  FloatVocabulary() = default;
  /// One that was saved. Throws ArgumentError if it is not of vectors or has a problem().
  explicit FloatVocabulary(WordTree tree);

  bool empty() const { return tree_.nodes.empty(); }
  int words() const { return tree_.words; }
  int dimension() const { return tree_.dimension; }
  /// The word [0, words()) at the end of the descent. ArgumentError for another dimension.
  std::uint32_t word(const Eigen::Ref<const Eigen::RowVectorXf>& descriptor) const;
  /// The centres of the deepest level of the tree that has at most `most` of them, by rows; words
  /// that end above it stand for themselves. At least the root's children.
  FloatDescriptors centres(int most) const;
  /// What is to be saved; idf is 1 until it is set.
  const WordTree& tree() const { return tree_; }
  void set_idf(std::vector<float> idf);

 private:
  Eigen::Map<const FloatDescriptors> children(const WordTree::Node& node) const;

  WordTree tree_;
};

}  // namespace placegraph
