#include <placegraph/backend/elimination/front_assembly.h>
#include <placegraph/backend/elimination/front_kernels.h>

#include <algorithm>

namespace placegraph {

namespace {

/// Sets the position of each variable in the front, the frontal ones first; all others keep -1.
template <int D>
class Places {
 public:
  Places(FrontForest<D>& forest, const typename FrontForest<D>::Front& front)
      : forest_(forest), front_(front) {
    int next = 0;
    for (const int v : front.frontal) forest.variables[v].local = next++;
    for (const int v : front.separator) forest.variables[v].local = next++;
  }
  ~Places() {
    for (const int v : front_.frontal) forest_.variables[v].local = -1;
    for (const int v : front_.separator) forest_.variables[v].local = -1;
  }
  Places(const Places&) = delete;
  Places& operator=(const Places&) = delete;

 private:
  FrontForest<D>& forest_;
  const typename FrontForest<D>::Front& front_;
};

/// The block of a front's matrix at a row and column of blocks.
template <int D>
class Blocks {
 public:
  using Stride = Eigen::OuterStride<>;
  using Map = Eigen::Map<Eigen::Matrix<double, D, D>, 0, Stride>;
  Blocks(double* matrix, int rows) : matrix_(matrix), rows_(rows) {}
  Map operator()(int row, int column) const {
    return Map(matrix_ + static_cast<std::size_t>(column) * D * rows_ + row * D, Stride(rows_));
  }

 private:
  double* matrix_;
  int rows_;
};

/// Adds the terms of H between the frontal variables and all variables of the front.
template <int D>
void add_terms(FrontForest<D>& forest, const typename FrontForest<D>::Front& front, double damping,
               const Blocks<D>& at) {
  for (const int v : front.frontal) {
    const int column = forest.variables[v].local;
    auto own = at(column, column);
    own += forest.diagonal(v);
    if (damping > 0) own.diagonal().array() += damping * forest.variables[v].diagonal.trace() / D;
    for (const int t : forest.variables[v].terms) {
      const auto& term = forest.terms[t];
      if (term.zero || term.b < 0) continue;
      const int other = term.a == v ? term.b : term.a;
      const int row = forest.variables[other].local;
      if (row <= column) continue;  // not in this front (-1), or added already
      if (term.a == v)
        at(row, column) += term.H_ab.transpose();
      else
        at(row, column) += term.H_ab;
    }
  }
}

template <int D>
void add_schur_complement(const FrontForest<D>& forest, typename FrontForest<D>::Front& child,
                          const Blocks<D>& at) {
  const Blocks<D> source(child.matrix.data(), child.blocks() * D);
  const int frontal = static_cast<int>(child.frontal.size());
  const int size = static_cast<int>(child.separator.size());
  for (int j = 0; j < size; ++j) {
    const int column = forest.variables[child.separator[j]].local;
    for (int i = j; i < size; ++i) {
      const int row = forest.variables[child.separator[i]].local;
      const auto block = source(frontal + i, frontal + j);
      if (i == j)
        at(row, row).template triangularView<Eigen::Lower>() += block;
      else if (row > column)
        at(row, column) += block;
      else
        at(column, row) += block.transpose();
    }
  }
}

}  // namespace

template <int D>
void assemble(FrontForest<D>& forest, typename FrontForest<D>::Front& front, double damping,
              MatrixPool& pool) {
  const int rows = front.blocks() * D;
  pool.provide(front.matrix, static_cast<std::size_t>(rows) * rows);
  front.rhs.resize(rows);
  double* const matrix = front.matrix.data();
  for (int c = 0; c < rows; ++c)  // the lower blocks; the upper ones are never read
    std::fill_n(matrix + static_cast<std::size_t>(c) * rows + c / D * D, rows - c / D * D, 0.0);
  const Places<D> places(forest, front);
  const Blocks<D> at(matrix, rows);
  add_terms<D>(forest, front, damping, at);
  for (const int c : front.children) add_schur_complement<D>(forest, forest.fronts[c], at);
}

template <int D>
void substitute_forward(FrontForest<D>& forest, typename FrontForest<D>::Front& front) {
  using Vector = typename FrontForest<D>::Vector;
  const int frontal = static_cast<int>(front.frontal.size()), blocks = front.blocks();
  Eigen::Map<Eigen::VectorXd> b(front.rhs.data(), blocks * D);
  b.setZero();
  const Places<D> places(forest, front);
  for (int i = 0; i < frontal; ++i)
    b.template segment<D>(i * D) = -forest.variables[front.frontal[i]].gradient;
  front.decrease = 0;
  for (const int c : front.children) {
    const auto& child = forest.fronts[c];
    front.decrease += child.decrease;
    const double* source = child.rhs.data() + child.frontal.size() * D;
    for (const int v : child.separator) {
      b.template segment<D>(forest.variables[v].local * D) += Eigen::Map<const Vector>(source);
      source += D;
    }
  }
  FrontKernels<D>::forward(front.matrix.data(), blocks * D, frontal * D, front.rhs.data());
  front.decrease += b.head(frontal * D).squaredNorm();
}

#define PLACEGRAPH_INSTANTIATE(D)                                                       \
  template void assemble(FrontForest<D>&, FrontForest<D>::Front&, double, MatrixPool&); \
  template void substitute_forward(FrontForest<D>&, FrontForest<D>::Front&);
PLACEGRAPH_INSTANTIATE(3)
PLACEGRAPH_INSTANTIATE(6)
PLACEGRAPH_INSTANTIATE(7)

}  // namespace placegraph
