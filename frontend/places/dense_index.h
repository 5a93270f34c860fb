#pragma once
#include <placegraph/frontend/places/place_similarity.h>

#include <memory>
#include <span>
#include <vector>

namespace placegraph {

/// Index of vectors of unit length for the search of nearest neighbours.
///
/// A range of up to some thousands of vectors is searched completely; for a larger one a graph of
/// neighbours (HNSW, Malkov & Yashunin 2018, by FAISS) is searched, whose cost grows with the
/// logarithm of the number of vectors and which may miss a neighbour occasionally. The graph grows
/// with every vector, without training and without threads; the same input gives the same bits.
class DenseIndex {
 public:
  /// Starts without vectors. `dimension`: length of the vectors. `exact_below`: number of vectors
  /// in a range up to which it is searched completely.
  explicit DenseIndex(int dimension, int exact_below = kExactBelow);
  ~DenseIndex();
  DenseIndex(DenseIndex&&) noexcept;
  DenseIndex& operator=(DenseIndex&&) noexcept;

  /// Adds a vector and returns its index: 0, 1, ... ArgumentError for another dimension.
  int add(std::span<const float> vector);
  /// Returns the `count` vectors of first..last (cut to the existing ones) with the largest inner
  /// product, best first; fewer if many near ones are outside the range.
  std::vector<PlaceSimilarity> query(std::span<const float> vector, int count, int first,
                                     int last) const;
  int size() const;
  int dimension() const { return dimension_; }

  // Fewer views are compared one by one: the cost. Chosen.
  static constexpr int kExactBelow = 5000;

 private:
  struct Graph;
  int dimension_ = 0, exact_below_ = 0;
  std::unique_ptr<Graph> graph_;
};

}  // namespace placegraph
