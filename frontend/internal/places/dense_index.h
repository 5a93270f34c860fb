#pragma once
#include <placegraph/frontend/places/place_similarity.h>

#include <memory>
#include <span>
#include <vector>

namespace placegraph {

/// Vectors of unit length and which of them are nearest to another. Up to some thousands in
/// question all are looked at; beyond, a graph of neighbours (HNSW, Malkov & Yashunin 2018, by
/// FAISS) is followed, whose cost grows with the logarithm of their number and which may miss one
/// now and then. It grows with every vector: nothing is trained, no thread started, same bits.
class DenseIndex {
 public:
  /// `dimension`: of the vectors. `exact_below`: so many views in question are all looked at.
  explicit DenseIndex(int dimension, int exact_below = kExactBelow);
  ~DenseIndex();
  DenseIndex(DenseIndex&&) noexcept;
  DenseIndex& operator=(DenseIndex&&) noexcept;

  /// The index of the new vector: 0, 1, ... ArgumentError for another dimension.
  int add(std::span<const float> vector);
  /// The `count` of first..last (cut to those there are) with the largest inner product, best
  /// first; fewer where many near ones lie outside.
  std::vector<PlaceSimilarity> query(std::span<const float> vector, int count, int first,
                                     int last) const;
  int size() const;
  int dimension() const { return dimension_; }

  static constexpr int kExactBelow = 5000;

 private:
  struct Graph;
  int dimension_ = 0, exact_below_ = 0;
  std::unique_ptr<Graph> graph_;
};

}  // namespace placegraph
