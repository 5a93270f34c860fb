#include "python/src/backend/graphs.h"
#include "python/src/warnings.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace placegraph::python {
namespace {

/// The information matrix of an argument, symmetric and positive semi-definite.
Eigen::MatrixXd information_of(nb::handle value, int rows) {
  const auto array = ArrayArgument<double>{nb::borrow(value)}.get("information", {rows, rows});
  const Eigen::MatrixXd matrix = Eigen::Map<const Eigen::MatrixXd>(array.data(), rows, rows);
  const double largest = matrix.cwiseAbs().maxCoeff();
  require(largest > 0, "information: all values are zero");
  require((matrix - matrix.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * largest,
          "information: the matrix is not symmetric");
  return matrix;
}

/// The pose of a matrix of 3 x 3 or 4 x 4 numbers; throws ArgumentError, which names it.
Pose pose_of_matrix(const double* first, std::size_t size, const std::string& name) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto n = static_cast<Eigen::Index>(size);
  const Eigen::Map<const RowMajor> matrix(first, n, n);
  Eigen::VectorXd last = matrix.row(n - 1).transpose();
  last[n - 1] -= 1;
  require(last.cwiseAbs().maxCoeff() < 1e-9, name + ": the last row of the matrix is not 0 .. 0 1");
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner(n - 1, n - 1) = matrix.topLeftCorner(n - 1, n - 1);
  try {
    const SO3 rotation = SO3::from_matrix(R);
    if (n == 4) return SE3(rotation, Eigen::Vector3d(matrix.topRightCorner<3, 1>()));
    return SE2(matrix(0, 2), matrix(1, 2), rotation.log()[2]);
  } catch (const ArgumentError& error) {
    throw ArgumentError(name + ": " + error.what());
  }
}

}  // namespace

std::size_t row_width(PoseKind kind) {
  return kind == PoseKind::kSE2 ? 3 : kind == PoseKind::kSE3 ? 7 : 8;
}

Pose pose_of_row(const double* row, std::size_t width, const std::string& name) {
  const auto need = [&](bool condition, const char* what) { require(condition, name + what); };
  for (std::size_t i = 0; i < width; ++i) need(std::isfinite(row[i]), " is not finite");
  if (width == 3) return SE2(row[0], row[1], row[2]);
  const Eigen::Quaterniond q(row[6], row[3], row[4], row[5]);
  need(std::abs(q.norm() - 1) < 1e-2, " has a quaternion that is not of unit length");
  const Eigen::Vector3d t(row[0], row[1], row[2]);
  if (width == 7) return SE3(SO3(q), t);
  need(row[7] > 0, " has a scale that is not positive");
  return Sim3(SO3(q), t, row[7]);
}

void append_row(const Pose& pose, std::vector<double>& values) {
  if (const SE2* T = std::get_if<SE2>(&pose)) {
    values.insert(values.end(),
                  {T->translation().x(), T->translation().y(), T->rotation().angle()});
    return;
  }
  const SE3* rigid = std::get_if<SE3>(&pose);
  const Sim3* similar = std::get_if<Sim3>(&pose);
  const Eigen::Vector3d& t = rigid ? rigid->translation() : similar->translation();
  const Eigen::Quaterniond& q =
      rigid ? rigid->rotation().quaternion() : similar->rotation().quaternion();
  values.insert(values.end(), {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()});
  if (similar) values.push_back(similar->scale());
}

std::vector<Pose> poses_of(const ArrayArgument<double>& array, const char* argument, int count) {
  const std::vector<std::size_t> shape = shape_of(array.value);
  const std::string n = count == kAny ? "N" : std::to_string(count);
  const std::string form = fmt::format(
      "{0} x 3 (SE(2)), {0} x 7 (SE(3)) or {0} x 8 (Sim(3)), or matrices, {0} x 3 x 3 or "
      "{0} x 4 x 4",
      n);
  std::vector<int> wanted = {count, 7};
  if (shape.size() == 3)
    wanted = {count, shape[1] == 3 ? 3 : 4, shape[1] == 3 ? 3 : 4};
  else if (shape.size() == 2 && (shape[0] == 0 || shape[1] == 3 || shape[1] == 8))
    wanted[1] = static_cast<int>(shape[1]);
  const auto rows = array.get(argument, wanted, Values::kFinite, form);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < rows.shape(0); ++i) {
    const std::string name = fmt::format("{}: row {}", argument, i);
    const auto width = static_cast<std::size_t>(wanted[1]);
    poses.push_back(shape.size() == 3 ? pose_of_matrix(rows.data() + i * width * width, width, name)
                                      : pose_of_row(rows.data() + i * width, width, name));
  }
  return poses;
}

Pose pose_of(nb::handle value, const char* argument) {
  if (nb::isinstance<SE2>(value)) return nb::cast<SE2>(value);
  if (nb::isinstance<SE3>(value)) return nb::cast<SE3>(value);
  if (nb::isinstance<Sim3>(value)) return nb::cast<Sim3>(value);
  const ArrayArgument<double> array{nb::borrow(value)};
  const std::vector<std::size_t> shape = shape_of(value);
  constexpr const char* kForm = "a row of 3, 7 or 8 numbers or a matrix, 3 x 3 or 4 x 4";
  if (shape.size() == 2) {
    const int size = shape[0] == 3 ? 3 : 4;
    const auto matrix = array.get(argument, {size, size}, Values::kFinite, kForm);
    return pose_of_matrix(matrix.data(), matrix.shape(0), argument);
  }
  const auto row = array.get(argument, {kAny}, Values::kFinite, kForm);
  require(row.shape(0) == 3 || row.shape(0) == 7 || row.shape(0) == 8,
          fmt::format("{}: an SE2, SE3 or Sim3, a row of 3, 7 or 8 numbers or a matrix, 3 x 3 or "
                      "4 x 4, is needed",
                      argument));
  return pose_of_row(row.data(), row.shape(0), argument);
}

RotationError rotation_error_of(const std::string& name) {
  require(name == "log" || name == "quaternion",
          "rotation_error: 'log' or 'quaternion' is needed, not '" + name + "'");
  return name == "log" ? RotationError::kLog : RotationError::kQuaternion;
}

LogSink steps_to(nb::handle on_step) {
  if (on_step.is_none()) return python_warnings();
  return [on_step](LogLevel level, const std::string& message) {
    const nb::gil_scoped_acquire gil;
    if (level == LogLevel::kWarning)
      warn(message);
    else
      on_step(message);
  };
}

Eigen::MatrixXd whitening_of(nb::handle sigma, nb::handle information, int rows) {
  require(sigma.is_none() != information.is_none(),
          "sigma, information: exactly one of them is needed");
  if (!sigma.is_none()) {
    double one = 0;
    Eigen::VectorXd sigmas;
    if (nb::try_cast<double>(sigma, one)) {
      sigmas = Eigen::VectorXd::Constant(rows, one);
    } else {
      const auto array = ArrayArgument<double>{nb::borrow(sigma)}.get("sigma", {rows});
      sigmas = Eigen::Map<const Eigen::VectorXd>(array.data(), rows);
    }
    require(sigmas.allFinite() && sigmas.minCoeff() > 0, "sigma: it must be positive and finite");
    return sigmas.cwiseInverse().asDiagonal();
  }
  const Eigen::MatrixXd matrix = information_of(information, rows);
  const Eigen::LLT<Eigen::MatrixXd> llt(matrix);
  if (llt.info() == Eigen::Success) return llt.matrixU();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
  const Eigen::VectorXd& values = eigen.eigenvalues();
  require(values.minCoeff() >= -1e-9 * values.maxCoeff(), "information: the matrix is indefinite");
  return values.cwiseMax(0.0).cwiseSqrt().asDiagonal() * eigen.eigenvectors().transpose();
}

std::vector<NodeId> node_ids(const ArrayArgument<std::int64_t>& ids) {
  const auto array = ids.get("ids", {kAny});
  std::vector<NodeId> nodes;
  for (std::size_t i = 0; i < array.shape(0); ++i) nodes.emplace_back(array.data()[i]);
  return nodes;
}

}  // namespace placegraph::python
