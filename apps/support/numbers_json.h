#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <vector>

namespace placegraph::apps {

/// A matrix as a list of its rows, each a list of numbers.
template <class Matrix>
nlohmann::ordered_json rows_json(const Eigen::MatrixBase<Matrix>& matrix) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    nlohmann::ordered_json row = nlohmann::ordered_json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

/// Elements of a matrix row by row, or of a vector.
template <class Matrix>
std::vector<double> numbers(const Eigen::MatrixBase<Matrix>& matrix) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) values.push_back(matrix(i, j));
  return values;
}

/// {"position_m": [x, y, z], "quaternion_xyzw": [x, y, z, w]}.
inline nlohmann::json pose_json(const SE3& T) {
  const Eigen::Quaterniond q = T.rotation().quaternion();
  return {{"position_m", numbers(T.translation())}, {"quaternion_xyzw", numbers(q.coeffs())}};
}

}  // namespace placegraph::apps
