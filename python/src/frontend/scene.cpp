#include <placegraph/frontend/features/wide_matcher.h>
#include <placegraph/frontend/labels/street_labels.h>
#include <placegraph/frontend/scene/horizon.h>
#include <placegraph/frontend/scene/orientation_map.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/models/scene_model_file.h>

#include "python/src/frontend/functions.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

std::vector<LineSegment> segments_in(const ArrayArgument<double>& array) {
  const auto rows = array.get("segments", {kAny, 4});
  std::vector<LineSegment> segments;
  for (std::size_t i = 0; i < rows.shape(0); ++i) {
    const double* ends = rows.data() + 4 * i;
    segments.push_back({{ends[0], ends[1]}, {ends[2], ends[3]}});
    require(segments.back().length() > 1e-9,
            "segments: row " + std::to_string(i) + " has no length");
  }
  return segments;
}

ReadOnlyArray<double> detected_segments(const GreyArgument& image,
                                        const OptionsArgument<SegmentDetectorOptions>& options) {
  const Image grey = image.get("image");
  const SegmentDetectorOptions chosen = options.get();
  chosen.check();
  std::vector<double> ends;
  {
    const WithoutGil released;
    for (const EdgeSegment& edge : detect_segments(grey, chosen)) {
      const LineSegment& s = edge.segment;
      ends.insert(ends.end(), {s.start.x(), s.start.y(), s.end.x(), s.end.y()});
    }
  }
  const std::size_t n = ends.size() / 4;
  return owned_array(std::move(ends), {n, 4});
}

SceneDirections directions_of(const ArrayArgument<double>& segments, const Camera& camera,
                              const OptionsArgument<SceneDirectionOptions>& options,
                              std::uint64_t seed) {
  const std::vector<LineSegment> lines = segments_in(segments);
  const SceneDirectionOptions chosen = options.get();
  const WithoutGil released;
  Random random(seed);
  return find_scene_directions(lines, camera, chosen, random);
}

OrientationMap orientations_of(const ArrayArgument<double>& segments,
                               const ArrayArgument<std::int32_t>& axis, const Camera& camera,
                               const ArrayArgument<double>& R_cam_manhattan,
                               const OptionsArgument<OrientationMapOptions>& options) {
  const std::vector<LineSegment> lines = segments_in(segments);
  const auto axes = axis.get("axis", {kAny});
  require_same_rows(axes.shape(0), lines.size(), "axis", "segments");
  const std::vector<int> axis_of(axes.data(), axes.data() + axes.shape(0));
  for (const int each : axis_of) require(each >= -1 && each <= 2, "axis: -1, 0, 1 or 2 is needed");
  const SO3 R = SO3::from_matrix(matrix_3x3(R_cam_manhattan, "R_cam_manhattan"));
  const OrientationMapOptions chosen = options.get();
  const WithoutGil released;
  return compute_orientation_map(lines, axis_of, camera, R, chosen);
}

Horizon horizon_of(const ArrayArgument<double>& segments, const Camera& camera,
                   const OptionsArgument<HorizonOptions>& options, std::uint64_t seed) {
  const std::vector<LineSegment> lines = segments_in(segments);
  const HorizonOptions chosen = options.get();
  chosen.check();
  const WithoutGil released;
  Random random(seed);
  return estimate_horizon(lines, camera, chosen, random);
}

ImageResult<std::uint8_t> plan_surfaces_of(const OrientationMap& map, const Camera& camera,
                                           const ArrayArgument<double>& R_cam_manhattan) {
  require(map.outcome.code == Outcome::Code::kOk, "map: it has no surfaces");
  require(map.labels.cols == camera.width && map.labels.rows == camera.height,
          "camera: its images have another size than the map");
  const SO3 R = SO3::from_matrix(matrix_3x3(R_cam_manhattan, "R_cam_manhattan"));
  const WithoutGil released;
  return {indoor_surfaces(map, camera, R)};
}

/// The labels of an image with the names of its classes.
struct LabelledImage {
  SceneLabels labels;
  std::vector<std::string> classes;
};

void require_kind(const SceneModel& model, SceneModel::Kind kind, const char* argument) {
  require(model.kind == kind, std::string(argument) + ": a model of kind " +
                                  (kind == SceneModel::Kind::kUrban ? "urban" : "surfaces") +
                                  " is needed");
}

void require_share(double value, const char* argument) {
  require(value >= 0 && value <= 1, std::string(argument) + ": from 0 to 1 is needed");
}

LabelledImage classified(const SceneModel& model, const PictureArgument& image,
                         double unknown_below) {
  require_kind(model, SceneModel::Kind::kSurfaces, "model");
  require_share(unknown_below, "unknown_below");
  const Image picture = image.get("image");
  const WithoutGil released;
  return {label_scene(model, picture, unknown_below), model.classes};
}

LabelledImage labelled(const SceneModel& urban, const SceneModel& surfaces,
                       const PictureArgument& image, double unknown_below) {
  require_kind(urban, SceneModel::Kind::kUrban, "urban");
  require_kind(surfaces, SceneModel::Kind::kSurfaces, "surfaces");
  require_share(unknown_below, "unknown_below");
  const Image picture = image.get("image");
  const WithoutGil released;
  return {label_street_scene(urban, surfaces, picture, 1, unknown_below).classes, urban.classes};
}

/// Matched points of two images as columns.
struct MatchedPoints {
  Outcome outcome;
  std::vector<Eigen::Vector2d> px_a, px_b;
  Eigen::Matrix3d F_b_a;
  int candidates = 0;
};

MatchedPoints matched(const GreyArgument& image_a, const GreyArgument& image_b,
                      const OptionsArgument<WideMatcherOptions>& options) {
  const Image a = image_a.get("image_a"), b = image_b.get("image_b");
  const WideMatcherOptions chosen = options.get();
  chosen.check();
  const WithoutGil released;
  const WideMatches found = match_wide(a, b, chosen);
  MatchedPoints points{found.outcome, {}, {}, found.F_b_a, found.candidates};
  for (const PointPair& pair : found.pairs) {
    points.px_a.push_back(pair.px_a);
    points.px_b.push_back(pair.px_b);
  }
  return points;
}

void bind_directions(nb::module_& m) {
  nb::class_<VanishingPoint>(m, "VanishingPoint", doc("VanishingPoint"))
      .def_ro("direction", &VanishingPoint::direction, doc("VanishingPoint::direction"))
      .def_ro("covariance", &VanishingPoint::covariance, doc("VanishingPoint::covariance"))
      .def_ro("segments", &VanishingPoint::segments, doc("VanishingPoint::segments"))
      .def_ro("evidence", &VanishingPoint::evidence, doc("VanishingPoint::evidence"));
  nb::class_<ManhattanFrame> frame(m, "ManhattanFrame", doc("ManhattanFrame"));
  bind_outcome(frame);
  frame
      .def_prop_ro(
          "R_cam_manhattan",
          [](const ManhattanFrame& f) { return Eigen::Matrix3d(f.R_cam_manhattan.matrix()); },
          doc("ManhattanFrame::R_cam_manhattan"))
      .def_ro("covariance", &ManhattanFrame::covariance, doc("ManhattanFrame::covariance"))
      .def_prop_ro(
          "axis", [](const ManhattanFrame& f) { return view_of(f.axis, f); },
          doc("ManhattanFrame::axis"))
      .def_prop_ro(
          "segments",
          [](const ManhattanFrame& f) {
            return std::vector<int>(f.segments.begin(), f.segments.end());
          },
          doc("ManhattanFrame::segments"))
      .def_ro("orthogonality_deg", &ManhattanFrame::orthogonality_deg,
              doc("ManhattanFrame::orthogonality_deg"))
      .def_ro("log_odds", &ManhattanFrame::log_odds, doc("ManhattanFrame::log_odds"));
  nb::class_<SceneDirections>(m, "SceneDirections", doc("SceneDirections"))
      .def_prop_ro(
          "ok", [](const SceneDirections& d) { return bool(d.vanishing.outcome); },
          doc("Outcome::bool"))
      .def_prop_ro(
          "reason", [](const SceneDirections& d) { return d.vanishing.outcome.reason; },
          doc("Outcome::reason"))
      .def("__bool__", [](const SceneDirections& d) { return bool(d.vanishing.outcome); })
      .def_prop_ro(
          "points", [](const SceneDirections& d) { return d.vanishing.points; },
          doc("VanishingPoints::points"))
      .def_prop_ro(
          "labels", [](const SceneDirections& d) { return view_of(d.vanishing.labels, d); },
          doc("VanishingPoints::labels"))
      .def_prop_ro("frames", as_tuple(&SceneDirections::frames), doc("SceneDirections::frames"));
  nb::class_<OrientationMap> map(m, "OrientationMap", doc("OrientationMap"));
  bind_outcome(map);
  map.def_prop_ro(
         "labels", [](const OrientationMap& o) { return ImageResult<std::uint8_t>{o.labels}; },
         doc("OrientationMap::labels"))
      .def_prop_ro(
          "confidence", [](const OrientationMap& o) { return ImageResult<float>{o.confidence}; },
          doc("OrientationMap::confidence"))
      .def_ro("vertical_axis", &OrientationMap::vertical_axis, doc("OrientationMap::vertical_axis"))
      .def_ro("coverage", &OrientationMap::coverage, doc("OrientationMap::coverage"));
}

void bind_horizon(nb::module_& m) {
  bind_option_set<HorizonOptions>(m, "HorizonOptionSet", "Options of estimate_horizon.");
  nb::class_<Horizon> horizon(m, "Horizon", doc("Horizon"));
  bind_outcome(horizon);
  horizon.def_ro("down", &Horizon::down, doc("Horizon::down"))
      .def_ro("sigma_deg", &Horizon::sigma_deg, doc("Horizon::sigma_deg"))
      .def_ro("directions", &Horizon::directions, doc("Horizon::directions"));
  m.def("estimate_horizon", &horizon_of, "segments"_a, "camera"_a, "options"_a = nb::none(),
        "seed"_a = 1,
        "Estimates the horizon by reweighted least squares, initialized with a level camera.\n\n"
        "Upright vanishing points are parallel to `down`, level ones at right angles to it. "
        "Deterministic for a given `seed`. Errors are those of find_scene_directions.");
  m.def("indoor_surfaces", &plan_surfaces_of, "map"_a, "camera"_a, "R_cam_manhattan"_a,
        "Classifies the surfaces of an orientation map, H x W uint8: 0 none, 1 floor (below the "
        "horizon of the vertical axis), 2 ceiling, 3 wall.");
}

void bind_labels(nb::module_& m) {
  nb::class_<SceneModel>(m, "SceneModel", doc("SceneModel"))
      .def_static(
          "read", [](const std::filesystem::path& path) { return read_scene_model(path.string()); },
          "path"_a, nb::call_guard<WithoutGil>(), doc("read_scene_model"))
      .def_prop_ro(
          "kind",
          [](const SceneModel& s) {
            return s.kind == SceneModel::Kind::kUrban ? "urban" : "surfaces";
          },
          "'surfaces' or 'urban'.")
      .def_prop_ro("classes", as_tuple(&SceneModel::classes), doc("SceneModel::classes"))
      .def_ro("origin", &SceneModel::origin, doc("SceneModel::origin"));
  nb::class_<LabelledImage>(m, "LabelledImage", "Labels of every pixel of an image.")
      .def_prop_ro(
          "labels",
          [](const LabelledImage& l) { return ImageResult<std::uint8_t>{l.labels.labels}; },
          "Class of each pixel, H x W uint8: an index into `classes`, or their number where it is "
          "unknown.")
      .def_prop_ro(
          "confidence",
          [](const LabelledImage& l) { return ImageResult<float>{l.labels.confidence}; },
          "Probability that each label is correct, H x W float32.")
      .def_prop_ro("classes", as_tuple(&LabelledImage::classes), "Names of the classes.");
  nb::class_<MatchedPoints> matches(m, "MatchedPoints", doc("WideMatches"));
  bind_outcome(matches);
  matches.def("__len__", [](const MatchedPoints& p) { return p.px_a.size(); })
      .def_prop_ro(
          "px_a", [](const MatchedPoints& p) { return view_of(p.px_a, p); },
          "Points in the first image, N x 2 [px].")
      .def_prop_ro(
          "px_b", [](const MatchedPoints& p) { return view_of(p.px_b, p); },
          "The same points in the second image, N x 2 [px].")
      .def_ro("F_b_a", &MatchedPoints::F_b_a, doc("WideMatches::F_b_a"))
      .def_ro("candidates", &MatchedPoints::candidates, doc("WideMatches::candidates"));
}

}  // namespace

void bind_scene(nb::module_& m) {
  bind_option_set<SegmentDetectorOptions>(m, "SegmentDetectorOptionSet",
                                          doc("SegmentDetectorOptions"));
  bind_option_set<SceneDirectionOptions>(m, "SceneDirectionOptionSet",
                                         doc("SceneDirectionOptions"));
  bind_option_set<OrientationMapOptions>(m, "OrientationMapOptionSet",
                                         doc("OrientationMapOptions"));
  bind_option_set<WideMatcherOptions>(m, "WideMatcherOptionSet", doc("WideMatcherOptions"));
  bind_directions(m);
  bind_horizon(m);
  bind_labels(m);
  m.def("detect_segments", &detected_segments, "image"_a, "options"_a = nb::none(),
        "Detects straight edges of a grey image (H x W uint8), longest first: N x 4, the ends "
        "(u, v) and (u, v) [px].\n\nLSD (von Gioi et al. 2010, by OpenCV), pieces of one edge "
        "merged, each refined on the gradient to sub-pixel accuracy. The brighter side is on the "
        "right of the direction from the first end to the second.");
  m.def("match_wide", &matched, "image_a"_a, "image_b"_a, "options"_a = nb::none(),
        doc("match_wide"));
  m.def(
      "find_scene_directions", &directions_of, "segments"_a, "camera"_a, "options"_a = nb::none(),
      "seed"_a = 1,
      "Estimates vanishing points and Manhattan frames together.\n\n"
      "A vanishing point that is an axis of a frame is constrained to it with the accuracy of the "
      "frame's right angles; an axis with enough segments, but too few to be found without the "
      "others, is a vanishing point too. Deterministic for a given `seed`.");
  m.def("compute_orientation_map", &orientations_of, "segments"_a, "axis"_a, "camera"_a,
        "R_cam_manhattan"_a, "options"_a = nb::none(), doc("compute_orientation_map"));
  m.def("classify_surfaces", &classified, "model"_a, "image"_a, "unknown_below"_a = 0.0,
        "Classifies the surfaces of an image (H x W, or H x W x 3 BGR, uint8): sky, ground, "
        "verticals, objects.\n\n`model`: of kind 'surfaces'. A pixel whose most probable class has "
        "a probability less than `unknown_below` is unknown.");
  m.def("label_jointly", &labelled, "urban"_a, "surfaces"_a, "image"_a, "unknown_below"_a = 0.0,
        "Labels an image of a street (H x W, or H x W x 3 BGR, uint8) by two models together, one "
        "of kind 'urban' and one of kind 'surfaces'.\n\nA pixel whose most probable class has a "
        "probability less than `unknown_below` is unknown.");
}

}  // namespace placegraph::python
