#include <placegraph/frontend/markers/marker_detector.h>
#include <placegraph/frontend/markers/marker_pose.h>
#include <placegraph/graph/core/error.h>

#include "python/src/frontend/functions.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;
using Corners = Eigen::Matrix<double, 4, 2, Eigen::RowMajor>;

Corners corners_of(const MarkerObservation& marker) {
  Corners corners;
  for (int k = 0; k < 4; ++k)
    corners.row(k) = marker.corners_px[static_cast<std::size_t>(k)].transpose();
  return corners;
}

std::vector<MarkerObservation> detected(const MarkerDetector& detector, const GreyArgument& image,
                                        const std::optional<Camera>& lens) {
  const Image grey = image.get("image");
  const WithoutGil released;
  return detector.detect(grey, lens ? &*lens : nullptr);
}

MarkerPoses poses_of(const MarkerObservation& observation, double side_m, const Camera& camera) {
  require(std::isfinite(side_m) && side_m > 0, "side_m: it must be above 0");
  const WithoutGil released;
  return estimate_marker_poses(observation, side_m, camera);
}

void bind_results(nb::module_& m) {
  nb::class_<MarkerObservation>(m, "MarkerObservation",
                                "A marker in an image.\n\nCorners: top left, top right, bottom "
                                "right, bottom left of the upright marker.")
      .def(
          "__init__",
          [](MarkerObservation* self, int id, const ArrayArgument<double>& corners_px,
             double sigma_px) {
            require(std::isfinite(sigma_px) && sigma_px > 0, "sigma_px: it must be above 0");
            const auto corners = points_2d(corners_px, "corners_px");
            require(corners.size() == 4, "corners_px: four corners are needed");
            new (self) MarkerObservation{};
            self->id = id;
            std::copy(corners.begin(), corners.end(), self->corners_px.begin());
            self->covariance *= sigma_px * sigma_px;
          },
          "id"_a, "corners_px"_a, "sigma_px"_a = 0.2,
          "A marker whose corners were measured elsewhere (4 x 2 [px]): top left, top right, "
          "bottom right, bottom left; `sigma_px`: their standard deviation.")
      .def_ro("id", &MarkerObservation::id, "Number of the marker in its dictionary.")
      .def_prop_ro("corners_px", &corners_of,
                   "Top left, top right, bottom right and bottom left corner of the upright "
                   "marker, 4 x 2 [px].")
      .def_ro("covariance", &MarkerObservation::covariance, doc("MarkerObservation::covariance"))
      .def_ro("contrast", &MarkerObservation::contrast, doc("MarkerObservation::contrast"));
  nb::class_<MarkerPose>(m, "MarkerPose", doc("MarkerPose"))
      .def_ro("T_cam_marker", &MarkerPose::T_cam_marker,
              "The marker in the camera: its origin is the middle of the square.")
      .def_ro("covariance", &MarkerPose::covariance, doc("MarkerPose::covariance"))
      .def_ro("chi2", &MarkerPose::chi2, doc("MarkerPose::chi2"))
      .def_ro("rms_px", &MarkerPose::rms_px, doc("MarkerPose::rms_px"));
  nb::class_<MarkerPoses> poses(m, "MarkerPoses", doc("MarkerPoses"));
  bind_outcome(poses);
  poses.def_prop_ro("poses", as_tuple(&MarkerPoses::poses), doc("MarkerPoses::poses"))
      .def_prop_ro(
          "margin", [](const MarkerPoses& p) { return p.margin(); }, doc("MarkerPoses::margin"));
}

}  // namespace

void bind_markers(nb::module_& m) {
  bind_option_set<MarkerDetectorOptions>(m, "MarkerDetectorOptionSet",
                                         doc("MarkerDetectorOptions"));
  bind_results(m);
  nb::class_<MarkerDetector>(m, "MarkerDetector", doc("MarkerDetector"))
      .def(
          "__init__",
          [](MarkerDetector* self, const std::string& dictionary,
             const OptionsArgument<MarkerDetectorOptions>& options) {
            new (self) MarkerDetector(options.get(), dictionary);
          },
          "dictionary"_a, "options"_a = nb::none(),
          "Detects the markers of a dictionary, of `marker_dictionaries()`.")
      .def("detect", &detected, "image"_a, "lens"_a = nb::none(),
           "Detects all markers of a grey image (H x W uint8), in the order of their ids; `lens`: "
           "the camera if it has distortion.")
      .def_prop_ro("dictionary", &MarkerDetector::dictionary, "Name of the dictionary.");
  m.def("marker_dictionaries", &marker_dictionaries, doc("marker_dictionaries"));
  m.def("estimate_marker_poses", &poses_of, "observation"_a, "side_m"_a, "camera"_a,
        doc("estimate_marker_poses"));
}

}  // namespace placegraph::python
