#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/measurements/measured_motion.h>

#include <nanobind/stl/shared_ptr.h>
#include <memory>

#include "python/src/arrays.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

using RowMatrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
using RowMatrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// A motion of arrays, row by row.
std::shared_ptr<MeasuredMotion> from_arrays(const ArrayArgument<std::int64_t>& from_ns,
                                            const ArrayArgument<std::int64_t>& to_ns,
                                            const ArrayArgument<double>& T_from_to,
                                            const ArrayArgument<double>& covariance) {
  const auto from = from_ns.get("from_ns", {kAny}), to = to_ns.get("to_ns", {kAny});
  const int count = static_cast<int>(from.shape(0));
  require(to.shape(0) == from.shape(0),
          fmt::format("to_ns: {} values for {} of from_ns", to.shape(0), count));
  const auto poses = T_from_to.get("T_from_to", {count, 4, 4});
  const auto covariances = covariance.get("covariance", {count, 6, 6});
  std::vector<MotionStep> steps;
  for (std::size_t i = 0; i < from.shape(0); ++i) {
    const Eigen::Map<const RowMatrix4> T(poses.data() + 16 * i);
    const Eigen::Map<const RowMatrix6> P(covariances.data() + 36 * i);
    const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
    require((R * R.transpose()).isIdentity(1e-6) && R.determinant() > 0,
            fmt::format("T_from_to: row {} is no rigid motion", i));
    require(P.isApprox(P.transpose(), 1e-6), fmt::format("covariance: row {} is not symmetric", i));
    steps.push_back(
        {from.data()[i], to.data()[i], SE3(R, Eigen::Vector3d(T.topRightCorner<3, 1>())), P});
  }
  return std::make_shared<MeasuredMotion>(std::move(steps));
}

}  // namespace

void bind_measured_motion(nb::module_& m) {
  nb::class_<MotionNoise>(m, "MotionNoise", doc("MotionNoise"))
      .def(nb::init<>(), "The defaults.")
      .def_rw("translation", &MotionNoise::translation, doc("MotionNoise::translation"))
      .def_rw("rotation_deg", &MotionNoise::rotation_deg, doc("MotionNoise::rotation_deg"))
      .def_rw("translation_m", &MotionNoise::translation_m, doc("MotionNoise::translation_m"))
      .def_rw("rotation_step_deg", &MotionNoise::rotation_step_deg,
              doc("MotionNoise::rotation_step_deg"));
  nb::class_<MeasuredMotion>(m, "MeasuredMotion", doc("MeasuredMotion"))
      .def(
          "__init__",
          [](MeasuredMotion* self, const Trajectory& trajectory, const MotionNoise& noise) {
            noise.check();
            new (self) MeasuredMotion(trajectory, noise);
          },
          "trajectory"_a, "noise"_a = MotionNoise(),
          "The motion between the poses of a trajectory. Its steps join consecutive frames that "
          "both have a pose.")
      .def_static("from_arrays", &from_arrays, "from_ns"_a, "to_ns"_a, "T_from_to"_a,
                  "covariance"_a,
                  "The motion of steps in time order: begin and end [ns] (N), pose of the body at "
                  "the end in its frame at the begin (N x 4 x 4), covariance in the right tangent "
                  "[translation, rotation] (N x 6 x 6).")
      .def("__len__", [](const MeasuredMotion& motion) { return motion.steps().size(); })
      .def(
          "between",
          [](const MeasuredMotion& motion, std::int64_t a_ns,
             std::int64_t b_ns) -> std::optional<std::pair<SE3, RowMatrix6>> {
            const auto between = motion.between(a_ns, b_ns);
            if (!between) return std::nullopt;
            return std::pair(between->T_a_b, RowMatrix6(between->covariance));
          },
          "a_ns"_a, "b_ns"_a, doc("MeasuredMotion::between"))
      .def(
          "seen_from",
          [](const MeasuredMotion& motion, const SE3& T_other_body) {
            return std::make_shared<MeasuredMotion>(motion.seen_from(T_other_body));
          },
          "T_other_body"_a, doc("MeasuredMotion::seen_from"));
}

}  // namespace placegraph::python
