#include <placegraph/backend/linear/elimination_tree.h>
#include <placegraph/backend/linear/front_kernels.h>

#include <algorithm>

// The numbers in the fronts of an EliminationTree: factors, right-hand sides, solutions. How the
// fronts hang together is elimination_tree.cpp's.

namespace placegraph {

/// Puts the front's part of H and the Schur complements of its children into its matrix.
template <int D>
void EliminationTree<D>::assemble(Front& front) {
  const int blocks = front.blocks(), rows = blocks * D;
  pool_.provide(front.matrix, static_cast<std::size_t>(rows) * rows);
  front.rhs.resize(rows);
  double* const matrix = front.matrix.data();
  for (int c = 0; c < rows; ++c)  // the lower blocks; what is above them is never read
    std::fill_n(matrix + static_cast<std::size_t>(c) * rows + c / D * D, rows - c / D * D, 0.0);
  using Stride = Eigen::OuterStride<>;
  const auto at = [&](int row, int column) {
    return Eigen::Map<Block, 0, Stride>(
        matrix + static_cast<std::size_t>(column) * D * rows + row * D, Stride(rows));
  };
  int next = 0;
  for (const int v : front.frontal) variables_[v].local = next++;
  for (const int v : front.separator) variables_[v].local = next++;

  for (const int v : front.frontal) {
    const int column = variables_[v].local;
    auto own = at(column, column);
    own += diagonal(v);
    if (damping_ > 0) own.diagonal().array() += damping_ * variables_[v].diagonal.trace() / D;
    for (const int t : variables_[v].terms) {
      const Term& term = terms_[t];
      if (term.zero || term.b < 0) continue;
      const int other = term.a == v ? term.b : term.a;
      const int row = variables_[other].local;
      if (row <= column) continue;  // not in this front (-1), or this pair's turn was before
      if (term.a == v)
        at(row, column) += term.H_ab.transpose();
      else
        at(row, column) += term.H_ab;
    }
  }
  for (const int c : front.children) {
    const Front& child = fronts_[c];
    const int child_rows = child.blocks() * D;
    const int frontal = static_cast<int>(child.frontal.size());
    const int size = static_cast<int>(child.separator.size());
    for (int j = 0; j < size; ++j) {
      const int column = variables_[child.separator[j]].local;
      for (int i = j; i < size; ++i) {
        const int row = variables_[child.separator[i]].local;
        const Eigen::Map<const Block, 0, Stride> source(
            child.matrix.data() + static_cast<std::size_t>(frontal + j) * D * child_rows +
                (frontal + i) * D,
            Stride(child_rows));
        if (i == j)
          at(row, row).template triangularView<Eigen::Lower>() += source;
        else if (row > column)
          at(row, column) += source;
        else
          at(column, row) += source.transpose();
      }
    }
  }
  for (const int v : front.frontal) variables_[v].local = -1;
  for (const int v : front.separator) variables_[v].local = -1;
}

template <int D>
bool EliminationTree<D>::factorize_stale() {
  std::sort(stale_matrices_.begin(), stale_matrices_.end(),
            [&](int a, int b) { return earlier(a, b); });
  for (const int f : stale_matrices_) {
    Front& front = fronts_[f];
    assemble(front);
    const int frontal = static_cast<int>(front.frontal.size());
    if (!FrontKernels<D>::factorize(front.matrix.data(), front.blocks() * D, frontal * D))
      return false;
    variables_refactored_ += frontal;
  }
  for (const int f : stale_matrices_) fronts_[f].matrix_stale = false;
  stale_matrices_.clear();
  return true;
}

template <int D>
bool EliminationTree<D>::factorize() {
  variables_refactored_ = 0;
  restructure();
  return factorize_stale();
}

template <int D>
void EliminationTree<D>::forward(Front& front) {
  const int frontal = static_cast<int>(front.frontal.size()), blocks = front.blocks();
  Eigen::Map<Eigen::VectorXd> b(front.rhs.data(), blocks * D);
  b.setZero();
  int next = 0;
  for (const int v : front.frontal) {
    b.template segment<D>(next * D) = -variables_[v].gradient;
    variables_[v].local = next++;
  }
  for (const int v : front.separator) variables_[v].local = next++;
  front.decrease = 0;
  for (const int c : front.children) {
    const Front& child = fronts_[c];
    front.decrease += child.decrease;
    const double* source = child.rhs.data() + child.frontal.size() * D;
    for (const int v : child.separator) {
      b.template segment<D>(variables_[v].local * D) += Eigen::Map<const Vector>(source);
      source += D;
    }
  }
  FrontKernels<D>::forward(front.matrix.data(), blocks * D, frontal * D, front.rhs.data());
  front.decrease += b.head(frontal * D).squaredNorm();
  for (const int v : front.frontal) variables_[v].local = -1;
  for (const int v : front.separator) variables_[v].local = -1;
}

template <int D>
double EliminationTree<D>::model_decrease() {
  std::sort(stale_rhs_.begin(), stale_rhs_.end(), [&](int a, int b) { return earlier(a, b); });
  for (const int f : stale_rhs_) {
    forward(fronts_[f]);
    fronts_[f].rhs_stale = false;
  }
  stale_rhs_.clear();
  double decrease = 0;
  for (const int f : roots_) decrease += fronts_[f].decrease;
  return decrease;
}

template <int D>
const std::vector<int>& EliminationTree<D>::solve(double threshold) {
  for (const int v : solved_) {
    variables_[v].delta.setZero();
    variables_[v].significant = false;
  }
  solved_.clear();
  std::vector<int> open(roots_.rbegin(), roots_.rend());
  std::vector<double> x;
  while (!open.empty()) {
    const Front& front = fronts_[open.back()];
    open.pop_back();
    bool moved = front.decrease > threshold;
    for (const int v : front.separator) moved |= variables_[v].significant;
    if (!moved) continue;
    const int frontal = static_cast<int>(front.frontal.size()), blocks = front.blocks();
    x.assign(front.rhs.begin(), front.rhs.end());
    double* separator = x.data() + static_cast<std::size_t>(frontal) * D;
    for (const int v : front.separator)
      separator = std::copy_n(variables_[v].delta.data(), D, separator);
    FrontKernels<D>::backward(front.matrix.data(), blocks * D, frontal * D, x.data());
    bool significant = front.decrease > threshold;
    for (int i = 0; i < frontal; ++i) {
      Variable& v = variables_[front.frontal[i]];
      v.delta = Eigen::Map<const Vector>(&x[i * D]);
      v.significant = v.delta.dot(diagonal(front.frontal[i]) * v.delta) > threshold;
      significant |= v.significant;
    }
    if (!significant) {
      for (const int v : front.frontal) variables_[v].delta.setZero();
      continue;
    }
    solved_.insert(solved_.end(), front.frontal.begin(), front.frontal.end());
    open.insert(open.end(), front.children.rbegin(), front.children.rend());
  }
  return solved_;
}

template <int D>
Eigen::MatrixXd EliminationTree<D>::covariance(const std::vector<int>& variables) const {
  // H X = E: forward from the fronts of the variables up, backward down again; nothing else
  // matters.
  std::vector<int> way;
  for (const int v : variables)
    for (int f = variables_[v].front; f >= 0; f = fronts_[f].parent) way.push_back(f);
  std::sort(way.begin(), way.end(), [&](int a, int b) { return earlier(a, b); });
  way.erase(std::unique(way.begin(), way.end()), way.end());
  std::vector<int> place(variables_.size(), -1), members;
  for (const int f : way)
    for (const int v : fronts_[f].frontal) {
      place[v] = static_cast<int>(members.size());
      members.push_back(v);
    }
  const int count = static_cast<int>(variables.size());
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(members.size() * D, count * D);
  for (int i = 0; i < count; ++i)
    X.template block<D, D>(place[variables[i]] * D, i * D).setIdentity();
  const auto gather_and = [&](const Front& front, Eigen::Index column, auto&& solve) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(front.blocks()) * D);
    int next = 0;
    for (const auto* part : {&front.frontal, &front.separator})
      for (const int v : *part)
        x.template segment<D>(next++ * D) = X.template block<D, 1>(place[v] * D, column);
    solve(front.matrix.data(), front.blocks() * D, static_cast<int>(front.frontal.size()) * D,
          x.data());
    next = 0;
    for (const auto* part : {&front.frontal, &front.separator})
      for (const int v : *part)
        X.template block<D, 1>(place[v] * D, column) = x.template segment<D>(next++ * D);
  };
  for (Eigen::Index column = 0; column < X.cols(); ++column) {
    for (auto f = way.begin(); f != way.end(); ++f)
      gather_and(fronts_[*f], column, FrontKernels<D>::forward);
    for (auto f = way.rbegin(); f != way.rend(); ++f)
      gather_and(fronts_[*f], column, FrontKernels<D>::backward);
  }
  Eigen::MatrixXd covariance(count * D, count * D);
  for (int i = 0; i < count; ++i)
    covariance.middleRows(i * D, D) = X.middleRows(place[variables[i]] * D, D);
  return covariance;
}

#define PLACEGRAPH_INSTANTIATE(D)                                     \
  template bool EliminationTree<D>::factorize();                      \
  template double EliminationTree<D>::model_decrease();               \
  template const std::vector<int>& EliminationTree<D>::solve(double); \
  template Eigen::MatrixXd EliminationTree<D>::covariance(const std::vector<int>&) const;
PLACEGRAPH_INSTANTIATE(3)
PLACEGRAPH_INSTANTIATE(6)
PLACEGRAPH_INSTANTIATE(7)

}  // namespace placegraph
