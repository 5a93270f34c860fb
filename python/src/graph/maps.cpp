#include "python/src/graph/maps.h"

#include <fmt/format.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/shared_ptr.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/pipeline/exports/colmap_import.h>
#include <placegraph/pipeline/exports/map_export.h>
#include <placegraph/pipeline/map/explanation.h>
#include <placegraph/pipeline/map/map_file.h>
#include <placegraph/pipeline/map/map_floor_plan.h>

#include <algorithm>
#include <memory>

#include "python/src/warnings.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

std::shared_ptr<StoredMap> open(const std::string& path) {
  return std::make_shared<StoredMap>(read_map(map_path_of(path)));
}

std::shared_ptr<StoredMap> from_colmap(const std::string& folder, const std::string& sequence,
                                       bool metric) {
  return std::make_shared<StoredMap>(import_colmap(folder, sequence, metric));
}

Explanation explain(const StoredMap& stored, std::int64_t frame) {
  const std::optional<Explanation> explanation = explain_frame(stored.map, FrameId(frame));
  if (!explanation) throw ArgumentError(fmt::format("frame: the map has no frame {}", frame));
  return *explanation;
}

Trajectory trajectory(const StoredMap& stored, std::optional<int> component) {
  if (!component) return stored.map.trajectory_optimized();
  const std::vector<MapComponent> components = stored.map.components();
  if (std::ranges::find(components, *component, &MapComponent::number) == components.end())
    throw ArgumentError(fmt::format("component: the map has no component {}", *component));
  return stored.map.trajectory_optimized(*component);
}

nb::object thumbnail(const StoredMap& stored, std::int64_t id) {
  const Keyframe* keyframe = stored.map.find_keyframe(KeyframeId(id));
  if (!keyframe) throw ArgumentError(fmt::format("keyframe: the map has no keyframe {}", id));
  if (keyframe->thumbnail.empty()) return nb::none();
  return nb::bytes(keyframe->thumbnail.data(), keyframe->thumbnail.size());
}

/// The name of a form in Python: that of its flag.
std::string name_of(const MapExportForm& form) {
  std::string name = form.flag.substr(2);
  std::ranges::replace(name, '-', '_');
  return name;
}

/// Names of the forms of `export_files` and what each is.
std::vector<std::pair<std::string, std::string>> export_forms() {
  std::vector<std::pair<std::string, std::string>> forms;
  for (const MapExportForm& form : map_export_forms()) forms.emplace_back(name_of(form), form.what);
  return forms;
}

std::string export_files(const StoredMap& stored, const std::map<std::string, std::string>& paths,
                         std::optional<int> component, bool ascii, double resolution_m, bool walls,
                         std::optional<double> voxel, bool force) {
  MapExportArguments arguments;
  arguments.map = "map";
  arguments.component = component;
  arguments.ascii = ascii;
  arguments.resolution_m = resolution_m;
  arguments.walls = walls;
  arguments.floor_plan = [](const StoredMap& planned) { return plan_of_map(planned); };
  arguments.voxel = voxel;
  arguments.force = force;
  std::size_t known = 0;
  for (const MapExportForm& form : map_export_forms()) {
    const auto path = paths.find(name_of(form));
    arguments.paths.push_back(path == paths.end() ? "" : path->second);
    known += path != paths.end();
  }
  require(known == paths.size(), "paths: the name of a form is unknown");
  require(resolution_m > 0, "resolution_m: it is not positive");
  return to_text(map_export(stored, arguments, {.log = python_warnings(), .progress = {}}));
}

void bind_files(nb::class_<StoredMap>& map) {
  map.def_static("open", &open, "path"_a, nb::call_guard<WithoutGil>(), doc("read_map"))
      .def_static("from_colmap", &from_colmap, "folder"_a, "sequence"_a, "metric"_a = false,
                  nb::call_guard<WithoutGil>(),
                  "The map of a COLMAP model in a folder, whose images are in a sequence.")
      .def(
          "save", [](const StoredMap& s, const std::string& path) { write_map(path, s); }, "path"_a,
          nb::call_guard<WithoutGil>(), doc("write_map"))
      .def_static("export_forms", &export_forms,
                  "Names of the forms of `export_files`, each with what it is.")
      .def("export_files", &export_files, "paths"_a, "component"_a = nb::none(), "ascii"_a = false,
           "resolution_m"_a = 0.05, "walls"_a = false, "voxel"_a = nb::none(), "force"_a = false,
           nb::call_guard<WithoutGil>(),
           "Writes parts of the map as files, `paths` by the names of their forms; a summary.");
}

void bind_origin(nb::class_<StoredMap>& map) {
  map.def_prop_ro(
         "metric", [](const StoredMap& s) { return s.map.metric; }, doc("Map::metric"))
      .def_prop_rw(
          "sequence", [](const StoredMap& s) { return s.origin.sequence; },
          [](StoredMap& s, const std::string& path) { s.origin.sequence = path; },
          doc("MapOrigin::sequence"))
      .def_prop_ro(
          "sensor", [](const StoredMap& s) { return s.origin.sensor; }, doc("MapOrigin::sensor"))
      .def_prop_ro(
          "lens_k1", [](const StoredMap& s) { return s.origin.lens_k1; }, doc("MapOrigin::lens_k1"))
      .def_prop_ro(
          "options_yaml", [](const StoredMap& s) { return s.origin.options; },
          doc("MapOrigin::options"))
      .def_prop_ro(
          "calibration", [](const StoredMap& s) { return s.origin.calibration; },
          doc("MapOrigin::calibration"))
      .def_ro("finished", &StoredMap::finished, doc("StoredMap::finished"))
      .def_ro("judgement", &StoredMap::judgement,
              "Judgement of the run; None if it was not written.");
}

void bind_content(nb::class_<StoredMap>& map) {
  const auto table = [&map](const char* name, auto function, const char* text) {
    map.def(
        name, [function](const StoredMap& s) { return function(s.map); }, text);
  };
  map.def("trajectory", &trajectory, "component"_a = nb::none(), doc("Map::trajectory_optimized"))
      .def_prop_ro(
          "trajectory_online",
          [](const StoredMap& s) -> const Trajectory& { return s.map.trajectory_online; },
          nb::rv_policy::reference_internal, doc("Map::trajectory_online"))
      .def_prop_ro(
          "main_component", [](const StoredMap& s) { return s.map.main_component(); },
          doc("Map::main_component"))
      .def_prop_ro(
          "frame_count", [](const StoredMap& s) { return s.map.frames.size(); },
          "Number of frames.");
  table("frame_table", &frame_table, "Columns of the frames.");
  table("keyframe_table", &keyframe_table, "Columns of the keyframes.");
  table("landmark_table", &landmark_table, "Columns of the landmarks.");
  table("observation_table", &observation_table, "Columns of the observations.");
  table("loop_table", &loop_table, "Columns of the loop candidates.");
  table("place_rows", &place_rows, "The places, a dictionary each.");
  table("edge_rows", &edge_rows, "The constraints between places, a dictionary each.");
  table("component_rows", &component_rows, "The components, a dictionary each.");
  map.def(
         "feature_table",
         [](const StoredMap& s, std::int64_t keyframe) { return feature_table(s.map, keyframe); },
         "keyframe"_a, "Columns of the features of a keyframe.")
      .def("thumbnail", &thumbnail, "keyframe"_a,
           nb::sig("def thumbnail(self, keyframe: int) -> bytes | None"),
           "The image of a keyframe as a small JPEG file, bytes; None if it is not stored.")
      .def(
          "pose_graph", [](const StoredMap& s) { return s.map.place_graph.pose_graph(); },
          nb::call_guard<WithoutGil>(), doc("PlaceGraph::pose_graph"))
      .def("explain", &explain, "frame"_a, nb::call_guard<WithoutGil>(),
           "Explains the pose of a frame, or why it has none. The whole place graph is factorized "
           "once for the covariance. ArgumentError if the map has no such frame.");
}

}  // namespace

void bind_maps(nb::module_& m) {
  bind_explanation(m);
  nb::class_<StoredMap> map(m, "Map", doc("StoredMap"));
  bind_files(map);
  bind_origin(map);
  bind_content(map);
}

}  // namespace placegraph::python
