#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/json_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/transform_file.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

constexpr double kTransformTolerance = 1e-2;  // as that of the poses of a trajectory

Eigen::Isometry3d transform_of_quaternion(const double* v) {
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  require(std::abs(q.norm() - 1) <= kTransformTolerance,
          fmt::format("the quaternion has length {:.6g}, not 1", q.norm()));
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = q.normalized().toRotationMatrix();
  T.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  return T;
}

Eigen::Isometry3d transform_of_matrix(const std::vector<double>& numbers) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    T.matrix()(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = numbers[i];
  require(T.matrix().row(3) == Eigen::RowVector4d(0, 0, 0, 1),
          "the last row of the 4x4 matrix is not 0 0 0 1");
  const Eigen::Matrix3d R = T.linear();
  const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  require(off <= kTransformTolerance && R.determinant() > 0,
          fmt::format("the 3x3 part is not a rotation (R^T R differs from 1 by {:.3g}); a scale is "
                      "a step of its own",
                      off));
  return T;
}

Eigen::Isometry3d transform_of_json(const nlohmann::json& document) {
  std::vector<double> numbers;
  for (const char* key : {"x", "y", "z", "qx", "qy", "qz", "qw"})
    numbers.push_back(document.at(key).get<double>());
  require(document.value("scale", 1.0) == 1.0,
          "its scale is not 1: a scale is a step of its own");
  return transform_of(numbers);
}

}  // namespace

Eigen::Isometry3d transform_of(const std::vector<double>& numbers) {
  for (const double number : numbers) require(std::isfinite(number), "a number is not finite");
  switch (numbers.size()) {
    case 7:
      return transform_of_quaternion(numbers.data());
    case 8:
      return transform_of_quaternion(numbers.data() + 1);
    case 12:
    case 16:
      return transform_of_matrix(numbers);
    default:
      throw ArgumentError(fmt::format(
          "{} numbers are no transform: 7 (x y z qx qy qz qw), 8 (TUM), 12 or 16 (a matrix) are",
          numbers.size()));
  }
}

Eigen::Isometry3d read_transform(const std::string& path) {
  TextFile file(path);
  std::string_view line;
  std::vector<std::string_view> fields;
  std::vector<double> numbers;
  try {
    while (file.next_data(line)) {
      if (numbers.empty() && line.front() == '{') return transform_of_json(read_json(path));
      const std::size_t separator = line.find_first_of(",;");
      if (separator == line.npos)
        split_blank(line, fields);
      else
        split_at(line[separator], line, fields);
      for (const std::string_view field : fields)
        numbers.push_back(file.number(field, "transform"));
    }
    return transform_of(numbers);
  } catch (const ArgumentError& error) {
    throw FileError(path, error.what());
  } catch (const nlohmann::json::exception& error) {
    throw FileError(path, std::string("is no transform with x, y, z, qx, qy, qz, qw: ") +
                              error.what());
  }
}

}  // namespace placegraph
