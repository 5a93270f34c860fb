#pragma once
#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace placegraph {

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

/// A vector as a list of its numbers.
inline nlohmann::json numbers_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace placegraph
