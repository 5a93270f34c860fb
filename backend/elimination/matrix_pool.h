#pragma once
#include <cstddef>
#include <vector>

namespace placegraph {

/// Reuses the memory of released matrices for new ones.
/// New pages of memory cost more than the sums that are stored in them. The pool keeps no more
/// memory than is in use (plus 0.8 MB).
class MatrixPool {
 public:
  /// Provides `matrix` with memory for `size` doubles: its own if that is sufficient, the smallest
  /// sufficient memory of the pool unless that is more than twice as large, else new memory. Its
  /// content is undefined.
  void provide(std::vector<double>& matrix, std::size_t size);
  /// Takes the memory of `matrix` into the pool; `matrix` is empty then.
  void release(std::vector<double>& matrix);

 private:
  std::vector<std::vector<double>> pool_;  // oldest memory first
  std::size_t pooled_ = 0, used_ = 0;      // numbers of doubles in the pool and in use
};

}  // namespace placegraph
