#include <fmt/format.h>
#include <placegraph/backend/factors/variable.h>

#include <cmath>

#include "python/src/backend/graphs.h"
#include "python/src/values/value_class.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;
using Vector = Eigen::VectorXd;

Vector numbers(const ArrayArgument<double>& value, const char* argument, int size) {
  return Eigen::Map<const Vector>(value.get(argument, {size}).data(), size);
}

std::string text_of(const Vector& v) {
  return fmt::format("[{:.6g}]", fmt::join(v.data(), v.data() + v.size(), ", "));
}

/// What all variables have: plus and minus, and that they are values.
template <class T>
void bind_manifold(nb::class_<T>& c) {
  bind_value(c, Hash::kByValue);
  constexpr int dof = VariableBlock<T>::kDof;
  c.def(
       "plus",
       [](const T& x, const ArrayArgument<double>& xi) {
         return VariableBlock<T>::plus(x, numbers(xi, "xi", dof));
       },
       "xi"_a, "x [+] xi: the variable moved by a tangent.")
      .def(
          "minus", [](const T& y, const T& x) { return Vector(VariableBlock<T>::minus(y, x)); },
          "other"_a, "The tangent xi with other [+] xi = this.");
}

/// What all groups have.
template <class Group>
void bind_group(nb::class_<Group>& c) {
  bind_manifold(c);
  c.def(nb::init<>(), "The identity.")
      .def_static(
          "exp",
          [](const ArrayArgument<double>& xi) {
            return Group::exp(numbers(xi, "xi", Group::kDof));
          },
          "xi"_a, "The exponential map of a tangent.")
      .def(
          "log", [](const Group& T) { return Vector(T.log()); }, "The inverse of exp.")
      .def("inverse", &Group::inverse, "The inverse element.")
      .def(
          "adjoint", [](const Group& T) { return Eigen::MatrixXd(T.adjoint()); },
          "The matrix Ad with T exp(xi) = exp(Ad xi) T.")
      .def(
          "matrix", [](const Group& T) { return Eigen::MatrixXd(T.matrix()); },
          "The matrix of the element.")
      .def(
          "__mul__", [](const Group& a, const Group& b) { return a * b; }, nb::is_operator())
      .def(
          "__matmul__", [](const Group& a, const Group& b) { return a * b; }, nb::is_operator());
}

SO3 rotation_of(const ArrayArgument<double>& quaternion_xyzw) {
  const Eigen::Vector4d q(quaternion_xyzw.get_xyzw("quaternion_xyzw").data());
  require(std::abs(q.norm() - 1) < 1e-2, "quaternion_xyzw: it is not of unit length");
  return SO3(Eigen::Quaterniond(q[3], q[0], q[1], q[2]));
}

Vector quaternion_of(const SO3& R) { return R.quaternion().coeffs(); }

void bind_groups(nb::module_& m) {
  nb::class_<SE2> se2(m, "SE2", "A motion in the plane; tangents are [translation, angle].");
  bind_group(se2);
  se2.def(
         "__init__",
         [](SE2* self, double x, double y, double angle) {
           require(std::isfinite(x + y + angle), "x, y, angle: a value is not finite");
           new (self) SE2(x, y, angle);
         },
         "x"_a, "y"_a, "angle"_a)
      .def_prop_ro(
          "translation", [](const SE2& T) { return Vector(T.translation()); },
          "The translation [m, or in the scale of the map].")
      .def_prop_ro(
          "angle", [](const SE2& T) { return T.rotation().angle(); },
          "The angle of the rotation [rad].")
      .def("__repr__", [](const SE2& T) {
        return fmt::format("SE2({:.6g}, {:.6g}, {:.6g})", T.translation().x(), T.translation().y(),
                           T.rotation().angle());
      });
  nb::class_<SO3> so3(m, "SO3", "A rotation in space; tangents are rotation vectors [rad].");
  bind_group(so3);
  so3.def(
         "__init__",
         [](SO3* self, const ArrayArgument<double>& q) { new (self) SO3(rotation_of(q)); },
         "quaternion_xyzw"_a)
      .def_prop_ro("quaternion_xyzw", &quaternion_of, "The unit quaternion x y z w.")
      .def("__repr__",
           [](const SO3& R) { return fmt::format("SO3({})", text_of(quaternion_of(R))); });
  nb::class_<Sim3> sim3(
      m, "Sim3", "A similarity p -> s R p + t; tangents are [translation, rotation, log scale].");
  bind_group(sim3);
  sim3.def(
          "__init__",
          [](Sim3* self, const ArrayArgument<double>& q, const ArrayArgument<double>& t,
             double scale) {
            require(std::isfinite(scale) && scale > 0, "scale: it must be positive");
            new (self) Sim3(rotation_of(q), numbers(t, "translation", 3), scale);
          },
          "quaternion_xyzw"_a, "translation"_a, "scale"_a)
      .def_prop_ro(
          "quaternion_xyzw", [](const Sim3& S) { return quaternion_of(S.rotation()); },
          "The unit quaternion x y z w of the rotation.")
      .def_prop_ro(
          "translation", [](const Sim3& S) { return Vector(S.translation()); }, "The translation.")
      .def_prop_ro("scale", &Sim3::scale, "The scale.")
      .def("__repr__", [](const Sim3& S) {
        return fmt::format("Sim3({}, {}, {:.6g})", text_of(quaternion_of(S.rotation())),
                           text_of(S.translation()), S.scale());
      });
}

void bind_line(nb::module_& m) {
  nb::class_<Line3> line(m, "Line3", doc("Line3"));
  bind_manifold(line);
  line.def_static(
          "from_direction",
          [](const ArrayArgument<double>& point, const ArrayArgument<double>& direction) {
            return Line3::from_direction(numbers(point, "point", 3),
                                         numbers(direction, "direction", 3));
          },
          "point"_a, "direction"_a, doc("Line3::from_direction"))
      .def_prop_ro(
          "direction", [](const Line3& l) { return Vector(l.direction()); },
          doc("Line3::direction"))
      .def_prop_ro(
          "nearest_point", [](const Line3& l) { return Vector(l.nearest_point()); },
          doc("Line3::nearest_point"))
      .def(
          "coordinates", [](const Line3& l) { return Vector(l.coordinates()); },
          "Pluecker coordinates [m, v] of unit length.")
      .def(
          "distance_to",
          [](const Line3& l, const ArrayArgument<double>& p) {
            return l.distance_to(numbers(p, "point", 3));
          },
          "point"_a, doc("Line3::distance_to"))
      .def("__repr__", [](const Line3& l) {
        return fmt::format("<placegraph.Line3 through {} along {}>", text_of(l.nearest_point()),
                           text_of(l.direction()));
      });
}

void bind_plane_and_marker(nb::module_& m) {
  nb::class_<Plane3> plane(m, "Plane3", doc("Plane3"));
  bind_manifold(plane);
  plane
      .def(
          "__init__",
          [](Plane3* self, const ArrayArgument<double>& normal, double distance) {
            new (self) Plane3(numbers(normal, "normal", 3), distance);
          },
          "normal"_a, "distance"_a, "The plane n^T p = d; the normal may have any length.")
      .def_prop_ro(
          "normal", [](const Plane3& p) { return Vector(p.normal()); }, "The unit normal n.")
      .def_prop_ro(
          "distance", [](const Plane3& p) { return p.distance(); },
          "The signed distance d from the origin [m] along the normal.")
      .def(
          "distance_to",
          [](const Plane3& p, const ArrayArgument<double>& point) {
            return p.distance_to(numbers(point, "point", 3));
          },
          "point"_a, "Signed distance n^T p - d of a point [m].")
      .def("__repr__", [](const Plane3& p) {
        return fmt::format("Plane3({}, {:.6g})", text_of(p.normal()), p.distance());
      });
  nb::class_<Marker> marker(m, "Marker", doc("Marker"));
  bind_manifold(marker);
  marker
      .def(
          "__init__",
          [](Marker* self, const SE3& T_world_marker, double size_m) {
            require(std::isfinite(size_m) && size_m > 0, "size_m: it must be positive");
            new (self) Marker{T_world_marker, size_m};
          },
          "T_world_marker"_a, "size_m"_a)
      .def_ro("T_world_marker", &Marker::T_world_marker, doc("Marker::T_world_marker"))
      .def_ro("size_m", &Marker::size_m, doc("Marker::size_m"))
      .def("__repr__", [](const Marker& each) {
        return fmt::format("<placegraph.Marker of {:.6g} m at {}>", each.size_m,
                           text_of(each.T_world_marker.translation()));
      });
}

/// Takes the object if it is of class T.
template <class T>
bool take(nb::handle object, std::optional<Variable>& variable) {
  if (!nb::isinstance<T>(object)) return false;
  variable = nb::cast<T>(object);
  return true;
}

}  // namespace

Variable variable_of(nb::handle object, const std::string& argument) {
  std::optional<Variable> variable;
  if (take<SE2>(object, variable) || take<SE3>(object, variable) || take<Sim3>(object, variable) ||
      take<SO3>(object, variable) || take<Line3>(object, variable) ||
      take<Plane3>(object, variable) || take<Marker>(object, variable))
    return *variable;
  const bool scalar = nb::isinstance<nb::float_>(object) ||
                      (nb::isinstance<nb::int_>(object) && !nb::isinstance<nb::bool_>(object));
  if (scalar) {
    const double value = PyFloat_AsDouble(object.ptr());
    if (PyErr_Occurred()) throw nb::python_error();
    require(std::isfinite(value), argument + ": the value is not finite");
    return value;
  }
  try {
    const auto point = ArrayArgument<double>{nb::borrow(object)}.get(argument.c_str(), {3});
    return Variable(Eigen::Vector3d(point.data()));
  } catch (const ArgumentError& error) {
    if (nb::hasattr(object, "__len__")) throw;
    throw ArgumentError(
        argument +
        ": a float, SE2, SE3, Sim3, SO3, three numbers, a Line3, Plane3 or Marker is "
        "needed, not " +
        nb::repr(object).c_str());
  }
}

nb::object object_of(const Variable& variable) {
  return std::visit(
      [](const auto& value) -> nb::object {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, Eigen::Vector3d>)
          return nb::cast(Eigen::VectorXd(value));
        else
          return nb::cast(value);
      },
      variable);
}

void bind_variables(nb::module_& m) {
  bind_groups(m);
  bind_line(m);
  bind_plane_and_marker(m);
}

}  // namespace placegraph::python
