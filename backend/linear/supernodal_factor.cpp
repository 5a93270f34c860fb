#include <placegraph/backend/linear/cholmod_workspace.h>
#include <placegraph/backend/linear/fill_factor.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <limits>
#include <new>

namespace placegraph {
namespace {

class SupernodalFactor : public FillFactor {
 public:
  explicit SupernodalFactor(const BlockPanels& m) : panels_(m) {
    const int size = panels_.block_size, count = panels_.pattern.count();
    require(panels_.values.size() < static_cast<std::size_t>(std::numeric_limits<int>::max()),
            "SupernodalFactor: the matrix is too large");
    row_.reserve(panels_.values.size());
    for (int j = 0; j < count; ++j)
      for (int c = 0; c < size; ++c) {
        column_start_.push_back(static_cast<int>(row_.size()));
        for (int k = panels_.pattern.start[j]; k < panels_.pattern.start[j + 1]; ++k)
          for (int r = 0; r < size; ++r) row_.push_back(panels_.pattern.row[k] * size + r);
      }
    column_start_.push_back(static_cast<int>(row_.size()));
    matrix_.nrow = matrix_.ncol = static_cast<std::size_t>(count) * size;
    matrix_.nzmax = row_.size();
    matrix_.p = column_start_.data();
    matrix_.i = row_.data();
    matrix_.x = const_cast<double*>(panels_.values.data());  // CHOLMOD only reads it
    matrix_.stype = -1;
    matrix_.itype = CHOLMOD_INT;
    matrix_.xtype = CHOLMOD_REAL;
    matrix_.dtype = CHOLMOD_DOUBLE;
    matrix_.sorted = matrix_.packed = 1;
    common_->supernodal = CHOLMOD_SUPERNODAL;
    common_->postorder = 0;
    common_->method[0].ordering = CHOLMOD_NATURAL;
    factor_ = cholmod_analyze(&matrix_, common_);
    if (!factor_) throw std::bad_alloc();
  }
  ~SupernodalFactor() override {
    cholmod_free_factor(&factor_, common_);
    for (cholmod_dense** dense : {&rhs_, &x_, &work_y_, &work_e_})
      cholmod_free_dense(dense, common_);
  }

  bool factorize() override;
  void solve(Eigen::Ref<Eigen::MatrixXd> x) override;
  Eigen::VectorXd pivots() const override;
  BlockFactor blocks() const override;

 private:
  const BlockPanels& panels_;
  CholmodWorkspace common_;
  std::vector<int> column_start_, row_;  // the matrix by scalars
  cholmod_sparse matrix_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *rhs_ = nullptr, *x_ = nullptr, *work_y_ = nullptr, *work_e_ = nullptr;
};

bool SupernodalFactor::factorize() {
  cholmod_factorize(&matrix_, factor_, common_);
  const int status = common_->status;
  if (status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (status < CHOLMOD_OK)
    throw ArgumentError("SupernodalFactor: CHOLMOD failed with status " + std::to_string(status));
  return status == CHOLMOD_OK && factor_->minor == factor_->n;
}

void SupernodalFactor::solve(Eigen::Ref<Eigen::MatrixXd> x) {
  const std::size_t rows = static_cast<std::size_t>(x.rows()),
                    columns = static_cast<std::size_t>(x.cols());
  cholmod_dense*& rhs = rhs_;
  if (!rhs || rhs->ncol != columns) {
    cholmod_free_dense(&rhs, common_);
    rhs = cholmod_allocate_dense(rows, columns, rows, CHOLMOD_REAL, common_);
    if (!rhs) throw std::bad_alloc();
  }
  Eigen::Map<Eigen::MatrixXd>(static_cast<double*>(rhs->x), x.rows(), x.cols()) = x;
  if (!cholmod_solve2(CHOLMOD_A, factor_, rhs, nullptr, &x_, nullptr, &work_y_, &work_e_, common_))
    throw std::bad_alloc();
  x = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x_->x), x.rows(), x.cols());
}

Eigen::VectorXd SupernodalFactor::pivots() const {
  const cholmod_factor& factor = *factor_;
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
  const cholmod_factor& factor = *factor_;
  const double* const value = static_cast<const double*>(factor.x);
  const int* const super = static_cast<const int*>(factor.super);
  const int* const first_row = static_cast<const int*>(factor.pi);
  const int* const first_value = static_cast<const int*>(factor.px);
  const int* const row = static_cast<const int*>(factor.s);
  const int size = panels_.block_size, square = size * size;
  BlockFactor blocks;
  // A supernode may begin or end inside a block: columns are taken scalar by scalar.
  std::vector<int> place(static_cast<std::size_t>(panels_.pattern.count()), -1);
  std::size_t s = 0;
  for (int j = 0; j < panels_.pattern.count(); ++j) {
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

}  // namespace

std::unique_ptr<FillFactor> supernodal_factor(const BlockPanels& matrix) {
  return std::make_unique<SupernodalFactor>(matrix);
}

}  // namespace placegraph
