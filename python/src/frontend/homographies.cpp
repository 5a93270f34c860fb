#include <placegraph/frontend/planes/homography.h>
#include <placegraph/frontend/planes/homography_fit.h>
#include <placegraph/frontend/planes/motion_from_planes.h>
#include <placegraph/frontend/planes/planar_regions.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <numeric>

#include "python/src/frontend/functions.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

PointMatches matches_of(const ArrayArgument<double>& px_ref, const ArrayArgument<double>& px_cur) {
  PointMatches matches{points_2d(px_ref, "px_ref"), points_2d(px_cur, "px_cur")};
  require_same_rows(matches.px_cur.size(), matches.px_ref.size(), "px_cur", "px_ref");
  return matches;
}

/// A 3 x 3 matrix that has an inverse.
Eigen::Matrix3d homography_in(const ArrayArgument<double>& array, const char* argument) {
  const Eigen::Matrix3d H = matrix_3x3(array, argument);
  require(std::abs(H.determinant()) > 1e-12 * std::pow(H.norm(), 3),
          std::string(argument) + ": the matrix is singular");
  return H;
}

std::optional<Eigen::Matrix3d> through(const ArrayArgument<double>& px_ref,
                                       const ArrayArgument<double>& px_cur) {
  const PointMatches matches = matches_of(px_ref, px_cur);
  require(matches.size() == 4, "px_ref: four points are needed");
  return homography_through(matches, {0, 1, 2, 3});
}

HomographyFit refined(const ArrayArgument<double>& H_start, const ArrayArgument<double>& px_ref,
                      const ArrayArgument<double>& px_cur, double sigma_px, double freedom,
                      int max_iterations) {
  const Eigen::Matrix3d H = homography_in(H_start, "H_start");
  const PointMatches matches = matches_of(px_ref, px_cur);
  require(std::isfinite(sigma_px) && sigma_px > 0, "sigma_px: it must be above 0");
  require(freedom > 0, "freedom: it must be above 0");
  require(max_iterations > 0, "max_iterations: it must be above 0");
  const WithoutGil released;
  std::vector<int> which(matches.px_ref.size());
  std::iota(which.begin(), which.end(), 0);
  return refine_homography(H, matches, which, {sigma_px, freedom}, max_iterations);
}

PlanarRegionsResult regions_of(const ArrayArgument<double>& px_ref,
                               const ArrayArgument<double>& px_cur,
                               const OptionsArgument<PlanarRegionsOptions>& options,
                               std::uint64_t seed) {
  const PointMatches matches = matches_of(px_ref, px_cur);
  const PlanarRegionsOptions chosen = options.get();
  const WithoutGil released;
  Random random(seed);
  return find_planar_regions(matches, chosen, random);
}

MotionFromPlanesResult motion_of(const Camera& camera, const ArrayArgument<double>& px_ref,
                                 const ArrayArgument<double>& px_cur,
                                 const PlanarRegionsResult& regions,
                                 const OptionsArgument<MotionFromPlanesOptions>& options) {
  const PointMatches matches = matches_of(px_ref, px_cur);
  require_same_rows(matches.px_ref.size(), regions.labels.size(), "px_ref", "regions");
  const MotionFromPlanesOptions chosen = options.get();
  const WithoutGil released;
  return motion_from_planes(camera, matches, regions, chosen);
}

std::vector<HomographyMotion> decomposed(const ArrayArgument<double>& K,
                                         const ArrayArgument<double>& H_cur_ref,
                                         const ArrayArgument<double>& px_ref) {
  return decompose_homography(homography_in(K, "K"), homography_in(H_cur_ref, "H_cur_ref"),
                              points_2d(px_ref, "px_ref"));
}

SE3 motion_of_homography(const ArrayArgument<double>& K, const ArrayArgument<double>& H_cur_ref,
                         const ArrayArgument<double>& normal_ref) {
  return motion_from_homography(homography_in(K, "K"), homography_in(H_cur_ref, "H_cur_ref"),
                                direction_3(normal_ref, "normal_ref"));
}

void bind_plane(nb::module_& m) {
  nb::class_<Plane>(m, "Plane", doc("Plane"))
      .def(
          "__init__",
          [](Plane* self, const ArrayArgument<double>& normal, double distance_m) {
            const Eigen::Vector3d n = direction_3(normal, "normal");
            require(std::isfinite(distance_m) && distance_m > 0, "distance_m: it must be above 0");
            new (self) Plane{n, distance_m};
          },
          "normal"_a, "distance_m"_a, "The plane with a normal, which is made one long.")
      .def_ro("normal", &Plane::normal, "Unit normal, from the camera to the plane.")
      .def_ro("distance_m", &Plane::distance_m, "Distance from the camera's centre [m].")
      .def("__repr__", [](const Plane& plane) {
        const Eigen::Vector3d& n = plane.normal;
        return "Plane(normal=[" + std::to_string(n.x()) + ", " + std::to_string(n.y()) + ", " +
               std::to_string(n.z()) + "], distance_m=" + std::to_string(plane.distance_m) + ")";
      });
  nb::class_<HomographyMotion>(m, "HomographyMotion", doc("HomographyMotion"))
      .def_ro("T_cur_ref", &HomographyMotion::T_cur_ref,
              "The motion; its translation is in units of the plane's distance.")
      .def_ro("normal_ref", &HomographyMotion::normal_ref, "Unit normal of the plane.");
}

void bind_results(nb::module_& m) {
  nb::class_<HomographyFit> fit(m, "HomographyFit", "A homography with its covariance.");
  bind_outcome(fit);
  fit.def_ro("H_cur_ref", &HomographyFit::H_cur_ref, doc("HomographyFit::H_cur_ref"))
      .def_ro("covariance", &HomographyFit::covariance, doc("HomographyFit::covariance"))
      .def_ro("cost", &HomographyFit::cost, doc("HomographyFit::cost"));
  nb::class_<PlanarRegion>(m, "PlanarRegion", "One plane of two views.")
      .def_ro("H_cur_ref", &PlanarRegion::H_cur_ref, doc("PlanarRegion::H_cur_ref"))
      .def_ro("covariance", &PlanarRegion::covariance, doc("PlanarRegion::covariance"))
      .def_ro("matches", &PlanarRegion::matches, "Number of matches on the plane.");
  nb::class_<PlanarRegionsResult> regions(m, "PlanarRegionsResult",
                                          "The planes on which matches of two views are.");
  bind_outcome(regions);
  regions
      .def_prop_ro(
          "labels", [](const PlanarRegionsResult& r) { return view_of(r.labels, r); },
          doc("PlanarRegionsResult::labels"))
      .def_prop_ro("regions", as_tuple(&PlanarRegionsResult::regions),
                   doc("PlanarRegionsResult::regions"))
      .def_prop_ro(
          "noise_px", [](const PlanarRegionsResult& r) { return r.noise.sigma_px; },
          doc("PlanarRegionsResult::noise"))
      .def_ro("description_length", &PlanarRegionsResult::description_length,
              doc("PlanarRegionsResult::description_length"));
  nb::class_<PlanesReading>(m, "PlanesReading", doc("PlanesReading"))
      .def_ro("T_cur_ref", &PlanesReading::T_cur_ref, "The motion; its translation is one long.")
      .def_ro("covariance", &PlanesReading::covariance, doc("PlanesReading::covariance"))
      .def_prop_ro("planes_ref", as_tuple(&PlanesReading::planes_ref),
                   doc("PlanesReading::planes_ref"))
      .def_ro("cost", &PlanesReading::cost, doc("PlanesReading::cost"));
  nb::class_<MotionFromPlanesResult> motion(m, "MotionFromPlanesResult",
                                            "The motions that explain the planes of two views.");
  bind_outcome(motion);
  motion
      .def_prop_ro("readings", as_tuple(&MotionFromPlanesResult::readings),
                   doc("MotionFromPlanesResult::readings"))
      .def_prop_ro(
          "R_cur_ref",
          [](const MotionFromPlanesResult& r) {
            return r.R_cur_ref ? std::optional<Eigen::Matrix3d>(r.R_cur_ref->matrix())
                               : std::nullopt;
          },
          doc("MotionFromPlanesResult::R_cur_ref"));
}

}  // namespace

void bind_homographies(nb::module_& m) {
  bind_option_set<PlanarRegionsOptions>(m, "PlanarRegionsOptionSet",
                                        "Options of find_planar_regions.");
  bind_option_set<MotionFromPlanesOptions>(m, "MotionFromPlanesOptionSet",
                                           "Options of motion_from_planes.");
  bind_plane(m);
  bind_results(m);
  m.def("homography_through", &through, "px_ref"_a, "px_cur"_a, doc("homography_through"));
  m.def("refine_homography", &refined, "H_start"_a, "px_ref"_a, "px_cur"_a, "sigma_px"_a = 1.0,
        "freedom"_a = std::numeric_limits<double>::infinity(), "max_iterations"_a = 30,
        "Refines a homography over matches by Gauss-Newton on the symmetric transfer error.\n\n"
        "Pixels: N x 2. The noise of a match has the standard deviation `sigma_px` and `freedom` "
        "degrees of freedom (Student t; infinite: normal). Outcomes: too few data (under four "
        "matches), degenerate.");
  m.def("find_planar_regions", &regions_of, "px_ref"_a, "px_cur"_a, "options"_a = nb::none(),
        "seed"_a = 1, doc("find_planar_regions"));
  m.def("motion_from_planes", &motion_of, "camera"_a, "px_ref"_a, "px_cur"_a, "regions"_a,
        "options"_a = nb::none(), doc("motion_from_planes"));
  m.def("decompose_homography", &decomposed, "K"_a, "H_cur_ref"_a, "px_ref"_a,
        doc("decompose_homography"));
  m.def(
      "homography_from_plane",
      [](const ArrayArgument<double>& K, const SE3& T_cur_ref, const Plane& plane_ref) {
        return homography_from_plane(homography_in(K, "K"), T_cur_ref, plane_ref);
      },
      "K"_a, "T_cur_ref"_a, "plane_ref"_a, doc("homography_from_plane"));
  m.def("motion_from_homography", &motion_of_homography, "K"_a, "H_cur_ref"_a, "normal_ref"_a,
        "The motion T_cur_ref of a homography for a known normal of its plane, with the translation"
        " in units of the plane's distance.");
}

}  // namespace placegraph::python
