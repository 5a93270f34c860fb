#include <placegraph/backend/initialization/rotation_agreement.h>

#include <cmath>

namespace placegraph {
namespace {

constexpr double kCosineOfSame = 0.955;  // 0.3 rad

}  // namespace

double cosine_of(const SO2& R) { return std::cos(R.angle()); }
double cosine_of(const SO3& R) { return 2 * R.quaternion().w() * R.quaternion().w() - 1; }

template <class Group>
bool rotations_agree(const std::vector<Group>& a, const std::vector<Group>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto rotation_a = a[0].rotation().inverse() * a[i].rotation();
    const auto rotation_b = b[0].rotation().inverse() * b[i].rotation();
    if (!(cosine_of(rotation_a.inverse() * rotation_b) > kCosineOfSame)) return false;
  }
  return true;
}

template <int dim>
bool points_agree(const Eigen::MatrixXd& X, const Eigen::MatrixXd& Z) {
  // Trace of a rotation by the angle whose cosine is kCosineOfSame.
  constexpr double kTraceOfSame = dim == 2 ? 2 * kCosineOfSame : 1 + 2 * kCosineOfSame;
  for (Eigen::Index column = 0; column < X.cols(); column += dim + 1)
    if (!(X.middleCols<dim>(column).cwiseProduct(Z.middleCols<dim>(column)).sum() > kTraceOfSame))
      return false;
  return true;
}

template bool rotations_agree(const std::vector<SE2>&, const std::vector<SE2>&);
template bool rotations_agree(const std::vector<SE3>&, const std::vector<SE3>&);
template bool rotations_agree(const std::vector<Sim3>&, const std::vector<Sim3>&);
template bool points_agree<2>(const Eigen::MatrixXd&, const Eigen::MatrixXd&);
template bool points_agree<3>(const Eigen::MatrixXd&, const Eigen::MatrixXd&);

}  // namespace placegraph
