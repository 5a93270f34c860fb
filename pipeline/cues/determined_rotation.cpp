#include <fmt/format.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/cues/determined_rotation.h>

#include <Eigen/LU>
#include <cmath>

namespace placegraph {

Outcome determines_rotation(const Matrix6d& information, double most_sigma_deg) {
  const Matrix6d covariance = information.inverse();  // not finite if it is singular
  const double sigma_deg = rad_to_deg(std::sqrt(covariance.bottomRightCorner<3, 3>().trace()));
  if (sigma_deg < most_sigma_deg) return Outcome::ok();
  return Outcome::failure(
      Outcome::Code::kDegenerate,
      std::isfinite(sigma_deg)
          ? fmt::format("the points determine the rotation to {:.1f} degrees only", sigma_deg)
          : "the points do not determine the rotation");
}

}  // namespace placegraph
