#include <placegraph/backend/linear/scalar_factor.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cstddef>

namespace placegraph {

using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, std::ptrdiff_t>;

struct ScalarFactor::Impl {
  const BlockPanels& panels;
  Sparse matrix;  // lower part by scalars; its values are those of the panels, in their order
  Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<std::ptrdiff_t>> llt;

  explicit Impl(const BlockPanels& m) : panels(m) {
    const int size = panels.block_size, count = panels.pattern.count();
    matrix.resize(static_cast<Eigen::Index>(count) * size, static_cast<Eigen::Index>(count) * size);
    matrix.resizeNonZeros(static_cast<Eigen::Index>(panels.values.size()));
    std::ptrdiff_t next = 0;
    for (int j = 0; j < count; ++j)
      for (int c = 0; c < size; ++c) {
        matrix.outerIndexPtr()[j * size + c] = next;
        for (int k = panels.pattern.start[j]; k < panels.pattern.start[j + 1]; ++k)
          for (int r = 0; r < size; ++r)
            matrix.innerIndexPtr()[next++] = panels.pattern.row[k] * size + r;
      }
    matrix.outerIndexPtr()[static_cast<std::ptrdiff_t>(count) * size] = next;
    take_values();
    llt.analyzePattern(matrix);
  }
  void take_values() { std::copy(panels.values.begin(), panels.values.end(), matrix.valuePtr()); }
};

ScalarFactor::ScalarFactor(const BlockPanels& matrix) : impl_(std::make_unique<Impl>(matrix)) {}
ScalarFactor::~ScalarFactor() = default;

bool ScalarFactor::factorize() {
  impl_->take_values();
  impl_->llt.factorize(impl_->matrix);
  return impl_->llt.info() == Eigen::Success;
}

void ScalarFactor::solve(Eigen::Ref<Eigen::MatrixXd> x) {
  impl_->llt.matrixL().solveInPlace(x);
  impl_->llt.matrixU().solveInPlace(x);
}

Eigen::VectorXd ScalarFactor::pivots() const {
  const Sparse& L = impl_->llt.matrixL().nestedExpression();
  return L.diagonal();
}

BlockFactor ScalarFactor::blocks() const {
  const Sparse& L = impl_->llt.matrixL().nestedExpression();
  const int size = impl_->panels.block_size, square = size * size;
  BlockFactor blocks;
  std::vector<int> place(static_cast<std::size_t>(impl_->panels.pattern.count()), -1);
  for (int j = 0; j < impl_->panels.pattern.count(); ++j) {
    const auto begin = static_cast<std::ptrdiff_t>(blocks.pattern.row.size());
    blocks.pattern.start.push_back(static_cast<int>(begin));
    for (int c = 0; c < size; ++c)
      for (Sparse::InnerIterator entry(L, j * size + c); entry; ++entry) {
        const int row = static_cast<int>(entry.row()) / size;
        if (place[row] >= begin) continue;
        place[row] = static_cast<int>(begin);
        blocks.pattern.row.push_back(row);
      }
    std::sort(blocks.pattern.row.begin() + begin, blocks.pattern.row.end());
    for (std::size_t k = begin; k < blocks.pattern.row.size(); ++k)
      place[blocks.pattern.row[k]] = static_cast<int>(k);
    blocks.values.resize(blocks.pattern.row.size() * square, 0.0);
    for (int c = 0; c < size; ++c)
      for (Sparse::InnerIterator entry(L, j * size + c); entry; ++entry) {
        const int row = static_cast<int>(entry.row());
        blocks
            .values[static_cast<std::size_t>(place[row / size]) * square + c * size + row % size] =
            entry.value();
      }
  }
  blocks.pattern.start.push_back(static_cast<int>(blocks.pattern.row.size()));
  return blocks;
}

}  // namespace placegraph
