#include <placegraph/frontend/align/plane_tracker.h>
#include <placegraph/frontend/align/region_alignment.h>
#include <placegraph/graph/core/error.h>

#include <mutex>

#include "python/src/frontend/functions.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// A tracker that several threads of Python may use.
class SharedPlaneTracker {
 public:
  SharedPlaneTracker(const GreyArgument& image_ref, const ArrayArgument<double>& corners_px,
                     const OptionsArgument<PlaneTrackerOptions>& options,
                     const std::optional<Camera>& camera, const nb::object& normal_ref)
      : tracker_(image_ref.get("image_ref").clone(),
                 corners_in(image_ref.get("image_ref"), corners_px), options.get(), camera,
                 normal_of(normal_ref)) {}

  PlaneTrack track(const GreyArgument& image) {
    const Image grey = image.get("image").clone();  // it may become the second template
    const WithoutGil released;
    const std::lock_guard lock(mutex_);
    return tracker_.track(grey);
  }
  const Outcome& outcome() const { return tracker_.outcome(); }
  double least_similarity() const { return tracker_.least_similarity(); }

 private:
  static std::vector<Eigen::Vector2d> corners_in(const Image& image,
                                                 const ArrayArgument<double>& corners_px) {
    std::vector<Eigen::Vector2d> corners = points_2d(corners_px, "corners_px");
    require(corners.size() == 4, "corners_px: four corners are needed");
    for (const Eigen::Vector2d& px : corners)
      require(px.x() > -1 && px.y() > -1 && px.x() < image.cols && px.y() < image.rows,
              "corners_px: a corner lies outside the image");
    return corners;
  }
  static std::optional<Eigen::Vector3d> normal_of(const nb::object& normal_ref) {
    if (normal_ref.is_none()) return std::nullopt;
    return direction_3(ArrayArgument<double>{normal_ref}, "normal_ref");
  }

  PlaneTracker tracker_;
  std::mutex mutex_;
};

RegionAlignment aligned(const GreyArgument& image_ref, const GreyArgument& image_cur,
                        const ArrayArgument<double>& polygon_px, const nb::object& H_start,
                        const OptionsArgument<AlignOptions>& options, int levels, int max_samples) {
  const Image ref = image_ref.get("image_ref"), cur = image_cur.get("image_cur");
  const auto polygon = points_2d(polygon_px, "polygon_px");
  require(polygon.size() >= 3, "polygon_px: at least three corners are needed");
  require(levels >= 1 && levels <= 10, "levels: from 1 to 10 is needed");
  require(max_samples >= 1, "max_samples: it must be above 0");
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  if (!H_start.is_none()) H = matrix_3x3(ArrayArgument<double>{H_start}, "H_start");
  require(std::abs(H.determinant()) > 1e-12, "H_start: the matrix is singular");
  const AlignOptions chosen = options.get();
  const WithoutGil released;
  return align_region(ref, cur, polygon, H, chosen, levels, max_samples);
}

void bind_results(nb::module_& m) {
  nb::class_<RegionAlignment> result(m, "AlignResult", doc("RegionAlignment"));
  bind_outcome(result);
  result
      .def_ro("H_cur_ref", &RegionAlignment::H_cur_ref,
              "The homography, 3 x 3: px_cur ~ H px_ref; meaningful only if ok.")
      .def_ro("corner_sigma_px", &RegionAlignment::corner_sigma_px,
              doc("RegionAlignment::corner_sigma_px"))
      .def_ro("similarity", &RegionAlignment::similarity, doc("RegionAlignment::similarity"))
      .def_ro("agreement", &RegionAlignment::agreement, doc("RegionAlignment::agreement"))
      .def_ro("visible_share", &RegionAlignment::visible_share,
              doc("RegionAlignment::visible_share"))
      .def_ro("inlier_share", &RegionAlignment::inlier_share, doc("RegionAlignment::inlier_share"))
      .def_ro("gain", &RegionAlignment::gain,
              "Gain of the grey values from the template to the image.")
      .def_ro("bias", &RegionAlignment::bias, "What is added to them [grey levels].")
      .def_ro("iterations", &RegionAlignment::iterations, doc("RegionAlignment::iterations"));
  nb::class_<PlaneTrack> track(m, "PlaneTrack", doc("PlaneTrack"));
  bind_outcome(track);
  track
      .def_prop_ro(
          "source",
          [](const PlaneTrack& t) {
            return plane_track_source_names().at(static_cast<std::size_t>(t.source));
          },
          doc("PlaneTrackSource"))
      .def_ro("H_cur_ref", &PlaneTrack::H_cur_ref, "The homography, 3 x 3: px_cur ~ H px_ref.")
      .def_prop_ro(
          "corners_px", [](const PlaneTrack& t) { return view_of(t.corners_px, t); },
          doc("PlaneTrack::corners_px"))
      .def_ro("covariance", &PlaneTrack::covariance, doc("PlaneTrack::covariance"))
      .def_ro("similarity", &PlaneTrack::similarity, doc("PlaneTrack::similarity"))
      .def_ro("visible_share", &PlaneTrack::visible_share, doc("PlaneTrack::visible_share"))
      .def_ro("inlier_share", &PlaneTrack::inlier_share, doc("PlaneTrack::inlier_share"))
      .def_ro("T_cur_ref", &PlaneTrack::T_cur_ref, doc("PlaneTrack::T_cur_ref"))
      .def_ro("normal_ref", &PlaneTrack::normal_ref,
              "Estimated unit normal of the plane, in the camera of the reference image.");
}

}  // namespace

void bind_tracking(nb::module_& m) {
  bind_option_set<AlignOptions>(m, "AlignOptionSet", doc("AlignOptions"));
  bind_option_set<PlaneTrackerOptions>(m, "PlaneTrackerOptionSet", doc("PlaneTrackerOptions"));
  bind_results(m);
  nb::class_<SharedPlaneTracker>(m, "PlaneTracker", doc("PlaneTracker"))
      .def(nb::init<const GreyArgument&, const ArrayArgument<double>&,
                    const OptionsArgument<PlaneTrackerOptions>&, const std::optional<Camera>&,
                    const nb::object&>(),
           "image_ref"_a, "corners_px"_a, "options"_a = nb::none(), "camera"_a = nb::none(),
           "normal_ref"_a = nb::none(),
           "Takes the template from the quadrilateral `corners_px` (4 x 2 [px], in order around "
           "it) of an image (H x W uint8).\n\n`normal_ref`: normal of the plane, if known.",
           nb::sig("def __init__(self, image_ref: numpy.typing.NDArray[numpy.uint8], corners_px: "
                   "numpy.typing.ArrayLike, options: placegraph.options.OptionGroup | None = None, "
                   "camera: Camera | None = None, normal_ref: numpy.typing.ArrayLike | None = "
                   "None) -> None"))
      .def_prop_ro(
          "ok", [](const SharedPlaneTracker& t) { return bool(t.outcome()); },
          "Whether the template can be tracked.")
      .def_prop_ro(
          "reason", [](const SharedPlaneTracker& t) { return t.outcome().reason; },
          doc("Outcome::reason"))
      .def_prop_ro("least_similarity", &SharedPlaneTracker::least_similarity,
                   "Least similarity of a tracked frame.")
      .def("track", &SharedPlaneTracker::track, "image"_a,
           "Tracks the template in the next frame (H x W uint8, of any size).");
  m.def("align", &aligned, "image_ref"_a, "image_cur"_a, "polygon_px"_a, "H_start"_a = nb::none(),
        "options"_a = nb::none(), "levels"_a = 4, "max_samples"_a = 3000,
        "Finds a planar region of one image (H x W uint8) in another one by direct alignment."
        "\n\nThe result is the homography with the greatest similarity next to `H_start` (3 x 3; "
        "the identity), coarse to fine over `levels`. `polygon_px`: corners of the region (N x 2 "
        "[px]). Outcomes: too few data (few samples, or too little in view), degenerate (too "
        "little texture), not converged, inconsistent (the image found differs from the region).",
        nb::sig("def align(image_ref: numpy.typing.NDArray[numpy.uint8], image_cur: "
                "numpy.typing.NDArray[numpy.uint8], polygon_px: numpy.typing.ArrayLike, H_start: "
                "numpy.typing.ArrayLike | None = None, options: placegraph.options.OptionGroup | "
                "None = None, levels: int = 4, max_samples: int = 3000) -> AlignResult"));
}

}  // namespace placegraph::python
