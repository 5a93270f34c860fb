#include "python/src/backend/graphs.h"

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

Pose pose_of(nb::handle value, const char* argument) {
  if (nb::isinstance<SE2>(value)) return nb::cast<SE2>(value);
  if (nb::isinstance<SE3>(value)) return nb::cast<SE3>(value);
  if (nb::isinstance<Sim3>(value)) return nb::cast<Sim3>(value);
  const auto row = ArrayArgument<double>{nb::borrow(value)}.get(argument, {kAny});
  require(
      row.shape(0) == 3 || row.shape(0) == 7 || row.shape(0) == 8,
      fmt::format("{}: an SE2, SE3 or Sim3, or a row of 3, 7 or 8 numbers is needed", argument));
  return pose_of_row(row.data(), row.shape(0), argument);
}

RotationError rotation_error_of(const std::string& name) {
  require(name == "log" || name == "quaternion",
          "rotation_error: 'log' or 'quaternion' is needed, not '" + name + "'");
  return name == "log" ? RotationError::kLog : RotationError::kQuaternion;
}

LogSink interruptible() {
  return [](LogLevel, const std::string&) {
    const nb::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
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
