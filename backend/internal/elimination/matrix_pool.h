#pragma once
#include <cstddef>
#include <vector>

namespace placegraph {

/// Memory of matrices that are gone, for those that come: fresh pages cost more than the sums they
/// are to hold. Keeps no more than is in use (and 0.8 MB).
class MatrixPool {
 public:
  /// Gives `matrix` room for `size` doubles: its own if it has that, the smallest sufficient one of
  /// the pool unless that is more than twice as large, else fresh memory. What it holds is
  /// undefined.
  void provide(std::vector<double>& matrix, std::size_t size);
  /// Takes the memory of `matrix`, which is empty then.
  void release(std::vector<double>& matrix);

 private:
  std::vector<std::vector<double>> pool_;  // the oldest first
  std::size_t pooled_ = 0, used_ = 0;      // doubles in the pool, and given out
};

}  // namespace placegraph
