#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/writers/world_writer.h>

#include "python/src/bindings.h"
#include "python/src/graph/images.h"
#include "python/src/options.h"
#include "python/src/pipeline/events.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

SyntheticOptions options_of(const std::string& world, const std::string& difficulty,
                            std::uint64_t seed, int frames, double duration_s,
                            const std::optional<std::pair<int, int>>& size, int threads,
                            const nb::dict& defects) {
  SyntheticOptions options;
  options.world = world;
  options.difficulty = synthetic::difficulty_from(difficulty);
  options.seed = seed;
  options.frames = frames;
  options.duration_s = duration_s;
  if (size) {
    require(size->first > 0 && size->second > 0, "size: width and height must be positive");
    std::tie(options.width, options.height) = *size;
  }
  options.threads = threads;
  OptionSetOf<SyntheticDefects> set;
  for (const auto& [key, value] : defects) set.set(nb::cast<std::string>(key), value);
  options.defects = set.options();
  options.check();
  return options;
}

nb::dict defect_set(const std::string& name) {
  const OptionSetOf<SyntheticDefects> set(defects_from(name));
  nb::dict values;
  for (const OptionEntry& entry : set.entries()) values[entry.path.c_str()] = set.get(entry.path);
  return values;
}

/// What a sequence holds for a sensor, or what the world usually has.
SyntheticContents contents_for(const SyntheticWorld& world, const std::optional<Sensor>& sensor) {
  if (!sensor) return usual_contents(world);
  SyntheticContents contents;
  contents.right = *sensor == Sensor::kStereo;
  contents.depth = *sensor == Sensor::kRgbd;
  return contents;
}

SyntheticFrame render(const SyntheticWorld& world, std::size_t index,
                      const std::optional<Sensor>& sensor, bool labels, bool planes, bool flow) {
  require(index < world.size(), "index: the world has " + std::to_string(world.size()) + " frames");
  SyntheticContents contents = contents_for(world, sensor);
  contents.labels = labels;
  contents.planes = planes;
  contents.flow = flow;
  return world.render(index, contents);
}

void write(const SyntheticWorld& world, const std::string& folder,
           const std::optional<Sensor>& sensor, bool labels, bool flow, int threads, bool force,
           const nb::object& on_frame) {
  require_callable(on_frame, "on_frame");
  require(threads > 0, "threads: must be positive");
  SequenceWriterOptions options;
  options.contents = contents_for(world, sensor);
  options.contents.labels = options.contents.planes = labels;
  options.contents.flow = flow;
  options.threads = threads;
  options.force = force;
  const auto progress = [&](std::size_t done) {
    const nb::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    if (!on_frame.is_none()) on_frame(done, world.size());
  };
  const WithoutGil released;
  write_world(world, folder, options, progress);
}

/// The calibration of the images of a sensor: without what it lacks.
Calibration calibration_for(const SyntheticWorld& world, const std::optional<Sensor>& sensor) {
  const SyntheticContents contents = contents_for(world, sensor);
  Calibration calibration = world.calibration();
  if (!contents.right) calibration.baseline_m = 0;
  if (!contents.depth || contents.right) calibration.depth.reset();
  return calibration;
}

}  // namespace

void bind_synthetic(nb::module_& m) {
  nb::class_<SyntheticFrame>(m, "SyntheticFrame", doc("SyntheticFrame"))
      .def_ro("frame", &SyntheticFrame::frame, doc("SyntheticFrame::frame"))
      .def_prop_ro(
          "labels", [](const SyntheticFrame& f) { return array_of(f.labels); },
          nb::sig("def labels(self) -> numpy.typing.NDArray[numpy.uint8] | None"),
          "Class of each pixel, H x W uint8, or None; see SyntheticWorld.class_names.")
      .def_prop_ro(
          "planes", [](const SyntheticFrame& f) { return array_of(f.planes); },
          nb::sig("def planes(self) -> numpy.typing.NDArray[numpy.uint16] | None"),
          "Number of the plane of each pixel, H x W uint16, 0 = no plane; or None.")
      .def_prop_ro(
          "flow", [](const SyntheticFrame& f) { return array_of(f.flow); },
          nb::sig("def flow(self) -> numpy.typing.NDArray[numpy.float32] | None"),
          "Displacement to the next frame [px], H x W x 2 float32; NaN where a pixel has none; "
          "None for the last frame.");
  nb::class_<SyntheticWorld>(m, "SyntheticWorld", doc("SyntheticWorld"))
      .def(
          "__init__",
          [](SyntheticWorld* self, const std::string& world, const std::string& difficulty,
             std::uint64_t seed, int frames, double duration_s,
             const std::optional<std::pair<int, int>>& size, int threads, const nb::dict& defects) {
            const SyntheticOptions options =
                options_of(world, difficulty, seed, frames, duration_s, size, threads, defects);
            const WithoutGil released;
            new (self) SyntheticWorld(options);
          },
          "world"_a, nb::kw_only(), "difficulty"_a = "standard", "seed"_a = 1, "frames"_a = 0,
          "duration_s"_a = 0.0, "size"_a = nb::none(), "threads"_a = 1, "defects"_a = nb::dict(),
          nb::sig("def __init__(self, world: str, *, difficulty: str = 'standard', seed: int = 1, "
                  "frames: int = 0, duration_s: float = 0.0, "
                  "size: tuple[int, int] | None = None, threads: int = 1, "
                  "defects: dict[str, float] = {}) -> None"))
      .def_static("worlds", &SyntheticWorld::worlds, doc("SyntheticWorld::worlds"))
      .def_static("defect_set", &defect_set, "name"_a,
                  nb::sig("def defect_set(name: str) -> dict[str, float]"),
                  "Values of the defects of a set, by their names.")
      .def_static("class_names", &SyntheticWorld::class_names, "Names of the classes of labels.")
      .def_prop_ro("name", &SyntheticWorld::name, "Name of the world.")
      .def("__len__", &SyntheticWorld::size)
      .def("calibration", &calibration_for, "sensor"_a = nb::none(),
           "Calibration of the images of a sensor; None: of those that the world usually has.")
      .def("stamp_ns", &SyntheticWorld::stamp_ns, "index"_a, "Time of a frame [ns].")
      .def_prop_ro("ground_truth", &SyntheticWorld::ground_truth, nb::rv_policy::move,
                   doc("SyntheticWorld::ground_truth"))
      .def("render", &render, "index"_a, "sensor"_a = nb::none(), nb::kw_only(), "labels"_a = false,
           "planes"_a = false, "flow"_a = false, nb::call_guard<WithoutGil>(),
           "Renders a frame with the images that a sensor needs, and more if asked for.")
      .def("write", &write, "folder"_a, "sensor"_a = nb::none(), nb::kw_only(), "labels"_a = false,
           "flow"_a = false, "threads"_a = 1, "force"_a = false, "on_frame"_a = nb::none(),
           "Writes a whole sequence: a flight in EuRoC's layout, of any other world in "
           "KITTI's.\n\n"
           "Everything is written to a folder beside `folder` that is renamed when complete. "
           "`on_frame(done, frames)` is called after each frame, never by two threads at once. "
           "Raises ArgumentError if `folder` exists and is not an empty folder (unless `force`), "
           "or for contents that a flight lacks; FileError if something cannot be written.");
}

}  // namespace placegraph::python
