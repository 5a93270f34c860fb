#include <fmt/format.h>
#include <placegraph/backend/factors/absolute_rotation.h>
#include <placegraph/backend/factors/bearing.h>
#include <placegraph/backend/factors/distance.h>
#include <placegraph/backend/factors/line_reprojection.h>
#include <placegraph/backend/factors/non_holonomic.h>
#include <placegraph/backend/factors/plane_observation.h>
#include <placegraph/backend/factors/plane_orthogonal.h>
#include <placegraph/backend/factors/plane_parallel.h>
#include <placegraph/backend/factors/point_in_node.h>
#include <placegraph/backend/factors/point_observation.h>
#include <placegraph/backend/factors/point_on_plane.h>
#include <placegraph/backend/factors/pose_prior.h>
#include <placegraph/backend/factors/position.h>
#include <placegraph/backend/factors/relative_pose.h>

#include <cmath>

#include "python/src/backend/graphs.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;
using Array = ArrayArgument<double>;

template <class F>
NamedFactor named(const char* name, F factor) {
  return {std::make_shared<const F>(std::move(factor)), name};
}

Eigen::Vector3d vector3(const Array& value, const char* argument) {
  return Eigen::Vector3d(value.get(argument, {3}).data());
}

Eigen::Vector2d vector2(const Array& value, const char* argument) {
  return Eigen::Vector2d(value.get(argument, {2}).data());
}

double positive(double value, const char* argument) {
  require(std::isfinite(value) && value > 0, std::string(argument) + ": it must be positive");
  return value;
}

double finite(double value, const char* argument) {
  require(std::isfinite(value), std::string(argument) + ": it is not finite");
  return value;
}

/// The factor that `make` makes of a pose and W, for the group of the pose.
template <class Make>
NamedFactor of_pose(const Pose& pose, nb::handle sigma, nb::handle information, const Make& make) {
  return std::visit(
      [&]<class Group>(const Group& T) -> NamedFactor {
        const typename Group::Jacobian W = whitening_of(sigma, information, Group::kDof);
        return make(T, W);
      },
      pose);
}

/// The group with this name.
Pose group_of(const std::string& kind) {
  if (kind == "SE2") return SE2();
  if (kind == "SE3") return SE3();
  require(kind == "Sim3", "kind: 'SE2', 'SE3' or 'Sim3' is needed, not '" + kind + "'");
  return Sim3();
}

NamedFactor relative_pose(nb::handle T_from_to, nb::handle sigma, nb::handle information,
                          const std::string& rotation_error) {
  const RotationError error = rotation_error_of(rotation_error);
  return of_pose(pose_of(T_from_to, "T_from_to"), sigma, information,
                 [&]<class Group>(const Group& T, const typename Group::Jacobian& W) {
                   return named("relative_pose", RelativePoseFactor<Group>(T, W, error));
                 });
}

NamedFactor pose_prior(nb::handle T_world_node, nb::handle sigma, nb::handle information,
                       const std::string& rotation_error) {
  const RotationError error = rotation_error_of(rotation_error);
  return of_pose(pose_of(T_world_node, "T_world_node"), sigma, information,
                 [&]<class Group>(const Group& T, const typename Group::Jacobian& W) {
                   return named("pose_prior", PosePriorFactor<Group>(T, W, error));
                 });
}

NamedFactor position(const Array& position_world, nb::handle sigma, nb::handle information,
                     const std::optional<Array>& lever_arm, const std::string& kind) {
  const Eigen::Vector3d at = vector3(position_world, "position_world");
  const Eigen::Vector3d arm =
      lever_arm ? vector3(*lever_arm, "lever_arm") : Eigen::Vector3d(0, 0, 0);
  const Eigen::Matrix3d W = whitening_of(sigma, information, 3);
  return std::visit(
      [&]<class Group>(const Group&) {
        return named("position", PositionFactor<Group>(at, arm, W));
      },
      group_of(kind));
}

NamedFactor point_in_node(const Array& p_node, nb::handle sigma, nb::handle information,
                          const std::string& kind) {
  const Eigen::Vector3d p = vector3(p_node, "p_node");
  return std::visit(
      [&]<class Group>(const Group&) {
        constexpr int dim = Group::kDof == 3 ? 2 : 3;
        const Eigen::Matrix<double, dim, dim> W = whitening_of(sigma, information, dim);
        return named("point_in_node", PointInNodeFactor<Group>(p, W));
      },
      group_of(kind));
}

void bind_pose_factors(nb::class_<NamedFactor>& f) {
  f.def_static("relative_pose", &relative_pose, "T_from_to"_a, "sigma"_a = nb::none(),
               "information"_a = nb::none(), "rotation_error"_a = "log", doc("RelativePoseFactor"))
      .def_static("pose_prior", &pose_prior, "T_world_node"_a, "sigma"_a = nb::none(),
                  "information"_a = nb::none(), "rotation_error"_a = "log", doc("PosePriorFactor"))
      .def_static("position", &position, "position_world"_a, "sigma"_a = nb::none(),
                  "information"_a = nb::none(), "lever_arm"_a = nb::none(), "kind"_a = "SE3",
                  doc("PositionFactor"))
      .def_static(
          "distance",
          [](double distance_m, double sigma_m, const std::string& kind) {
            require(kind == "SE2" || kind == "SE3",
                    "kind: 'SE2' or 'SE3' is needed, not '" + kind + "'");
            const double distance = finite(distance_m, "distance_m"),
                         sigma = positive(sigma_m, "sigma_m");
            return kind == "SE2" ? named("distance", DistanceFactorOf<SE2>(distance, sigma))
                                 : named("distance", DistanceFactor(distance, sigma));
          },
          "distance_m"_a, "sigma_m"_a, "kind"_a = "SE3", doc("DistanceFactorOf"))
      .def_static(
          "bearing",
          [](const Array& direction, nb::handle sigma, nb::handle information) {
            const Eigen::Vector3d u = vector3(direction, "direction_a");
            require(u.norm() > 0, "direction_a: it is zero");
            return named("bearing", BearingFactor(u, whitening_of(sigma, information, 3)));
          },
          "direction_a"_a, "sigma"_a = nb::none(), "information"_a = nb::none(),
          doc("BearingFactor"))
      .def_static(
          "non_holonomic",
          [](const Array& across, double sigma_m, const std::optional<Array>& lever_arm) {
            const Eigen::Vector3d a = vector3(across, "across");
            require(a.norm() > 0, "across: it is zero");
            const Eigen::Vector3d arm =
                lever_arm ? vector3(*lever_arm, "lever_arm") : Eigen::Vector3d(0, 0, 0);
            return named("non_holonomic", NonHolonomicFactor(a, arm, positive(sigma_m, "sigma_m")));
          },
          "across"_a, "sigma_m"_a, "lever_arm"_a = nb::none(), doc("NonHolonomicFactor"))
      .def_static(
          "absolute_rotation",
          [](const SO3& R, nb::handle sigma, nb::handle information) {
            return named("absolute_rotation",
                         AbsoluteRotationFactor(R, whitening_of(sigma, information, 3)));
          },
          "R_cam_manhattan"_a, "sigma"_a = nb::none(), "information"_a = nb::none(),
          doc("AbsoluteRotationFactor"));
}

void bind_plane_factors(nb::class_<NamedFactor>& f) {
  f.def_static(
       "plane_observation",
       [](const Plane3& plane, nb::handle sigma, nb::handle information) {
         return named("plane_observation",
                      PlaneObservationFactor(plane, whitening_of(sigma, information, 3)));
       },
       "plane_sensor"_a, "sigma"_a = nb::none(), "information"_a = nb::none(),
       doc("PlaneObservationFactor"))
      .def_static(
          "plane_parallel",
          [](double sigma) {
            return named("plane_parallel", PlaneParallelFactor(positive(sigma, "sigma_rad")));
          },
          "sigma_rad"_a, doc("PlaneParallelFactor"))
      .def_static(
          "plane_orthogonal",
          [](double sigma) {
            return named("plane_orthogonal", PlaneOrthogonalFactor(positive(sigma, "sigma_rad")));
          },
          "sigma_rad"_a, doc("PlaneOrthogonalFactor"))
      .def_static(
          "point_on_plane",
          [](double sigma) {
            return named("point_on_plane", PointOnPlaneFactor(positive(sigma, "sigma_m")));
          },
          "sigma_m"_a, doc("PointOnPlaneFactor"));
}

NamedFactor reprojection(const Camera& camera, const Array& px, nb::handle sigma_px,
                         const std::optional<Array>& covariance) {
  const Eigen::Vector2d at = vector2(px, "px");
  require(sigma_px.is_none() == covariance.has_value(),
          "sigma_px, covariance: exactly one of them is needed");
  if (!covariance) {
    double sigma = 0;
    require(nb::try_cast<double>(sigma_px, sigma), "sigma_px: a number is needed");
    return named("reprojection", PointObservationFactor<Reprojection>(
                                     Reprojection(camera, at, positive(sigma, "sigma_px"))));
  }
  const Eigen::Matrix2d matrix(covariance->get("covariance", {2, 2}).data());
  require(matrix(0, 1) == matrix(1, 0) && matrix(0, 0) > 0 && matrix.determinant() > 0,
          "covariance: it is not positive definite");
  return named("reprojection",
               PointObservationFactor<Reprojection>(Reprojection(camera, at, matrix)));
}

void bind_landmark_factors(nb::class_<NamedFactor>& f) {
  f.def_static("point_in_node", &point_in_node, "p_node"_a, "sigma"_a = nb::none(),
               "information"_a = nb::none(), "kind"_a = "SE3", doc("PointInNodeFactor"))
      .def_static("reprojection", &reprojection, "camera"_a, "px"_a, "sigma_px"_a = nb::none(),
                  "covariance"_a = nb::none(), doc("Reprojection"))
      .def_static(
          "inverse_depth",
          [](double inverse_depth, double sigma) {
            return named("inverse_depth",
                         PointObservationFactor<InverseDepth>(InverseDepth(
                             finite(inverse_depth, "inverse_depth"), positive(sigma, "sigma"))));
          },
          "inverse_depth"_a, "sigma"_a,
          "The measured inverse depth [1/m] of a point in a camera, a factor of T_world_cam and "
          "p_world:\n\n  r = [(1/z - inverse_depth) / sigma, 0],   [x y z] = p_cam")
      .def_static(
          "line_reprojection",
          [](const Camera& camera, const Array& start_px, const Array& end_px, double sigma_px,
             const std::optional<Array>& second_in_cam) {
            const Eigen::Vector3d c =
                second_in_cam ? vector3(*second_in_cam, "second_in_cam") : Eigen::Vector3d(0, 0, 0);
            return named("line_reprojection",
                         LineReprojectionFactor(camera, vector2(start_px, "start_px"),
                                                vector2(end_px, "end_px"),
                                                positive(sigma_px, "sigma_px"), c));
          },
          "camera"_a, "start_px"_a, "end_px"_a, "sigma_px"_a, "second_in_cam"_a = nb::none(),
          "Distances of the ends of an observed line segment from the projected line, a factor of "
          "T_world_cam and a Line3.\n\n"
          "  r = [p_start^T l, p_end^T l] / (sqrt(l_1^2 + l_2^2) sigma_px),   p = [u, v, 1]\n\n"
          "l is the image of the line in an undistorted pinhole camera. The observing camera has "
          "the orientation of the camera frame; `second_in_cam` is its centre there: None for the "
          "camera itself, [baseline, 0, 0] for the right camera of a stereo pair. If the plane "
          "through the line and the camera centre is parallel to the image, the line has no image: "
          "the residual is 1000 and the derivatives are zero.");
}

/// The values of the arguments, if they are of the kinds of the factor.
std::vector<Variable> values_of(const NamedFactor& f, const nb::args& arguments) {
  const std::vector<std::size_t> kinds = f.factor->variable_kinds();
  require(arguments.size() == kinds.size(), fmt::format("values: {} takes {} variables, not {}",
                                                        f.name, kinds.size(), arguments.size()));
  std::vector<Variable> values;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    values.push_back(variable_of(arguments[k], fmt::format("values: entry {}", k)));
    require(values[k].index() == kinds[k],
            fmt::format("values: entry {} is a {}, which {} does not take there", k,
                        kind_name(values[k]), f.name));
  }
  return values;
}

std::vector<const Variable*> pointers(const std::vector<Variable>& values) {
  std::vector<const Variable*> result;
  for (const Variable& value : values) result.push_back(&value);
  return result;
}

std::optional<Eigen::VectorXd> residual(const NamedFactor& f, const nb::args& arguments) {
  const std::vector<Variable> values = values_of(f, arguments);
  Eigen::VectorXd r(f.factor->residual_size());
  if (!f.factor->evaluate(pointers(values), r, {})) return std::nullopt;
  return r;
}

std::optional<std::vector<Eigen::MatrixXd>> jacobians(const NamedFactor& f,
                                                      const nb::args& arguments) {
  const std::vector<Variable> values = values_of(f, arguments);
  Eigen::VectorXd r(f.factor->residual_size());
  std::vector<Eigen::MatrixXd> J;
  for (const Variable& value : values) J.emplace_back(r.size(), degrees_of_freedom(value));
  if (!f.factor->evaluate(pointers(values), r, J)) return std::nullopt;
  return J;
}

NamedFactor custom(nb::object residual_function, const std::vector<nb::object>& values,
                   nb::object jacobian, nb::handle sigma, nb::handle information,
                   const std::string& name) {
  std::vector<Variable> variables;
  for (const nb::object& value : values)
    variables.push_back(variable_of(value, fmt::format("values: entry {}", variables.size())));
  return custom_factor(std::move(residual_function), variables, std::move(jacobian), sigma,
                       information, name);
}

}  // namespace

void bind_factors(nb::module_& m) {
  nb::class_<NamedFactor> factor(
      m, "Factor",
      "A whitened residual of a few variables; the cost of a graph is sum rho(|r|^2) / 2.\n\n"
      "`sigma` is one standard deviation, or one a row; `information` a matrix of any rank with "
      "W^T W = information. Exactly one of them is given. Tangents are on the right: T exp(xi).");
  bind_pose_factors(factor);
  bind_plane_factors(factor);
  bind_landmark_factors(factor);
  factor
      .def_static(
          "custom", &custom, "residual"_a, "values"_a, "jacobian"_a = nb::none(),
          "sigma"_a = nb::none(), "information"_a = nb::none(), "name"_a = "",
          "A factor written in Python.\n\n"
          "`residual(*values)` returns D numbers, or None where it cannot be computed (the solver "
          "then tries a shorter step). `values` are examples of the variables: their kinds and the "
          "number of rows there are those of the factor. `jacobian(*values)` returns one D x dof "
          "array for each variable, by its right tangent; without it derivatives are central "
          "differences. `sigma` or `information` weigh the residual; without them it is whitened "
          "already. `name` stands in messages. An exception ends the optimization and is raised.")
      .def_ro("name", &NamedFactor::name, "Name for messages.")
      .def_prop_ro(
          "residual_size", [](const NamedFactor& f) { return f.factor->residual_size(); },
          doc("Factor::residual_size"))
      .def("residual", &residual,
           nb::sig("def residual(self, *values: object) -> numpy.typing.NDArray[numpy.float64] | "
                   "None"),
           "The whitened residual at values; None where it cannot be computed.")
      .def("jacobians", &jacobians,
           nb::sig("def jacobians(self, *values: object) -> "
                   "list[numpy.typing.NDArray[numpy.float64]] | None"),
           "Its derivatives by the tangents of the values; None where they cannot be computed.")
      .def("__repr__", [](const NamedFactor& f) {
        return fmt::format("<Factor {} of {} rows>", f.name, f.factor->residual_size());
      });
}

}  // namespace placegraph::python
