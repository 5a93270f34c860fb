#include <placegraph/backend/linear/fill_factor.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cstddef>

namespace placegraph {
namespace {

using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, std::ptrdiff_t>;

class ScalarFactor : public FillFactor {
 public:
  explicit ScalarFactor(const BlockPanels& m) : panels_(m) {
    const int size = panels_.block_size, count = panels_.pattern.count();
    matrix_.resize(static_cast<Eigen::Index>(count) * size,
                   static_cast<Eigen::Index>(count) * size);
    matrix_.resizeNonZeros(static_cast<Eigen::Index>(panels_.values.size()));
    std::ptrdiff_t next = 0;
    for (int j = 0; j < count; ++j)
      for (int c = 0; c < size; ++c) {
        matrix_.outerIndexPtr()[j * size + c] = next;
        for (int k = panels_.pattern.start[j]; k < panels_.pattern.start[j + 1]; ++k)
          for (int r = 0; r < size; ++r)
            matrix_.innerIndexPtr()[next++] = panels_.pattern.row[k] * size + r;
      }
    matrix_.outerIndexPtr()[static_cast<std::ptrdiff_t>(count) * size] = next;
    take_values();
    llt_.analyzePattern(matrix_);
  }

  bool factorize() override;
  void solve(Eigen::Ref<Eigen::MatrixXd> x) override;
  Eigen::VectorXd pivots() const override;
  BlockFactor blocks() const override;

 private:
  void take_values() {
    std::copy(panels_.values.begin(), panels_.values.end(), matrix_.valuePtr());
  }

  const BlockPanels& panels_;
  Sparse matrix_;  // lower part by scalars; its values are those of the panels, in their order
  Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<std::ptrdiff_t>> llt_;
};

bool ScalarFactor::factorize() {
  take_values();
  llt_.factorize(matrix_);
  return llt_.info() == Eigen::Success;
}

void ScalarFactor::solve(Eigen::Ref<Eigen::MatrixXd> x) {
  llt_.matrixL().solveInPlace(x);
  llt_.matrixU().solveInPlace(x);
}

Eigen::VectorXd ScalarFactor::pivots() const {
  const Sparse& L = llt_.matrixL().nestedExpression();
  return L.diagonal();
}

BlockFactor ScalarFactor::blocks() const {
  const Sparse& L = llt_.matrixL().nestedExpression();
  const int size = panels_.block_size, square = size * size;
  BlockFactor blocks;
  std::vector<int> place(static_cast<std::size_t>(panels_.pattern.count()), -1);
  for (int j = 0; j < panels_.pattern.count(); ++j) {
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

}  // namespace

std::unique_ptr<FillFactor> scalar_factor(const BlockPanels& matrix) {
  return std::make_unique<ScalarFactor>(matrix);
}

}  // namespace placegraph
