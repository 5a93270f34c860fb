#include <fmt/format.h>
#include <placegraph/pipeline/map/explanation.h>

#include <nanobind/stl/map.h>

#include "python/src/graph/ids.h"
#include "python/src/graph/maps.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

std::string text_of(const Explanation& e) {
  if (!e.posed)
    return fmt::format("<placegraph.Explanation: frame {} has no pose>", e.frame.value());
  return fmt::format(
      "<placegraph.Explanation: frame {} at keyframe {} of place {}, {} inliers, {} loops accepted "
      "and {} refused>",
      e.frame.value(), e.keyframe->value(), e.place->value(), e.inliers, e.loops.size(),
      e.refused.size());
}

void bind_judgement(nb::module_& m) {
  nb::class_<Judgement>(m, "Judgement", doc("Judgement"))
      .def_prop_ro(
          "verdict", [](const Judgement& j) { return to_string(j.verdict); },
          "'good', 'doubtful' or 'failed'.")
      .def_ro("metric", &Judgement::metric, doc("Judgement::metric"))
      .def_ro("why_metric", &Judgement::why_metric, doc("Judgement::why_metric"))
      .def_prop_ro("findings", as_tuple(&Judgement::findings), doc("Judgement::findings"))
      .def_ro("expected_drift_m", &Judgement::expected_drift_m, doc("Judgement::expected_drift_m"))
      .def("__repr__", [](const Judgement& j) {
        return fmt::format("<placegraph.Judgement: {}, {} findings>", to_string(j.verdict),
                           j.findings.size());
      });
}

}  // namespace

void bind_explanation(nb::module_& m) {
  bind_judgement(m);
  nb::class_<Explanation>(m, "Explanation", doc("Explanation"))
      .def_ro("frame", &Explanation::frame, doc("Explanation::frame"))
      .def_ro("stamp_ns", &Explanation::stamp_ns, doc("Explanation::stamp_ns"))
      .def_ro("posed", &Explanation::posed, "Whether the frame has a pose.")
      .def_ro("keyframe", &Explanation::keyframe, doc("Explanation::keyframe"))
      .def_ro("place", &Explanation::place, doc("Explanation::place"))
      .def_prop_ro("labels", as_tuple(&Explanation::labels), doc("Explanation::labels"))
      .def_ro("component", &Explanation::component, doc("Explanation::component"))
      .def_prop_ro(
          "T_map_cam",
          [](const Explanation& e) { return e.posed ? std::optional(e.T_map_cam) : std::nullopt; },
          "Pose of the (left) camera, through keyframe and place; None if it is lost.")
      .def_ro("distance_to_keyframe", &Explanation::distance_to_keyframe,
              doc("Explanation::distance_to_keyframe"))
      .def_ro("covariance", &Explanation::covariance, doc("Explanation::covariance"))
      .def_ro("inliers", &Explanation::inliers, doc("Explanation::inliers"))
      .def_ro("features", &Explanation::features, doc("Explanation::features"))
      .def_ro("features_placed", &Explanation::features_placed, doc("Explanation::features_placed"))
      .def_ro("constraints", &Explanation::constraints, doc("Explanation::constraints"))
      .def_prop_ro("loops", as_tuple(&Explanation::loops), doc("Explanation::loops"))
      .def_prop_ro("refused", as_tuple(&Explanation::refused), doc("Explanation::refused"))
      .def("__repr__", [](const Explanation& e) { return text_of(e); });
}

}  // namespace placegraph::python
