#include <placegraph/eval/offsets/offset_estimation.h>

#include "python/src/arrays.h"
#include "python/src/eigen_arrays.h"
#include "python/src/frontend/functions.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

std::vector<std::string> free_texts(const OffsetEstimate& offsets) {
  std::vector<std::string> texts;
  for (const FreeOffset& free : offsets.free) texts.push_back(free.text);
  return texts;
}

OffsetEstimate offsets_of(const Trajectory& truth, const Trajectory& estimate, bool body,
                          bool time, bool scale, double start_s) {
  OffsetOptions options;
  options.body = body;
  options.time = time;
  options.scale = scale;
  options.start_s = start_s;
  return estimate_offsets(truth, estimate, options);
}

}  // namespace

void bind_offsets(nb::module_& m) {
  using Offsets = OffsetEstimate;
  nb::class_<Offsets> offsets(m, "OffsetEstimate", doc("OffsetEstimate"));
  bind_outcome(offsets);
  offsets
      .def_ro("T_estimate_truth", &Offsets::T_estimate_truth,
              doc("OffsetEstimate::T_estimate_truth"))
      .def_ro("time_s", &Offsets::time_s, doc("OffsetEstimate::time_s"))
      .def_ro("scale", &Offsets::scale, doc("OffsetEstimate::scale"))
      .def_ro("lever_arm_deviation_m", &Offsets::lever_arm_deviation_m,
              doc("OffsetEstimate::lever_arm_deviation_m"))
      .def_ro("rotation_deviation_rad", &Offsets::rotation_deviation_rad,
              doc("OffsetEstimate::rotation_deviation_rad"))
      .def_ro("time_deviation_s", &Offsets::time_deviation_s,
              doc("OffsetEstimate::time_deviation_s"))
      .def_prop_ro("free", &free_texts, "What the motions do not show, a line each.")
      .def("to_json", [](const Offsets& o) { return to_json(o); },
           "The estimate as `placegraph eval --estimate --json` prints it.")
      .def("__repr__", [](const Offsets& o) { return to_text(o); });
  m.def("estimate_offsets", &offsets_of, "truth"_a, "estimate"_a, "body"_a, "time"_a,
        "scale"_a = false, "start_s"_a = 0.0, nb::call_guard<WithoutGil>(),
        doc("estimate_offsets"));
  m.def("with_offsets", &with_offsets, "estimate"_a, "offsets"_a, nb::call_guard<WithoutGil>(),
        doc("with_offsets"));
}

}  // namespace placegraph::python
