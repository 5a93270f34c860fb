#include <placegraph/backend/linear/cholmod_workspace.h>
#include <placegraph/backend/linear/supernodal_factor.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <limits>
#include <new>

namespace placegraph {

struct SupernodalFactor::Impl {
  const BlockPanels& panels;
  CholmodWorkspace common;
  std::vector<int> column_start, row;  // the matrix by scalars
  cholmod_sparse matrix{};
  cholmod_factor* factor = nullptr;
  cholmod_dense *rhs = nullptr, *x = nullptr, *work_y = nullptr, *work_e = nullptr;

  explicit Impl(const BlockPanels& m) : panels(m) {
    const int size = panels.block_size, count = panels.pattern.count();
    require(panels.values.size() < static_cast<std::size_t>(std::numeric_limits<int>::max()),
            "SupernodalFactor: the matrix is too large");
    row.reserve(panels.values.size());
    for (int j = 0; j < count; ++j)
      for (int c = 0; c < size; ++c) {
        column_start.push_back(static_cast<int>(row.size()));
        for (int k = panels.pattern.start[j]; k < panels.pattern.start[j + 1]; ++k)
          for (int r = 0; r < size; ++r) row.push_back(panels.pattern.row[k] * size + r);
      }
    column_start.push_back(static_cast<int>(row.size()));
    matrix.nrow = matrix.ncol = static_cast<std::size_t>(count) * size;
    matrix.nzmax = row.size();
    matrix.p = column_start.data();
    matrix.i = row.data();
    matrix.x = const_cast<double*>(panels.values.data());  // CHOLMOD only reads it
    matrix.stype = -1;
    matrix.itype = CHOLMOD_INT;
    matrix.xtype = CHOLMOD_REAL;
    matrix.dtype = CHOLMOD_DOUBLE;
    matrix.sorted = matrix.packed = 1;
    common->supernodal = CHOLMOD_SUPERNODAL;
    common->postorder = 0;
    common->method[0].ordering = CHOLMOD_NATURAL;
    factor = cholmod_analyze(&matrix, common);
    if (!factor) throw std::bad_alloc();
  }
  ~Impl() {
    cholmod_free_factor(&factor, common);
    for (cholmod_dense** dense : {&rhs, &x, &work_y, &work_e}) cholmod_free_dense(dense, common);
  }
};

SupernodalFactor::SupernodalFactor(const BlockPanels& matrix)
    : impl_(std::make_unique<Impl>(matrix)) {}
SupernodalFactor::~SupernodalFactor() = default;

bool SupernodalFactor::factorize() {
  cholmod_factorize(&impl_->matrix, impl_->factor, impl_->common);
  const int status = impl_->common->status;
  if (status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status < CHOLMOD_OK)
    throw ArgumentError("SupernodalFactor: CHOLMOD failed with status " + std::to_string(status));
  return status == CHOLMOD_OK && impl_->factor->minor == impl_->factor->n;
}

void SupernodalFactor::solve(Eigen::Ref<Eigen::MatrixXd> x) {
  const std::size_t rows = static_cast<std::size_t>(x.rows()),
                    columns = static_cast<std::size_t>(x.cols());
  cholmod_dense*& rhs = impl_->rhs;
  if (!rhs || rhs->ncol != columns) {
    cholmod_free_dense(&rhs, impl_->common);
    rhs = cholmod_allocate_dense(rows, columns, rows, CHOLMOD_REAL, impl_->common);
    if (!rhs) throw std::bad_alloc();
  }
  Eigen::Map<Eigen::MatrixXd>(static_cast<double*>(rhs->x), x.rows(), x.cols()) = x;
  if (!cholmod_solve2(CHOLMOD_A, impl_->factor, rhs, nullptr, &impl_->x, nullptr, &impl_->work_y,
                      &impl_->work_e, impl_->common))
    throw std::bad_alloc();
  x = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(impl_->x->x), x.rows(),
                                        x.cols());
}

Eigen::VectorXd SupernodalFactor::pivots() const {
  const cholmod_factor& factor = *impl_->factor;
  const double* const value = static_cast<const double*>(factor.x);
  const int* const super = static_cast<const int*>(factor.super);
  const int* const first_row = static_cast<const int*>(factor.pi);
  const int* const first_value = static_cast<const int*>(factor.px);
  Eigen::VectorXd pivots(static_cast<Eigen::Index>(factor.n));
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const std::ptrdiff_t rows = first_row[s + 1] - first_row[s];
    for (int c = super[s]; c < super[s + 1]; ++c)
      pivots[c] = value[first_value[s] + (c - super[s]) * (rows + 1)];
  }
  return pivots;
}

BlockFactor SupernodalFactor::blocks() const {
  const cholmod_factor& factor = *impl_->factor;
  const double* const value = static_cast<const double*>(factor.x);
  const int* const super = static_cast<const int*>(factor.super);
  const int* const first_row = static_cast<const int*>(factor.pi);
  const int* const first_value = static_cast<const int*>(factor.px);
  const int* const row = static_cast<const int*>(factor.s);
  const int size = impl_->panels.block_size, square = size * size;
  BlockFactor blocks;
  // A supernode may begin or end inside a block: columns are taken scalar by scalar.
  std::vector<int> place(static_cast<std::size_t>(impl_->panels.pattern.count()), -1);
  std::size_t s = 0;
  for (int j = 0; j < impl_->panels.pattern.count(); ++j) {
    const int begin = static_cast<int>(blocks.pattern.row.size());
    blocks.pattern.start.push_back(begin);
    const std::size_t first_super = s;
    for (const bool filling : {false, true}) {
      s = first_super;
      for (int c = 0; c < size; ++c) {
        const int column = j * size + c;
        while (super[s + 1] <= column) ++s;
        const int rows = first_row[s + 1] - first_row[s], inside = column - super[s];
        for (int k = inside; k < rows; ++k) {
          const int i = row[first_row[s] + k];
          if (!filling) {
            if (place[i / size] >= begin) continue;
            place[i / size] = begin;
            blocks.pattern.row.push_back(i / size);
          } else {
            blocks
                .values[static_cast<std::size_t>(place[i / size]) * square + c * size + i % size] =
                value[first_value[s] + inside * rows + k];
          }
        }
      }
      if (filling) break;
      std::sort(blocks.pattern.row.begin() + begin, blocks.pattern.row.end());
      for (std::size_t k = begin; k < blocks.pattern.row.size(); ++k)
        place[blocks.pattern.row[k]] = static_cast<int>(k);
      blocks.values.resize(blocks.pattern.row.size() * square, 0.0);
    }
  }
  blocks.pattern.start.push_back(static_cast<int>(blocks.pattern.row.size()));
  return blocks;
}

}  // namespace placegraph
