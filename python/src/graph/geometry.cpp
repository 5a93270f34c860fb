#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/geometry/sim3.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "python/src/arrays.h"
#include "python/src/values/value_class.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;
using RowMatrix3X = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

SE3 from_matrix(const ArrayView<double>& array) {
  const Eigen::Map<const Matrix4> matrix(array.data());
  require((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() < 1e-9,
          "matrix: its last row must be 0 0 0 1");
  return SE3(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>()),
             Eigen::Vector3d(matrix.topRightCorner<3, 1>()));
}

/// The motion of a quaternion whose parts stand at these positions of its array.
SE3 from_quaternion(const ArrayView<double>& q, int w, int x, int y, int z,
                    const ArrayArgument<double>& translation) {
  const auto t = translation.get("translation", {3});
  const double* part = q.data();
  const Eigen::Quaterniond rotation(part[w], part[x], part[y], part[z]);
  require(rotation.norm() > 1e-12, "quaternion: all values are zero");
  return SE3(SO3(rotation), Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(t.data())));
}

Eigen::Vector4d quaternion_xyzw(const SE3& T) { return T.rotation().quaternion().coeffs(); }

Eigen::Vector4d quaternion_wxyz(const SE3& T) {
  const Eigen::Quaterniond& q = T.rotation().quaternion();
  return {q.w(), q.x(), q.y(), q.z()};
}

RowMatrix3X apply(const SE3& T, const ArrayArgument<double>& argument) {
  const auto array = argument.get("points", {kAny, 3});
  const Eigen::Map<const RowMatrix3X> points(array.data(), array.shape(0), 3);
  return ((points * T.rotation().matrix().transpose()).rowwise() + T.translation().transpose())
      .eval();
}

std::string text_of(const SE3& T) {
  const Eigen::Vector3d& t = T.translation();
  const Eigen::Vector4d q = quaternion_xyzw(T);
  return fmt::format(
      "SE3(translation=[{:.6g}, {:.6g}, {:.6g}], quaternion_xyzw=[{:.6g}, {:.6g}, "
      "{:.6g}, {:.6g}])",
      t.x(), t.y(), t.z(), q[0], q[1], q[2], q[3]);
}

void bind_se3(nb::module_& m) {
  nb::class_<SE3> se3(m, "SE3", doc("SE3"));
  bind_value(se3, Hash::kByValue);
  se3.def(nb::init<>(), doc("SE3::SE3"))
      .def(
          "__init__",
          [](SE3* self, const ArrayArgument<double>& matrix) {
            new (self) SE3(from_matrix(matrix.get("matrix", {4, 4})));
          },
          "matrix"_a, "The motion of a 4x4 matrix, whose rotation is replaced by the nearest one.")
      .def_static(
          "from_quaternion_xyzw",
          [](const ArrayArgument<double>& q, const ArrayArgument<double>& t) {
            return from_quaternion(q.get_xyzw("quaternion"), 3, 0, 1, 2, t);
          },
          "quaternion"_a, "translation"_a,
          "The motion of a quaternion x y z w, which is normalized, and a translation.")
      .def_static(
          "from_quaternion_wxyz",
          [](const ArrayArgument<double>& q, const ArrayArgument<double>& t) {
            return from_quaternion(q.get("quaternion", {4}), 0, 1, 2, 3, t);
          },
          "quaternion"_a, "translation"_a,
          "The motion of a quaternion w x y z, which is normalized, and a translation.")
      .def_static(
          "exp",
          [](const ArrayArgument<double>& xi) {
            const SE3 T = SE3::exp(Eigen::Map<const Vector6d>(xi.get("xi", {6}).data()));
            require(T.matrix().allFinite(), "xi: the motion is not finite");
            return T;
          },
          "xi"_a, doc("SE3::exp"))
      .def(
          "log", [](const SE3& T) { return Vector6d(T.log()); }, doc("SE3::log"))
      .def("inverse", &SE3::inverse, doc("SE3::inverse"))
      .def(
          "matrix", [](const SE3& T) { return Matrix4(T.matrix()); }, doc("SE3::matrix"))
      .def_prop_ro(
          "rotation", [](const SE3& T) { return Eigen::Matrix3d(T.rotation().matrix()); },
          "R_a_b of T_a_b, 3 x 3.")
      .def_prop_ro(
          "translation", [](const SE3& T) { return Eigen::Vector3d(T.translation()); },
          doc("SE3::translation"))
      .def_prop_ro("quaternion_xyzw", &quaternion_xyzw, "The unit quaternion x y z w.")
      .def_prop_ro("quaternion_wxyz", &quaternion_wxyz, "The unit quaternion w x y z.")
      .def(
          "adjoint", [](const SE3& T) { return Matrix6d(T.adjoint()); }, doc("SE3::adjoint"))
      .def(
          "plus",
          [](const SE3& T, const ArrayArgument<double>& xi) {
            return T.plus(Eigen::Map<const Vector6d>(xi.get("xi", {6}).data()));
          },
          "xi"_a, doc("SE3::plus"))
      .def(
          "minus", [](const SE3& y, const SE3& x) { return Vector6d((x.inverse() * y).log()); },
          "other"_a, "The tangent xi with other [+] xi = this.")
      .def(
          "__mul__", [](const SE3& a, const SE3& b) { return a * b; }, nb::is_operator())
      .def(
          "__matmul__", [](const SE3& a, const SE3& b) { return a * b; }, nb::is_operator())
      .def("transform", &apply, "points"_a, "Points in frame a of points in frame b, N x 3.")
      .def("__repr__", [](const SE3& T) { return text_of(T); });
}

/// A camera whose fields check() has accepted.
Camera checked_camera(int width, int height, double fx, double fy, double cx, double cy,
                      Distortion distortion, const std::vector<double>& coefficients) {
  Camera camera;
  require(coefficients.size() <= camera.coefficients.size(), "coefficients: at most 5");
  camera.width = width, camera.height = height;
  camera.fx = fx, camera.fy = fy, camera.cx = cx, camera.cy = cy;
  camera.distortion = distortion;
  std::ranges::copy(coefficients, camera.coefficients.begin());
  camera.check();
  return camera;
}

std::string text_of(const Camera& c) {
  std::string text = fmt::format("Camera({}, {}, {:.6g}, {:.6g}, {:.6g}, {:.6g}", c.width, c.height,
                                 c.fx, c.fy, c.cx, c.cy);
  constexpr const char* kNames[] = {"NONE", "RADIAL_TANGENTIAL", "EQUIDISTANT"};
  if (c.distortion != Distortion::kNone)
    text += fmt::format(", Distortion.{}, [{:.6g}]", kNames[static_cast<int>(c.distortion)],
                        fmt::join(c.coefficients, ", "));
  return text + ")";
}

std::string text_of(const DepthCamera& d) {
  return fmt::format("<placegraph.DepthCamera: {}, {:.4g} m at 1 m>", text_of(d.camera),
                     d.sigma_at_1m);
}

std::string text_of(const Calibration& c) {
  std::string text = "<placegraph.Calibration: " + text_of(c.camera);
  if (c.baseline_m > 0) text += fmt::format(", baseline {:.6g} m", c.baseline_m);
  if (c.depth) text += ", depth " + text_of(c.depth->camera);
  if (c.camera_height_m) text += fmt::format(", {:.6g} m above the ground", *c.camera_height_m);
  return text + ">";
}

/// Rows of `width` numbers, those of one call of `each` a row; NaN where it has none.
template <int width, class Each>
ReadOnlyArray<double> rows_of(std::size_t count, const Each& each) {
  std::vector<double> values(count * width, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < count; ++i)
    if (const auto row = each(i)) std::copy_n(row->data(), width, values.begin() + i * width);
  return owned_array(std::move(values), {count, width});
}

auto project(const Camera& camera, const ArrayArgument<double>& points) {
  const auto array = points.get("points", {kAny, 3});
  return rows_of<2>(array.shape(0), [&](std::size_t i) {
    return camera.project(Eigen::Map<const Eigen::Vector3d>(array.data() + 3 * i));
  });
}

auto unproject(const Camera& camera, const ArrayArgument<double>& px) {
  const auto array = px.get("px", {kAny, 2});
  return rows_of<3>(array.shape(0), [&](std::size_t i) {
    return camera.unproject(Eigen::Map<const Eigen::Vector2d>(array.data() + 2 * i));
  });
}

void bind_camera(nb::module_& m) {
  nb::enum_<Distortion>(m, "Distortion", doc("Distortion"))
      .value("NONE", Distortion::kNone)
      .value("RADIAL_TANGENTIAL", Distortion::kRadialTangential)
      .value("EQUIDISTANT", Distortion::kEquidistant);
  nb::class_<Camera> camera(m, "Camera", doc("Camera"));
  bind_value(camera, Hash::kByValue);
  camera
      .def(
          "__init__",
          [](Camera* self, int width, int height, double fx, double fy, double cx, double cy,
             Distortion distortion, const std::vector<double>& coefficients) {
            new (self)
                Camera(checked_camera(width, height, fx, fy, cx, cy, distortion, coefficients));
          },
          "width"_a, "height"_a, "fx"_a, "fy"_a, "cx"_a, "cy"_a, "distortion"_a = Distortion::kNone,
          "coefficients"_a = std::vector<double>(),
          "Sizes and lengths in pixels; raises ArgumentError that names the field.")
      .def_ro("width", &Camera::width, doc("Camera::width"))
      .def_ro("height", &Camera::height, doc("Camera::height"))
      .def_ro("fx", &Camera::fx, doc("Camera::fx"))
      .def_ro("fy", &Camera::fy, doc("Camera::fy"))
      .def_ro("cx", &Camera::cx, doc("Camera::cx"))
      .def_ro("cy", &Camera::cy, doc("Camera::cy"))
      .def_ro("distortion", &Camera::distortion, doc("Camera::distortion"))
      .def_prop_ro(
          "coefficients",
          [](const Camera& c) {
            return TupleOf<double>{{c.coefficients.begin(), c.coefficients.end()}};
          },
          doc("Camera::coefficients"))
      .def(
          "K", [](const Camera& c) { return Matrix3(c.K()); }, doc("Camera::K"))
      .def("project", &project, "points"_a,
           "The pixels (N x 2) of points in the camera frame (N x 3) [m].\n\nThey may be outside "
           "the image; NaN behind the camera and where the lens model has no pixel.")
      .def("unproject", &unproject, "px"_a,
           "The viewing rays (N x 3) of pixels (N x 2) in the camera frame, scaled to z = 1.\n\n"
           "NaN where the lens model has no ray.")
      .def("__repr__", [](const Camera& c) { return text_of(c); });
}

void bind_calibration(nb::module_& m) {
  nb::class_<DepthCamera> depth_camera(m, "DepthCamera", doc("DepthCamera"));
  bind_value(depth_camera, Hash::kNone);
  depth_camera.def(nb::init<>())
      .def_rw("camera", &DepthCamera::camera, doc("DepthCamera::camera"))
      .def_rw("T_cam_depth", &DepthCamera::T_cam_depth, doc("DepthCamera::T_cam_depth"))
      .def_rw("sigma_at_1m", &DepthCamera::sigma_at_1m, doc("DepthCamera::sigma_at_1m"))
      .def("__repr__", [](const DepthCamera& d) { return text_of(d); });
  nb::enum_<Sensor>(m, "Sensor", doc("Sensor"))
      .value("MONO", Sensor::kMono)
      .value("STEREO", Sensor::kStereo)
      .value("RGBD", Sensor::kRgbd);
  nb::class_<Calibration> calibration(m, "Calibration", doc("Calibration"));
  bind_value(calibration, Hash::kNone);
  calibration
      .def(
          "__init__",
          [](Calibration* self, const Camera& camera, double baseline_m,
             const std::optional<DepthCamera>& depth, std::optional<double> camera_height_m) {
            new (self) Calibration{camera, baseline_m, depth, camera_height_m};
            self->check();
          },
          "camera"_a, "baseline_m"_a = 0.0, "depth"_a = nb::none(),
          "camera_height_m"_a = nb::none())
      .def_rw("camera", &Calibration::camera, doc("Calibration::camera"))
      .def_rw("baseline_m", &Calibration::baseline_m, doc("Calibration::baseline_m"))
      .def_rw("depth", &Calibration::depth, doc("Calibration::depth"))
      .def_rw("camera_height_m", &Calibration::camera_height_m, doc("Calibration::camera_height_m"))
      .def("__repr__", [](const Calibration& c) { return text_of(c); });
}

}  // namespace

void bind_geometry(nb::module_& m) {
  bind_se3(m);
  bind_camera(m);
  bind_calibration(m);
}

}  // namespace placegraph::python
