#include <placegraph/backend/evidence/intrinsics_evidence.h>
#include <placegraph/backend/evidence/nuisance_equations.h>

namespace placegraph {
namespace {

constexpr Eigen::Index kParameters = IntrinsicsEvidence::kParameters;

/// Derivative of the pixel of a point (x, y, 1) by the intrinsics.
Eigen::Matrix<double, 2, kParameters> pixel_derivative(const Camera& camera,
                                                       const Eigen::Vector2d& x) {
  const Eigen::Vector2d f(camera.fx, camera.fy);
  Eigen::Matrix<double, 2, kParameters> J;
  J.col(IntrinsicsEvidence::kFocal) = f.cwiseProduct(x);
  J.col(IntrinsicsEvidence::kAspect) = 0.5 * Eigen::Vector2d(f[0] * x[0], -f[1] * x[1]);
  J.col(IntrinsicsEvidence::kPrincipalX) = Eigen::Vector2d(f[0], 0);
  J.col(IntrinsicsEvidence::kPrincipalY) = Eigen::Vector2d(0, f[1]);
  J.col(IntrinsicsEvidence::kRadial) = x.squaredNorm() * f.cwiseProduct(x);
  J.col(IntrinsicsEvidence::kDepthOffset).setZero();
  return J;
}

}  // namespace

IntrinsicsEvidence intrinsics_evidence(const WindowState& state, bool depths_measured) {
  constexpr std::size_t kViews = 3;  // two views are consistent with nearly any intrinsics
  const auto derivative_of = [&](const WindowObservation&, const Eigen::Vector3d& p_cam,
                                 NuisanceEquations::Derivative& J) {
    J.topRows<2>() = pixel_derivative(state.camera, p_cam.head<2>() / p_cam.z());
    const double inverse = 1 / p_cam.z();
    if (depths_measured) {
      J(2, IntrinsicsEvidence::kDepthOffset) = -inverse / p_cam.z();
    } else {  // a longer fx makes disparities larger
      J(2, IntrinsicsEvidence::kFocal) = inverse;
      J(2, IntrinsicsEvidence::kAspect) = 0.5 * inverse;
    }
  };
  NuisanceEquations equations(state, kParameters, derivative_of);
  int residuals = 0;
  for (const auto& [id, landmark] : state.landmarks) {
    const auto observations = usable_observations(state, landmark);
    if (observations.size() < kViews) continue;
    equations.add(observations, landmark.p_map);
    residuals += static_cast<int>(2 * observations.size());
  }
  if (residuals == 0) return {};
  const NuisanceEvidence evidence = equations.evidence();
  IntrinsicsEvidence result;
  result.gradient = evidence.gradient;
  result.information = evidence.information;
  result.residuals = residuals;
  return result;
}

}  // namespace placegraph
