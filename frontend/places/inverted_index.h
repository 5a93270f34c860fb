#pragma once
#include <placegraph/frontend/places/place_similarity.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// Index of views as bags of visual words.
///
/// Words are weighted by their frequency in a view and by the rarity of views that contain them
/// (tf-idf, Sivic & Zisserman 2003). The similarity of two views is the overlap of their weights: 1
/// - |v - w|_1 / 2 of weights that sum to one, in [0, 1]. Only views that share a word with the
/// query are compared (inverted index).
class InvertedIndex {
 public:
  /// Starts without views. `idf`: a weight per word, used until there are enough views to weight
  /// words by; from then on the weights follow from the views and are computed again whenever the
  /// number of views has doubled.
  explicit InvertedIndex(std::vector<float> idf);

  /// Adds a view and returns its index: 0, 1, ... The words may be in any order, with repetitions;
  /// ArgumentError for an unknown word.
  int add(const std::vector<std::uint32_t>& words);
  /// Returns the views of first..last (cut to the existing ones) with a word in common, best first,
  /// at most `count`.
  std::vector<PlaceSimilarity> query(const std::vector<std::uint32_t>& words, int count, int first,
                                     int last) const;
  int size() const { return static_cast<int>(views_.size()); }

 private:
  struct Weighted {
    std::uint32_t word;
    float weight;
  };
  struct Entry {
    int view;
    float weight;
  };
  using Counts = std::vector<std::pair<std::uint32_t, int>>;
  Counts count(const std::vector<std::uint32_t>& words) const;
  std::vector<Weighted> weigh(const Counts& counts) const;
  void insert(int view);
  void reweigh();

  std::vector<float> idf_;
  std::vector<int> views_with_;  ///< number of views with each word
  std::vector<Counts> views_;
  std::vector<std::vector<Entry>> inverted_;  ///< entries of each word, views ascending
  std::size_t weighed_views_ = 0;
};

}  // namespace placegraph
