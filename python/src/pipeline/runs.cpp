#include "python/src/pipeline/runs.h"

#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/models/scene_model_file.h>
#include <placegraph/pipeline/recognizers/image_recognizer.h>
#include <placegraph/pipeline/run.h>
#include <placegraph/pipeline/run_notes.h>

#include <nanobind/stl/shared_ptr.h>
#include <cmath>
#include <filesystem>

#include "python/src/graph/ids.h"
#include "python/src/graph/maps.h"
#include "python/src/options.h"
#include "python/src/pipeline/events.h"
#include "python/src/pipeline/recognizer.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// A run without its map, which is apart.
struct PythonRun {
  std::shared_ptr<StoredMap> map;
  RunResult result;
  std::vector<DataNote> notes;  ///< of the data, the options and the motion
};

/// The functions of Python that a run calls.
struct Callbacks {
  nb::object on_event, on_frame, on_log, stop;

  void check() const {
    require_callable(on_event, "on_event");
    require_callable(on_frame, "on_frame");
    require_callable(on_log, "on_log");
    require_callable(stop, "stop");
  }
  /// Whether the run shall end; throws for Ctrl-C.
  bool stops() const {
    const nb::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    return !stop.is_none() && nb::cast<bool>(nb::bool_(stop()));
  }
  void report(std::size_t done, std::size_t total, const FrameResult& result) const {
    const nb::gil_scoped_acquire gil;
    on_frame(done, total, result);
  }
};

PythonRun finished(RunResult result, const Dataset& dataset, const RunOptions& options,
                   const std::string& sequence) {
  std::vector<DataNote> notes = notes_of(dataset, options);
  const auto more = notes_of_motion(result, result.map.trajectory_optimized());
  notes.insert(notes.end(), more.begin(), more.end());
  auto stored = std::make_shared<StoredMap>();
  stored->judgement = judge(result, notes, kLeastPosed);
  stored->map = std::move(result.map);
  stored->finished = !result.stopped && !result.broken_off;
  stored->origin.sequence = sequence;
  stored->origin.calibration = result.calibration;
  stored->origin.sensor = result.sensor;
  stored->origin.lens_k1 = result.lens_k1;
  RunOptions kept = options;
  kept.threads = RunOptions().threads;  // the map does not depend on it
  stored->origin.options = dump_options(kept);
  if (kept.slam.views.enabled) stored->origin.view_options = dump_options(kept.slam.views.cues);
  return {std::move(stored), std::move(result), std::move(notes)};
}

PythonRun run(const Dataset& dataset, const OptionSet& options, const std::string& sequence,
              const std::optional<std::string>& map_file, bool resume,
              const std::optional<std::string>& surfaces, const nb::object& recognizer,
              const nb::object& on_event, const nb::object& on_frame, const nb::object& on_log,
              const nb::object& stop) {
  RunOptions copy = options_in<RunOptions>(options, "options");
  const Callbacks callbacks{on_event, on_frame, on_log, stop};
  callbacks.check();
  require(!resume || map_file, "resume: a map_file is needed, from which the run goes on");
  require_no_recognizer(copy.describer, "options");
  const OwnRecognizer own = recognizer_of(recognizer, copy.describer);
  copy.describer.recognizer = own.name;
  std::optional<PythonEvents> events;
  RunInputs inputs;
  inputs.recognizer = own.retrieval;
  if (!on_event.is_none()) inputs.events = &events.emplace(on_event);
  if (!on_frame.is_none())
    inputs.progress = [&](std::size_t done, std::size_t total, const FrameResult& result) {
      callbacks.report(done, total, result);
    };
  inputs.log = log_sink(callbacks.on_log);
  inputs.stop = [&] { return callbacks.stops(); };
  if (map_file) inputs.map_file = MapFile{*map_file, sequence, resume};
  const WithoutGil released;
  if (surfaces) inputs.surfaces = surfaces_in(*surfaces);
  PythonRun result = finished(run_sequence(dataset, copy, inputs), dataset, copy, sequence);
  if (map_file && std::filesystem::exists(*map_file))
    write_judgement(*map_file, *result.map->judgement);
  return result;
}

nb::tuple unposed_of(const PythonRun& run) {
  nb::list rows;
  for (const UnposedFrames& each : run.result.unposed)
    rows.append(nb::make_tuple(each.reason, each.count));
  return nb::tuple(rows);
}

}  // namespace

std::int64_t nanoseconds(double stamp_s) {
  require(std::isfinite(stamp_s) && std::abs(stamp_s) < 9e9, "stamp: it is no time in seconds");
  return std::llround(stamp_s * 1e9);
}

std::shared_ptr<const SceneModel> surfaces_in(const std::string& path) {
  SceneModel model = read_scene_model(path);
  if (model.kind != SceneModel::Kind::kSurfaces)
    throw FileError(path, "is no model of surfaces but of the classes of streets");
  return std::make_shared<const SceneModel>(std::move(model));
}

nb::dict stage_table(const std::vector<StageTime>& stages) {
  nb::dict table;
  for (const StageTime& stage : stages)
    table[stage.name.c_str()] = nb::make_tuple(stage.cpu_s, stage.calls);
  return table;
}

void bind_runs(nb::module_& m) {
  nb::class_<PythonRun>(m, "Run", doc("RunResult"))
      .def_prop_ro(
          "map", [](const PythonRun& r) { return r.map; }, "The map.")
      .def_prop_ro(
          "sensor", [](const PythonRun& r) { return r.result.sensor; }, doc("RunResult::sensor"))
      .def_prop_ro(
          "lens_k1", [](const PythonRun& r) { return r.result.lens_k1; }, doc("RunResult::lens_k1"))
      .def_prop_ro(
          "broken_off", [](const PythonRun& r) { return r.result.broken_off; },
          doc("RunResult::broken_off"))
      .def_prop_ro(
          "stopped", [](const PythonRun& r) { return r.result.stopped; },
          "Whether `stop` ended the run: the map holds the frames before.")
      .def_prop_ro(
          "resumed_at", [](const PythonRun& r) { return r.result.resumed_at; },
          doc("RunResult::resumed_at"))
      .def_prop_ro(
          "notes", [](const PythonRun& r) { return TupleOf{r.notes}; },
          "Doubts about the images, the calibration and the motion.")
      .def_prop_ro(
          "stages", [](const PythonRun& r) { return stage_table(r.result.stages); },
          nb::sig("def stages(self) -> dict[str, tuple[float, int]]"),
          "CPU time [s] and calls of reading images and of each stage of Slam.")
      .def_prop_ro("unposed", &unposed_of,
                   nb::sig("def unposed(self) -> tuple[tuple[str, int], ...]"),
                   doc("RunResult::unposed"));
  m.def("run", &run, "dataset"_a, "options"_a, "sequence"_a, nb::kw_only(),
        "map_file"_a = nb::none(), "resume"_a = false, "surfaces"_a = nb::none(),
        "recognizer"_a = nb::none(), "on_event"_a = nb::none(), "on_frame"_a = nb::none(),
        "on_log"_a = nb::none(), "stop"_a = nb::none(), doc("run_sequence"));
}

}  // namespace placegraph::python
