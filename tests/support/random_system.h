#pragma once
#include <Eigen/Dense>
#include <random>
#include <vector>

namespace placegraph {

/// A random quadratic form over variables of three rows each, as terms over one or two of them and
/// as one dense matrix H with gradient g.
struct RandomSystem {
  struct Term {
    int a, b;  ///< b = -1: over a alone
    Eigen::Matrix<double, 6, 6> H;
    Eigen::Matrix3d aa() const { return H.topLeftCorner<3, 3>(); }
    Eigen::Matrix3d ab() const { return H.topRightCorner<3, 3>(); }
    Eigen::Matrix3d bb() const { return H.bottomRightCorner<3, 3>(); }
  };

  explicit RandomSystem(unsigned seed) : random(seed) {}

  double number() { return std::normal_distribution<double>()(random); }

  int add_variable() {
    gradients.push_back(Eigen::Vector3d::NullaryExpr([&](Eigen::Index) { return number(); }));
    return static_cast<int>(gradients.size()) - 1;
  }

  /// Positive definite over its variables.
  const Term& add_term(int a, int b) {
    terms.push_back({a, b, Eigen::Matrix<double, 6, 6>::Zero()});
    redraw(terms.back());
    return terms.back();
  }
  void redraw(Term& term) {
    const Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::NullaryExpr(
        [&](Eigen::Index, Eigen::Index) { return number(); });
    term.H = J.transpose() * J + Eigen::Matrix<double, 6, 6>::Identity();
  }

  Eigen::MatrixXd H(double damping = 0) const {
    const Eigen::Index rows = static_cast<Eigen::Index>(gradients.size()) * 3;
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(rows, rows);
    for (const Term& term : terms) {
      sum.block<3, 3>(3 * term.a, 3 * term.a) += term.aa();
      if (term.b < 0) continue;
      sum.block<3, 3>(3 * term.b, 3 * term.b) += term.bb();
      sum.block<3, 3>(3 * term.a, 3 * term.b) += term.ab();
      sum.block<3, 3>(3 * term.b, 3 * term.a) += term.ab().transpose();
    }
    for (Eigen::Index v = 0; v < rows; v += 3) {
      const double mean = sum.diagonal().segment<3>(v).mean();
      sum.diagonal().segment<3>(v).array() += damping * mean;
    }
    return sum;
  }
  Eigen::VectorXd g() const {
    Eigen::VectorXd all(3 * gradients.size());
    for (std::size_t v = 0; v < gradients.size(); ++v) all.segment<3>(3 * v) = gradients[v];
    return all;
  }

  std::mt19937 random;
  std::vector<Eigen::Vector3d> gradients;
  std::vector<Term> terms;
};

}  // namespace placegraph
