#include <placegraph/graph/geometry/so2.h>

#include <cmath>
#include <numbers>

namespace placegraph {

SO2::SO2(double angle) : c_(std::cos(angle)), s_(std::sin(angle)) {}

double SO2::angle() const {
  const double angle = std::atan2(s_, c_);
  return angle <= -std::numbers::pi ? std::numbers::pi : angle;  // atan2(-0, -1) is -pi
}

Eigen::Matrix2d SO2::matrix() const {
  Eigen::Matrix2d R;
  R << c_, -s_, s_, c_;
  return R;
}

}  // namespace placegraph
