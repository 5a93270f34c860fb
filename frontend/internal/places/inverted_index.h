#pragma once
#include <placegraph/frontend/places/place_similarity.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// Views as bags of visual words. Words are weighed by how often they are in a view and by how few
/// views have them (tf-idf, Sivic & Zisserman 2003), and two views are as alike as their weights
/// overlap: 1 - |v - w|_1 / 2 of weights that sum to one, in [0, 1]. Only views that share a word
/// with the query are looked at (inverted index).
class InvertedIndex {
 public:
  /// `idf`: a weight per word, which holds until views enough have been seen to weigh words by;
  /// from then on it follows what was seen, taken anew whenever the views have doubled.
  explicit InvertedIndex(std::vector<float> idf);

  /// The index of the new view: 0, 1, ... Words in any order, with repetitions; ArgumentError for
  /// one that there is not.
  int add(const std::vector<std::uint32_t>& words);
  /// Views of first..last (cut to those there are) with a word in common, best first, at most
  /// `count`.
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
  std::vector<int> views_with_;  ///< by word
  std::vector<Counts> views_;
  std::vector<std::vector<Entry>> inverted_;  ///< by word, views ascending
  std::size_t weighed_views_ = 0;
};

}  // namespace placegraph
