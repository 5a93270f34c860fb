#include "python/src/frontend/functions.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>

namespace placegraph::python {
namespace {

template <int kSize>
std::vector<Eigen::Matrix<double, kSize, 1>> points_of(const ArrayView<double>& rows) {
  std::vector<Eigen::Matrix<double, kSize, 1>> points;
  points.reserve(rows.shape(0));
  for (std::size_t i = 0; i < rows.shape(0); ++i)
    points.emplace_back(Eigen::Map<const Eigen::Matrix<double, kSize, 1>>(rows.data() + kSize * i));
  return points;
}

}  // namespace

Image PictureArgument::get(const char* argument) const {
  return nb::hasattr(value, "ndim") && nb::cast<int>(value.attr("ndim")) == 3
             ? colour_image(value, argument)
             : grey_image(value, argument);
}

std::vector<Eigen::Vector2d> points_2d(const ArrayArgument<double>& array, const char* argument) {
  return points_of<2>(array.get(argument, {kAny, 2}));
}

std::vector<Eigen::Vector3d> points_3d(const ArrayArgument<double>& array, const char* argument,
                                       Values values) {
  return points_of<3>(array.get(argument, {kAny, 3}, values));
}

Eigen::Matrix3d matrix_3x3(const ArrayArgument<double>& array, const char* argument) {
  const ArrayView<double> rows = array.get(argument, {3, 3});
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
}

Eigen::Vector3d vector_3(const ArrayArgument<double>& array, const char* argument) {
  const ArrayView<double> values = array.get(argument, {3});
  return Eigen::Map<const Eigen::Vector3d>(values.data());
}

Eigen::Vector3d direction_3(const ArrayArgument<double>& array, const char* argument) {
  const Eigen::Vector3d vector = vector_3(array, argument);
  require(vector.norm() > 1e-9, fmt::format("{}: a direction needs a length", argument));
  return vector.normalized();
}

void require_same_rows(std::size_t rows, std::size_t wanted, const char* argument,
                       const char* other) {
  require(rows == wanted, fmt::format("{}: {} rows, and {} has {}", argument, rows, other, wanted));
}

}  // namespace placegraph::python
