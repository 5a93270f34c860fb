#pragma once
#include <placegraph/backend/linear/marginalization.h>
#include <placegraph/backend/window/imaging_errors.h>
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

namespace placegraph {

/// Sums over the landmarks beside their normal equations, with each landmark eliminated.
struct ImageSums {
  /// Scores are the gradients of single landmarks by the variables: sum of score score^T. It equals
  /// H if the errors of all observations are independent and as large as stated.
  Eigen::MatrixXd scatter;
  Eigen::Matrix<double, Eigen::Dynamic, ImagingErrors::kParameters> H_errors;  ///< by variables
  ImagingErrors::Matrix information = ImagingErrors::Matrix::Zero();
  ImagingErrors::Vector gradient = ImagingErrors::Vector::Zero();

  explicit ImageSums(Eigen::Index columns = 0)
      : scatter(Eigen::MatrixXd::Zero(columns, columns)),
        H_errors(decltype(H_errors)::Zero(columns, ImagingErrors::kParameters)) {}
};

/// Normal equations of a landmark and of the variables that observe it.
/// `N` is the number of the landmark's directions.
template <int N>
class LandmarkEquations {
 public:
  void clear() {
    views_.clear();
    V_.setZero();
    v_.setZero();
    errors_ = {};
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

  /// Adds the derivative of the residual that was added last by the imaging errors.
  template <int R, int M>
  void add_errors(const Eigen::Matrix<double, R, 1>& r, double w,
                  const Eigen::Matrix<double, R, N>& J_landmark, Eigen::Index column,
                  const Eigen::Matrix<double, R, M>& J,
                  const Eigen::Matrix<double, R, ImagingErrors::kParameters>& J_errors) {
    errors_.H += w * J_errors.transpose() * J_errors;
    errors_.U += w * J_errors.transpose() * J_landmark;
    errors_.b += w * J_errors.transpose() * r;
    if (column >= 0) views_.back().H_errors.template topRows<M>() += w * J.transpose() * J_errors;
  }

  /// H -= W V^-1 W^T, b -= W V^-1 v over the variables that observe the landmark. Directions of the
  /// landmark that its views leave undetermined are left out (floor of rounding size). Adds to
  /// `sums`, if given.
  void eliminate(QuadraticForm& form, ImageSums* sums = nullptr) {
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
    if (sums) add_sums(B, c, *sums);
  }

 private:
  /// `B` and `c` of eliminate(), after which the views have W B instead of W.
  void add_sums(const Eigen::Matrix<double, N, N>& B, const Eigen::Matrix<double, N, 1>& c,
                ImageSums& sums) const {
    std::vector<Vector6d> scores;
    for (const View& view : views_) scores.push_back(view.b - view.W * c);
    const Eigen::Matrix<double, ImagingErrors::kParameters, N> UB = errors_.U * B;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const View& a = views_[i];
      sums.H_errors.middleRows(a.column, a.size) +=
          (a.H_errors - a.W * UB.transpose()).topRows(a.size);
      for (std::size_t j = 0; j < views_.size(); ++j)
        sums.scatter.block(a.column, views_[j].column, a.size, views_[j].size) +=
            scores[i].head(a.size) * scores[j].head(views_[j].size).transpose();
    }
    sums.information += errors_.H - UB * UB.transpose();
    sums.gradient += errors_.b - UB * c;
  }

  /// The blocks of one variable; a plane uses the first three rows only.
  struct View {
    Eigen::Index column = -1, size = 0;
    Matrix6d H = Matrix6d::Zero();
    Eigen::Matrix<double, 6, N> W = Eigen::Matrix<double, 6, N>::Zero();
    Vector6d b = Vector6d::Zero();
    Eigen::Matrix<double, 6, ImagingErrors::kParameters> H_errors =
        Eigen::Matrix<double, 6, ImagingErrors::kParameters>::Zero();
  };
  /// The blocks of the imaging errors.
  struct Errors {
    ImagingErrors::Matrix H = ImagingErrors::Matrix::Zero();
    Eigen::Matrix<double, ImagingErrors::kParameters, N> U =
        Eigen::Matrix<double, ImagingErrors::kParameters, N>::Zero();
    ImagingErrors::Vector b = ImagingErrors::Vector::Zero();
  };

  std::vector<View> views_;
  Eigen::Matrix<double, N, N> V_;
  Eigen::Matrix<double, N, 1> v_;
  Errors errors_;
};

}  // namespace placegraph
