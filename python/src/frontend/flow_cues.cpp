#include <placegraph/frontend/flow/flow_cues.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Eigenvalues>

#include "python/src/frontend/flow_vectors.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// Displacements without the camera's rotation, and the covariance of what was removed.
struct DerotatedVectors {
  std::vector<DerotatedFlow> vectors;
  Eigen::Matrix3d rotation_covariance = Eigen::Matrix3d::Zero();
};

DerotatedVectors derotated(const Camera& camera, const FlowVectors& flow, const nb::object& R_1_2,
                           const nb::object& covariance) {
  KnownRotation rotation;
  if (!R_1_2.is_none())
    rotation.R_1_2 = SO3::from_matrix(matrix_3x3(ArrayArgument<double>{R_1_2}, "R_1_2"));
  if (!covariance.is_none()) {
    rotation.covariance = matrix_3x3(ArrayArgument<double>{covariance}, "covariance");
    require(rotation.covariance.isApprox(rotation.covariance.transpose(), 1e-9) &&
                rotation.covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() >=
                    -1e-12 * rotation.covariance.norm(),
            "covariance: it is not symmetric and positive semi-definite");
  }
  const WithoutGil released;
  return {derotate(camera, flow.vectors, rotation), rotation.covariance};
}

VentralMotion ventral(const DerotatedVectors& flow, const ArrayArgument<double>& normal) {
  const Eigen::Vector3d direction = direction_3(normal, "normal");
  const WithoutGil released;
  return ventral_motion(flow.vectors, direction, flow.rotation_covariance);
}

TimeToContact contact(const VentralMotion& motion, const ArrayArgument<double>& normal,
                      double dt_s) {
  require(std::isfinite(dt_s) && dt_s > 0, "dt_s: it must be above 0");
  return time_to_contact(motion, direction_3(normal, "normal"), dt_s);
}

void bind_results(nb::module_& m) {
  const auto column = [](auto DerotatedFlow::*member) {
    return [member](const DerotatedVectors& v) { return column_of(v.vectors, member, v); };
  };
  nb::class_<DerotatedVectors>(m, "DerotatedFlow", doc("DerotatedFlow"))
      .def("__len__", [](const DerotatedVectors& v) { return v.vectors.size(); })
      .def_prop_ro("start", column(&DerotatedFlow::start),
                   "Points in the first image, on the plane z = 1; N x 2.")
      .def_prop_ro("end", column(&DerotatedFlow::end),
                   "The same in the second image as if the camera had only translated, N x 2.")
      .def_prop_ro("covariance", column(&DerotatedFlow::covariance),
                   doc("DerotatedFlow::covariance"));
  nb::class_<VentralMotion> motion(m, "VentralMotion", doc("VentralMotion"));
  bind_outcome(motion);
  motion.def_ro("over_distance", &VentralMotion::over_distance, doc("VentralMotion::over_distance"))
      .def_ro("covariance", &VentralMotion::covariance, doc("VentralMotion::covariance"))
      .def_ro("inliers", &VentralMotion::inliers, "Number of vectors that agree.")
      .def_ro("chi2_per_dof", &VentralMotion::chi2_per_dof,
              "Chi2 of the vectors over their degrees of freedom.");
  nb::class_<TimeToContact> time(m, "TimeToContact", doc("TimeToContact"));
  bind_outcome(time);
  time.def_ro("seconds", &TimeToContact::seconds, doc("TimeToContact::seconds"))
      .def_ro("sigma", &TimeToContact::sigma, "Standard deviation [s].");
  nb::class_<AffineFlow> affine(m, "AffineFlow", doc("AffineFlow"));
  bind_outcome(affine);
  affine.def_ro("centre", &AffineFlow::centre, "Flow on the optical axis.")
      .def_ro("gradient", &AffineFlow::gradient, "Its derivative by the position, 2 x 2.")
      .def_ro("covariance", &AffineFlow::covariance, doc("AffineFlow::covariance"))
      .def_prop_ro("divergence", &AffineFlow::divergence, doc("AffineFlow::divergence"))
      .def_prop_ro("divergence_variance", &AffineFlow::divergence_variance,
                   "Variance of the divergence.");
  nb::class_<LateralBalance> balance(m, "LateralBalance", doc("LateralBalance"));
  bind_outcome(balance);
  balance.def_ro("left", &LateralBalance::left, doc("LateralBalance::left"))
      .def_ro("right", &LateralBalance::right, "The same on the right side.")
      .def_ro("balance", &LateralBalance::balance, doc("LateralBalance::balance"))
      .def_ro("sigma", &LateralBalance::sigma, doc("LateralBalance::sigma"));
}

}  // namespace

void bind_flow_cues(nb::module_& m) {
  bind_results(m);
  m.def("derotate", &derotated, "camera"_a, "flow"_a, "R_1_2"_a = nb::none(),
        "covariance"_a = nb::none(),
        "Removes the camera's rotation from flow vectors.\n\n`R_1_2`: rotation of T_1_2 (3 x 3; "
        "none: only the pixels become rays); `covariance`: that of its right tangent (3 x 3 "
        "[rad^2]). Only full vectors are used; points outside the lens model are left out.",
        nb::sig("def derotate(camera: Camera, flow: FlowVectors, R_1_2: numpy.typing.ArrayLike | "
                "None = None, covariance: numpy.typing.ArrayLike | None = None) -> "
                "DerotatedFlow"));
  m.def("ventral_motion", &ventral, "flow"_a, "normal"_a,
        "Motion relative to a plane, in units of its distance, from the flow of points on it.\n\n"
        "`normal`: from the camera to the plane, in the axes of the first image. Robust by "
        "reweighting (Tukey's kernel). Fails with fewer than six vectors, or points that leave a "
        "direction undetermined.");
  m.def("time_to_contact", &contact, "motion"_a, "normal"_a, "dt_s"_a = 1.0,
        "Time to contact from a ventral motion; `dt_s` is the time between the images [s].\n\n"
        "Fails unless the motion is towards the plane by more than three standard deviations.");
  m.def(
      "affine_flow",
      [](const DerotatedVectors& flow) {
        return affine_flow(flow.vectors, flow.rotation_covariance);
      },
      "flow"_a, nb::call_guard<WithoutGil>(), doc("AffineFlow"));
  m.def(
      "lateral_balance",
      [](const DerotatedVectors& flow) {
        return lateral_balance(flow.vectors, flow.rotation_covariance);
      },
      "flow"_a, nb::call_guard<WithoutGil>(), doc("LateralBalance"));
}

}  // namespace placegraph::python
