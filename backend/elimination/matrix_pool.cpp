#include <placegraph/backend/elimination/matrix_pool.h>

#include <utility>

namespace placegraph {

void MatrixPool::provide(std::vector<double>& matrix, std::size_t size) {
  if (matrix.capacity() < size) {
    auto best = pool_.end();
    for (auto it = pool_.begin(); it != pool_.end(); ++it)
      if (it->capacity() >= size && it->capacity() <= 2 * size &&
          (best == pool_.end() || it->capacity() < best->capacity()))
        best = it;
    used_ -= matrix.capacity();
    if (best != pool_.end()) {
      matrix = std::move(*best);
      pool_.erase(best);
      pooled_ -= matrix.capacity();
    } else {
      matrix = std::vector<double>(size);
    }
    used_ += matrix.capacity();
  }
  matrix.resize(size);
}

void MatrixPool::release(std::vector<double>& matrix) {
  constexpr std::size_t kSlack = 100000;
  used_ -= matrix.capacity();
  pooled_ += matrix.capacity();
  pool_.push_back(std::exchange(matrix, {}));
  while (pooled_ > used_ + kSlack && !pool_.empty()) {
    pooled_ -= pool_.front().capacity();
    pool_.erase(pool_.begin());
  }
}

}  // namespace placegraph
