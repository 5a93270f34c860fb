#include <fmt/format.h>
#include <nanobind/stl/shared_ptr.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/measurements/measured_motion.h>
#include <placegraph/io/models/scene_model_file.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/local_map/lens_distortion.h>
#include <placegraph/pipeline/run.h>
#include <placegraph/pipeline/slam.h>

#include <cmath>
#include <memory>

#include "python/src/graph/images.h"
#include "python/src/graph/maps.h"
#include "python/src/options.h"
#include "python/src/pipeline/events.h"
#include "python/src/pipeline/recognizer.h"
#include "python/src/pipeline/runs.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// Slam with the objects of Python that it uses. All functions are called with the GIL, and release
/// it while Slam works.
class PythonSlam {
 public:
  PythonSlam(const OptionSet& options, const Calibration& calibration, nb::object on_event,
             nb::object on_log, std::shared_ptr<MeasuredMotion> motion,
             const std::optional<std::string>& surfaces, const nb::object& recognizer)
      : options_(options_in<SlamOptions>(options, "options")),
        calibration_(calibration),
        on_log_(std::move(on_log)),
        recognizer_(recognizer_of(recognizer)) {
    require_callable(on_event, "on_event");
    require_callable(on_log_, "on_log");
    if (!on_event.is_none()) events_ = std::make_unique<PythonEvents>(std::move(on_event));
    SlamInputs inputs;
    inputs.motion = std::move(motion);
    if (surfaces) inputs.surfaces = surfaces_in(*surfaces);
    inputs.recognizer = recognizer_.retrieval;
    inputs.events = events_.get();
    inputs.log = log_sink(on_log_);
    slam_.emplace(options_, calibration_, inputs);
  }

  FrameResult add_frame(nb::handle image, double stamp_s, nb::handle right, nb::handle depth,
                        nb::handle colour, nb::handle mask) {
    Frame frame;
    frame.id = FrameId(next_);
    frame.stamp_ns = nanoseconds(stamp_s);
    frame.image = grey_image(image, "image");
    if (!right.is_none()) frame.right = grey_image(right, "right");
    if (!depth.is_none()) frame.depth = depth_image(depth, "depth");
    if (!colour.is_none()) frame.colour = colour_image(colour, "colour");
    if (!mask.is_none()) frame.mask = grey_image(mask, "mask");
    // Tracking keeps the images, and the caller may overwrite his.
    for (Image* each : {&frame.image, &frame.right, &frame.depth, &frame.colour, &frame.mask})
      if (!each->empty()) *each = each->clone();
    return add(frame);
  }

  FrameResult add(const Frame& frame) {
    return call([&] {
      const FrameResult result = slam_->add_frame(frame);
      next_ = frame.id.value() + 1;
      return result;
    });
  }

  void resume(const StoredMap& map, const Frame& last, const nb::object& frame_of) {
    require_callable(frame_of, "frame_of");
    Slam::FrameOf frames;
    if (!frame_of.is_none())
      frames = [&](FrameId id) {
        const nb::gil_scoped_acquire gil;
        return nb::cast<Frame>(frame_of(id.value()));
      };
    call([&] {
      slam_->resume(map.map, map.history, last, frames);
      next_ = last.id.value() + 1;
      return 0;
    });
  }

  std::shared_ptr<StoredMap> snapshot() {
    return call([&] { return stored(slam_->snapshot(), std::nullopt); });
  }
  std::shared_ptr<StoredMap> finish() {
    return call([&] {
      RunResult run;
      run.sensor = sensor();
      run.calibration = calibration_;
      run.map = slam_->finish();
      run.notes = slam_->notes();
      run.odometry_error = slam_->odometry_error();
      const Judgement judgement = judge(run, {}, kLeastPosed);
      return stored(std::move(run.map), judgement);
    });
  }

  FrameView view() {
    return call([&] { return slam_->view(); });
  }
  std::vector<DataNote> notes() {
    return call([&] { return slam_->notes(); });
  }
  LensDistortion lens() {
    return call([&] { return slam_->lens(); });
  }
  nb::object overlay_mask() {
    return array_of(call([&] { return slam_->overlay_mask(); }));
  }
  nb::dict stages() {
    return stage_table(call([&] { return slam_->stages(); }));
  }

  /// The objects of Python, for the search for cycles.
  int traverse(visitproc visit, void* arg) {
    if (events_) Py_VISIT(events_->function().ptr());
    if (recognizer_.held) Py_VISIT(recognizer_.held->object().ptr());
    Py_VISIT(on_log_.ptr());
    return 0;
  }
  void clear() {
    if (events_) events_->clear();
    if (recognizer_.held) recognizer_.held->release();
    on_log_ = nb::none();
  }

 private:
  /// Runs a step without the GIL. Another call meanwhile, from a callback or a thread, is refused.
  template <class Step>
  std::invoke_result_t<const Step&> call(const Step& step) {
    require(!busy_, "Slam: called during another call of the same object");
    busy_ = true;
    struct Idle {
      bool& busy;
      ~Idle() { busy = false; }
    } idle{busy_};
    const WithoutGil released;
    return step();
  }

  Sensor sensor() const {
    return calibration_.baseline_m > 0 ? Sensor::kStereo
           : calibration_.depth        ? Sensor::kRgbd
                                       : Sensor::kMono;
  }

  std::shared_ptr<StoredMap> stored(Map map, const std::optional<Judgement>& judgement) const {
    auto result = std::make_shared<StoredMap>();
    result->map = std::move(map);
    result->judgement = judgement;
    result->origin.calibration = calibration_;
    result->origin.sensor = sensor();
    RunOptions options;
    options.slam = options_;
    result->origin.options = dump_options(options);
    if (options_.views.enabled) result->origin.view_options = dump_options(options_.views.cues);
    return result;
  }

  SlamOptions options_;
  Calibration calibration_;
  nb::object on_log_;
  std::unique_ptr<PythonEvents> events_;
  OwnRecognizer recognizer_;
  std::optional<Slam> slam_;
  std::int64_t next_ = 0;
  bool busy_ = false;
};

int traverse_slam(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  return nb::inst_ready(self) ? nb::inst_ptr<PythonSlam>(self)->traverse(visit, arg) : 0;
}

int clear_slam(PyObject* self) {
  if (nb::inst_ready(self)) nb::inst_ptr<PythonSlam>(self)->clear();
  return 0;
}

PyType_Slot kSlots[] = {{Py_tp_traverse, reinterpret_cast<void*>(&traverse_slam)},
                        {Py_tp_clear, reinterpret_cast<void*>(&clear_slam)},
                        {0, nullptr}};

}  // namespace

void bind_slam(nb::module_& m) {
  nb::class_<LensDistortion>(m, "LensDistortion", doc("LensDistortion"))
      .def_ro("k1", &LensDistortion::k1, doc("LensDistortion::k1"))
      .def_ro("sigma_k1", &LensDistortion::sigma_k1, doc("LensDistortion::sigma_k1"))
      .def_ro("effect", &LensDistortion::effect, doc("LensDistortion::effect"))
      .def_ro("stretches", &LensDistortion::stretches, doc("LensDistortion::stretches"));
  nb::class_<PythonSlam>(m, "SlamCore", nb::type_slots(kSlots), doc("Slam"))
      .def(nb::init<const OptionSet&, const Calibration&, nb::object, nb::object,
                    std::shared_ptr<MeasuredMotion>, const std::optional<std::string>&,
                    const nb::object&>(),
           "options"_a, "calibration"_a, nb::kw_only(), "on_event"_a = nb::none(),
           "on_log"_a = nb::none(), "motion"_a = nb::none(), "surfaces"_a = nb::none(),
           "recognizer"_a = nb::none())
      .def("add_frame", &PythonSlam::add_frame, "image"_a.none(), "stamp"_a, nb::kw_only(),
           "right"_a = nb::none(), "depth"_a = nb::none(), "colour"_a = nb::none(),
           "mask"_a = nb::none(), "Processes a frame of arrays, which are copied; stamp [s].")
      .def("add", &PythonSlam::add, "frame"_a, "Processes a frame, whose images are shared.")
      .def("resume", &PythonSlam::resume, "map"_a, "last"_a, "frame_of"_a = nb::none(),
           "Goes on with the saved map of an interrupted run; must be called before the first "
           "frame.\n\n"
           "`last` is the frame of the map's last keyframe; it is processed again, and tracking "
           "restarts there as after a loss. Records of later frames are dropped. Raises "
           "ArgumentError if the map is inconsistent, if `last` is another frame, or if frames "
           "have already been added; the object must then not be used any more. A `recognizer` "
           "needs the images of the keyframes: `frame_of` returns the frame of a number.")
      .def("snapshot", &PythonSlam::snapshot, doc("Slam::snapshot"))
      .def("finish", &PythonSlam::finish, doc("Slam::finish"))
      .def("view", &PythonSlam::view, doc("Slam::view"))
      .def("notes", &PythonSlam::notes, doc("Slam::notes"))
      .def("lens", &PythonSlam::lens, doc("Slam::lens"))
      .def("overlay_mask", &PythonSlam::overlay_mask,
           nb::sig("def overlay_mask(self) -> numpy.typing.NDArray[numpy.uint8] | None"),
           "H x W uint8, 0 in regions fixed to the camera; None as long as nothing is found. "
           "Later frames are masked by it.")
      .def("stages", &PythonSlam::stages,
           nb::sig("def stages(self) -> dict[str, tuple[float, int]]"), doc("Slam::stages"));
}

}  // namespace placegraph::python
