#include <placegraph/frontend/cloud_planes/cloud_planes.h>
#include <placegraph/frontend/cloud_planes/cuboids.h>
#include <placegraph/frontend/cloud_planes/depth_planes.h>
#include <placegraph/frontend/cloud_planes/planarity_model.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/measurements/point_cloud_file.h>

#include "python/src/frontend/functions.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// N x 3 points, or H x W x 3 of an organised cloud; NaN: nothing was measured.
PointCloud cloud_from(const nb::object& points, double step_m) {
  require(std::isfinite(step_m) && step_m >= 0, "step_m: it must not be negative");
  const bool organised = nb::hasattr(points, "ndim") && nb::cast<int>(points.attr("ndim")) == 3;
  const ArrayArgument<double> argument{points};
  const auto rows = organised ? argument.get("points", {kAny, kAny, 3}, Values::kUnchecked)
                              : argument.get("points", {kAny, 3}, Values::kUnchecked);
  PointCloud cloud;
  cloud.step_m = step_m;
  if (organised) {
    cloud.height = static_cast<int>(rows.shape(0));
    cloud.width = static_cast<int>(rows.shape(1));
    require(cloud.organised(), "points: the image is empty");
  }
  const std::size_t count = rows.size() / 3;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Map<const Eigen::Vector3d> point(rows.data() + 3 * i);
    require(point.hasNaN() || (point.cwiseAbs().maxCoeff() < 1e6),
            "points: row " + std::to_string(i) + " is beyond 1e6 m");
    cloud.points.emplace_back(point);
  }
  return cloud;
}

/// Planes that were found, with the cloud they are of.
CloudPlanesResult planes_of(const PointCloud& cloud, const std::optional<std::string>& method,
                            const OptionsArgument<CloudPlanesOptions>& options) {
  static const std::vector<std::string> methods = {"cuts", "ransac", "growing"};
  CloudPlanesOptions chosen = options.get();
  if (method) chosen.method = choice_of<CloudPlanesMethod>(*method, methods, "method");
  const WithoutGil released;
  return find_cloud_planes(cloud, chosen, built_in_planarity());
}

std::vector<Cuboid> cuboids_of(const PointCloud& cloud, const CloudPlanesResult& planes,
                               const OptionsArgument<CuboidOptions>& options) {
  require_same_rows(planes.labels.size(), cloud.points.size(), "planes", "cloud");
  require(planes.from_origin, "cloud: it was not taken from the origin");
  const CuboidOptions chosen = options.get();
  const WithoutGil released;
  return find_cuboids(cloud, planes, chosen);
}

std::vector<DepthPlane> depth_planes(const DepthArgument& depth, const Camera& camera,
                                     const OptionsArgument<DepthPlanesOptions>& options) {
  const Image image = depth.get("depth");
  const DepthPlanesOptions chosen = options.get();
  chosen.check();
  require(image.cols == camera.width && image.rows == camera.height,
          "depth: it has another size than the camera's images");
  const WithoutGil released;
  return find_depth_planes(image, camera, chosen);
}

void bind_cloud(nb::module_& m) {
  nb::class_<PointCloud>(m, "PointCloud",
                         "Points of a scene in the sensor's frame [m]. An organised cloud has a "
                         "point for every pixel of an image, row by row.")
      .def(
          "__init__",
          [](PointCloud* self, const nb::object& points, double step_m) {
            new (self) PointCloud(cloud_from(points, step_m));
          },
          "points"_a, "step_m"_a = 0.0,
          "A cloud of points (N x 3) or an organised one (H x W x 3) [m]; NaN: nothing was "
          "measured. `step_m`: depths are multiples of it; 0: not known.",
          nb::sig("def __init__(self, points: numpy.typing.ArrayLike, step_m: float = 0.0) -> "
                  "None"))
      .def_static(
          "of_depth",
          [](const DepthArgument& depth, const Camera& camera, double step_m) {
            require(std::isfinite(step_m) && step_m >= 0, "step_m: it must not be negative");
            return cloud_of_depth(depth.get("depth"), camera, step_m);
          },
          "depth"_a, "camera"_a, "step_m"_a = 0.0,
          "The organised cloud of a depth image (H x W float32 [m], 0: nothing was measured) of a "
          "camera without distortion.")
      .def_static(
          "read", [](const std::filesystem::path& path) { return read_point_cloud(path.string()); },
          "path"_a, nb::call_guard<WithoutGil>(), doc("read_point_cloud"))
      .def_prop_ro(
          "points", [](const PointCloud& c) { return view_of(c.points, c); },
          "The points, N x 3 [m].")
      .def_ro("width", &PointCloud::width, "Width of an organised cloud [px], else 0.")
      .def_ro("height", &PointCloud::height, "Height of an organised cloud [px], else 0.")
      .def("__len__", [](const PointCloud& c) { return c.points.size(); });
}

void bind_planes(nb::module_& m) {
  nb::class_<CloudPlane>(m, "CloudPlane", "A plane in a point cloud.")
      .def_prop_ro(
          "normal", [](const CloudPlane& p) { return p.plane.normal; },
          "Unit normal, from the sensor to the plane.")
      .def_prop_ro(
          "distance_m", [](const CloudPlane& p) { return p.plane.distance_m; },
          "Distance from the sensor's origin [m].")
      .def_ro("covariance", &CloudPlane::covariance, doc("CloudPlane::covariance"))
      .def_ro("points", &CloudPlane::points, "Number of its points.")
      .def_ro("probability", &CloudPlane::probability, doc("CloudPlane::probability"))
      .def_ro("chi2_per_dof", &CloudPlane::chi2_per_dof, doc("CloudPlane::chi2_per_dof"));
  nb::class_<CloudPlanesResult> result(m, "CloudPlanesResult", "The planes of a point cloud.");
  bind_outcome(result);
  result
      .def_prop_ro("planes", as_tuple(&CloudPlanesResult::planes), doc("CloudPlanesResult::planes"))
      .def_prop_ro(
          "labels", [](const CloudPlanesResult& r) { return view_of(r.labels, r); },
          doc("CloudPlanesResult::labels"))
      .def_ro("from_origin", &CloudPlanesResult::from_origin,
              doc("CloudPlanesResult::from_origin"));
  nb::class_<Cuboid>(m, "Cuboid", doc("Cuboid"))
      .def_prop_ro(
          "kind", [](const Cuboid& c) { return c.kind == CuboidKind::kBox ? "box" : "room"; },
          "'box' (seen from outside) or 'room' (from inside).")
      .def_ro("T_sensor_cuboid", &Cuboid::T_sensor_cuboid, doc("Cuboid::T_sensor_cuboid"))
      .def_ro("half", &Cuboid::half, doc("Cuboid::half"))
      .def_prop_ro(
          "faces",
          [](const Cuboid& c) {
            return TupleOf<int>{{c.faces.begin(), c.faces.end()}};
          },
          doc("Cuboid::faces"))
      .def_ro("points", &Cuboid::points, doc("Cuboid::points"));
  nb::class_<DepthPlane>(m, "DepthPlane", doc("DepthPlane"))
      .def_prop_ro(
          "normal", [](const DepthPlane& p) { return p.plane_cam.normal(); },
          "Unit normal n of the plane n^T p = d in the camera's frame.")
      .def_prop_ro(
          "distance_m", [](const DepthPlane& p) { return p.plane_cam.distance(); },
          "Signed distance d along the normal [m].")
      .def_ro("covariance", &DepthPlane::covariance, doc("DepthPlane::covariance"))
      .def_prop_ro(
          "points", [](const DepthPlane& p) { return view_of(p.points_cam, p); },
          doc("DepthPlane::points_cam"));
}

}  // namespace

void bind_clouds(nb::module_& m) {
  bind_option_set<CloudPlanesOptions>(m, "CloudPlanesOptionSet", "Options of find_cloud_planes.");
  bind_option_set<CuboidOptions>(m, "CuboidOptionSet", "Options of find_cuboids.");
  bind_option_set<DepthPlanesOptions>(m, "DepthPlanesOptionSet", doc("DepthPlanesOptions"));
  bind_cloud(m);
  bind_planes(m);
  m.def("find_cloud_planes", &planes_of, "cloud"_a, "method"_a = nb::none(),
        "options"_a = nb::none(), doc("find_cloud_planes"));
  m.def("find_cuboids", &cuboids_of, "cloud"_a, "planes"_a, "options"_a = nb::none(),
        doc("find_cuboids"));
  m.def("find_depth_planes", &depth_planes, "depth"_a, "camera"_a, "options"_a = nb::none(),
        doc("find_depth_planes"));
}

}  // namespace placegraph::python
