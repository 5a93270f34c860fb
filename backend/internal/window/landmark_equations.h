#pragma once
#include <placegraph/backend/internal/linear/marginalization.h>
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

namespace placegraph {

/// Normal equations of a landmark and of the variables that observe it.
/// `N` is the number of the landmark's directions.
template <int N>
class LandmarkEquations {
 public:
  void clear() {
    views_.clear();
    V_.setZero();
    v_.setZero();
  }

  /// Adds a residual r with weight w of the landmark and the variable at `column` (-1: constant).
  template <int R, int M>
  void add(const Eigen::Matrix<double, R, 1>& r, double w,
           const Eigen::Matrix<double, R, N>& J_landmark, Eigen::Index column,
           const Eigen::Matrix<double, R, M>& J) {
    V_ += w * J_landmark.transpose() * J_landmark;
    v_ += w * J_landmark.transpose() * r;
    if (column < 0) return;
    if (views_.empty() || views_.back().column != column) {
      views_.emplace_back();
      views_.back().column = column;
      views_.back().size = M;
    }
    View& view = views_.back();
    view.H.template topLeftCorner<M, M>() += w * J.transpose() * J;
    view.W.template topRows<M>() += w * J.transpose() * J_landmark;
    view.b.template head<M>() += w * J.transpose() * r;
  }

  /// H -= W V^-1 W^T, b -= W V^-1 v over the variables that observe the landmark. Directions of the
  /// landmark that its views leave undetermined are left out (floor of rounding size).
  void eliminate(QuadraticForm& form) {
    if (views_.empty()) return;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(V_);
    const auto lambda = eigen.eigenvalues();
    Eigen::Matrix<double, N, N> B = Eigen::Matrix<double, N, N>::Zero();  // V^-1 = B B^T
    for (int k = 0; k < N; ++k)
      if (lambda[k] > 1e-13 * lambda[N - 1])
        B.col(k) = eigen.eigenvectors().col(k) / std::sqrt(lambda[k]);
    const Eigen::Matrix<double, N, 1> c = B.transpose() * v_;
    for (View& view : views_) {
      view.W = (view.W * B).eval();
      form.H.block(view.column, view.column, view.size, view.size) +=
          view.H.topLeftCorner(view.size, view.size);
      form.b.segment(view.column, view.size) += (view.b - view.W * c).head(view.size);
    }
    for (const View& a : views_)
      for (const View& b : views_) {
        const Matrix6d product = a.W * b.W.transpose();
        form.H.block(a.column, b.column, a.size, b.size) -= product.topLeftCorner(a.size, b.size);
      }
  }

 private:
  /// The blocks of one variable; a plane uses the first three rows only.
  struct View {
    Eigen::Index column = -1, size = 0;
    Matrix6d H = Matrix6d::Zero();
    Eigen::Matrix<double, 6, N> W = Eigen::Matrix<double, 6, N>::Zero();
    Vector6d b = Vector6d::Zero();
  };

  std::vector<View> views_;
  Eigen::Matrix<double, N, N> V_;
  Eigen::Matrix<double, N, 1> v_;
};

}  // namespace placegraph
