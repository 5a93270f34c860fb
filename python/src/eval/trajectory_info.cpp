#include <fmt/format.h>
#include <placegraph/eval/info/trajectory_info.h>

#include "python/src/arrays.h"
#include "python/src/frontend/functions.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

void bind_parts(nb::module_& m) {
  nb::class_<Spread> spread(m, "Spread", doc("Spread"));
  spread.def_ro("count", &Spread::count, doc("Spread::count"))
      .def_ro("min", &Spread::min, doc("Spread::min"))
      .def_ro("p05", &Spread::p05, doc("Spread::p05"))
      .def_ro("median", &Spread::median, doc("Spread::median"))
      .def_ro("p95", &Spread::p95, doc("Spread::p95"))
      .def_ro("max", &Spread::max, doc("Spread::max"))
      .def("__repr__", [](const Spread& s) {
        return fmt::format("<placegraph.Spread: median {:.6g}, {:.6g} to {:.6g} of {}>", s.median,
                           s.min, s.max, s.count);
      });
  nb::class_<FrameSpan> span(m, "FrameSpan", doc("FrameSpan"));
  span.def_ro("first", &FrameSpan::first, doc("FrameSpan::first"))
      .def_ro("last", &FrameSpan::last, doc("FrameSpan::last"))
      .def_ro("first_ns", &FrameSpan::first_ns, doc("FrameSpan::first_ns"))
      .def_ro("last_ns", &FrameSpan::last_ns, doc("FrameSpan::last_ns"))
      .def_prop_ro("length_ns", &FrameSpan::length_ns, doc("FrameSpan::length_ns"))
      .def("__repr__", [](const FrameSpan& s) {
        return fmt::format("<placegraph.FrameSpan: frames {} to {}>", s.first, s.last);
      });
  nb::class_<ImplausibleStep> step(m, "ImplausibleStep", doc("ImplausibleStep"));
  step.def_ro("span", &ImplausibleStep::span, doc("ImplausibleStep::span"))
      .def_ro("distance_m", &ImplausibleStep::distance_m, doc("ImplausibleStep::distance_m"))
      .def_ro("angle_deg", &ImplausibleStep::angle_deg, doc("ImplausibleStep::angle_deg"))
      .def_ro("times_faster", &ImplausibleStep::times_faster, doc("ImplausibleStep::times_faster"));
}

void bind_axes(nb::module_& m) {
  nb::class_<MotionPlane> plane(m, "MotionPlane", doc("MotionPlane"));
  bind_outcome(plane);
  plane
      .def_prop_ro(
          "axis", [](const MotionPlane& p) { return std::string(1, p.axis); },
          doc("MotionPlane::axis"))
      .def_ro("tilt_deg", &MotionPlane::tilt_deg, doc("MotionPlane::tilt_deg"))
      .def_ro("rms_m", &MotionPlane::rms_m, doc("MotionPlane::rms_m"))
      .def_ro("share", &MotionPlane::share, doc("MotionPlane::share"));
  nb::class_<ForwardAxis> forward(m, "ForwardAxis", doc("ForwardAxis"));
  bind_outcome(forward);
  forward.def_ro("axis", &ForwardAxis::axis, doc("ForwardAxis::axis"))
      .def_ro("angle_deg", &ForwardAxis::angle_deg, doc("ForwardAxis::angle_deg"))
      .def_ro("steadiness", &ForwardAxis::steadiness, doc("ForwardAxis::steadiness"))
      .def_ro("convention", &ForwardAxis::convention, doc("ForwardAxis::convention"));
  nb::class_<Likelihood> likelihood(m, "Likelihood", doc("Likelihood"));
  bind_outcome(likelihood);
  likelihood.def_ro("answer", &Likelihood::answer, doc("Likelihood::answer"))
      .def_ro("as_read", &Likelihood::as_read, doc("Likelihood::as_read"));
}

}  // namespace

void bind_trajectory_info(nb::module_& m) {
  bind_parts(m);
  bind_axes(m);
  using Info = TrajectoryInfo;
  nb::class_<Info> info(m, "TrajectoryInfo", doc("TrajectoryInfo"));
  info.def_ro("frames", &Info::frames, doc("TrajectoryInfo::frames"))
      .def_ro("posed", &Info::posed, doc("TrajectoryInfo::posed"))
      .def_ro("has_times", &Info::has_times, doc("TrajectoryInfo::has_times"))
      .def_ro("has_orientation", &Info::has_orientation, doc("TrajectoryInfo::has_orientation"))
      .def_ro("first_ns", &Info::first_ns, doc("TrajectoryInfo::first_ns"))
      .def_ro("last_ns", &Info::last_ns, doc("TrajectoryInfo::first_ns"))
      .def_ro("length_m", &Info::length_m, doc("TrajectoryInfo::length_m"))
      .def_ro("spacing_s", &Info::spacing_s, doc("TrajectoryInfo::spacing_s"))
      .def_ro("speed", &Info::speed, doc("TrajectoryInfo::speed"))
      .def_ro("turning_deg", &Info::turning_deg, doc("TrajectoryInfo::turning_deg"))
      .def_ro("repeated", &Info::repeated, doc("TrajectoryInfo::repeated"))
      .def_prop_ro("gaps", as_tuple(&Info::gaps), doc("TrajectoryInfo::gaps"))
      .def_prop_ro("stops", as_tuple(&Info::stops), doc("TrajectoryInfo::stops"))
      .def_prop_ro("jumps", as_tuple(&Info::jumps), doc("TrajectoryInfo::jumps"))
      .def_ro("plane", &Info::plane, doc("TrajectoryInfo::plane"))
      .def_ro("forward", &Info::forward, doc("TrajectoryInfo::forward"))
      .def_ro("quaternions", &Info::quaternions, doc("TrajectoryInfo::quaternions"))
      .def_ro("length_unit", &Info::length_unit, doc("TrajectoryInfo::length_unit"))
      .def_ro("time_unit", &Info::time_unit, doc("TrajectoryInfo::time_unit"))
      .def_prop_ro("warnings", as_tuple(&Info::warnings), doc("TrajectoryInfo::warnings"))
      .def("__repr__", [](const Info& each) {
        return fmt::format("<placegraph.TrajectoryInfo: {} of {} frames posed, {} gaps, {} stops, "
                           "{} jumps>",
                           each.posed, each.frames, each.gaps.size(), each.stops.size(),
                           each.jumps.size());
      });
  m.def("trajectory_info", &trajectory_info, "trajectory"_a, nb::call_guard<WithoutGil>(),
        doc("trajectory_info"));
}

}  // namespace placegraph::python
