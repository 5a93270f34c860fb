#include "python/src/pipeline/events.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/tracking/frame_result.h>

#include <initializer_list>

#include "python/src/arrays.h"
#include "python/src/graph/ids.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// Shows the named properties of a class.
void describe(nb::handle type, std::initializer_list<const char*> names) {
  nb::list fields;
  for (const char* name : names) fields.append(name);
  const nb::tuple shown(fields);
  const nb::object text = nb::cpp_function(
      [shown](nb::handle self) {
        std::string result = nb::cast<std::string>(nb::type_name(self.type()));
        result = result.substr(result.rfind('.') + 1) + "(";
        for (nb::handle name : shown)
          result +=
              fmt::format("{}{}={}", result.back() == '(' ? "" : ", ", nb::cast<std::string>(name),
                          nb::cast<std::string>(nb::repr(self.attr(name))));
        return result + ")";
      },
      nb::scope(type), nb::name("__repr__"), nb::is_method(), nb::sig("def __repr__(self) -> str"));
  nb::setattr(type, "__repr__", text);
}

void bind_frame_result(nb::module_& m) {
  nb::enum_<TrackingState>(m, "TrackingState", doc("TrackingState"))
      .value("INITIALIZING", TrackingState::kInitializing,
             "No pose yet: the map has not begun, or its metric scale is not yet known.")
      .value("TRACKING", TrackingState::kTracking, "The frame has a pose.")
      .value("LOST", TrackingState::kLost, "No pose, although a map exists.");
  nb::class_<FrameResult> result(m, "FrameResult", doc("FrameResult"));
  result
      .def_prop_ro(
          "ok", [](const FrameResult& r) { return static_cast<bool>(r.outcome); },
          "Whether the frame has a pose that needs no confirmation.")
      .def_prop_ro(
          "reason", [](const FrameResult& r) { return r.outcome.reason; },
          "Why it is not ok; empty otherwise.")
      .def_ro("frame", &FrameResult::frame, doc("FrameResult::frame"))
      .def_ro("state", &FrameResult::state, doc("FrameResult::state"))
      .def_ro("T_map_cam", &FrameResult::T_map_cam, doc("FrameResult::T_map_cam"))
      .def_ro("keyframe", &FrameResult::keyframe, doc("FrameResult::keyframe"))
      .def_ro("new_place", &FrameResult::new_place, doc("FrameResult::new_place"))
      .def_ro("inliers", &FrameResult::inliers, doc("FrameResult::inliers"))
      .def_ro("confidence", &FrameResult::confidence, doc("FrameResult::confidence"))
      .def_ro("component", &FrameResult::component, doc("FrameResult::component"))
      .def_ro("loops_accepted", &FrameResult::loops_accepted, doc("FrameResult::loops_accepted"));
  describe(result, {"frame", "ok", "reason", "inliers"});
}

void bind_loop(nb::module_& m) {
  nb::class_<LoopRecord> loop(m, "LoopRecord", doc("LoopRecord"));
  loop.def_prop_ro("accepted", &LoopRecord::accepted, doc("LoopRecord::accepted"))
      .def_ro("query_frame", &LoopRecord::query_frame, "Frame of the later keyframe.")
      .def_ro("match_frame", &LoopRecord::match_frame, "Frame of the earlier keyframe.")
      .def_prop_ro(
          "stage", [](const LoopRecord& r) { return to_string(r.stage); },
          "Test that refused it, or 'accepted' or 'manual'.")
      .def_prop_ro(
          "model", [](const LoopRecord& r) { return to_string(r.model); }, doc("LoopRecord::model"))
      .def_ro("inliers", &LoopRecord::inliers, doc("LoopRecord::inliers"))
      .def_ro("lines", &LoopRecord::lines, doc("LoopRecord::lines"))
      .def_ro("T_match_query", &LoopRecord::T_match_query, doc("LoopRecord::T_match_query"))
      .def_ro("similarity", &LoopRecord::similarity, doc("LoopRecord::similarity"))
      .def_ro(
          "probability", &LoopRecord::probability,
          "Estimated probability that both frames show the same place, from all evidence of the "
          "decision.");
  describe(loop, {"query_frame", "match_frame", "accepted", "stage"});
}

void bind_place_events(nb::module_& m) {
  nb::class_<KeyframeAdded> keyframe(m, "KeyframeAdded", doc("KeyframeAdded"));
  keyframe.def_ro("keyframe", &KeyframeAdded::keyframe, doc("KeyframeAdded::keyframe"))
      .def_ro("frame", &KeyframeAdded::frame, doc("KeyframeAdded::frame"))
      .def_ro("place", &KeyframeAdded::place, doc("KeyframeAdded::place"))
      .def_ro("T_map_cam", &KeyframeAdded::T_map_cam, doc("KeyframeAdded::T_map_cam"));
  describe(keyframe, {"keyframe", "frame", "place"});
  nb::class_<PlaceAdded> place(m, "PlaceAdded", doc("PlaceAdded"));
  place.def_ro("place", &PlaceAdded::place, doc("PlaceAdded::place"))
      .def_ro("anchor", &PlaceAdded::anchor, doc("PlaceAdded::anchor"))
      .def_ro("T_map_place", &PlaceAdded::T_map_place, doc("PlaceAdded::T_map_place"))
      .def_ro("component", &PlaceAdded::component, doc("PlaceAdded::component"));
  describe(place, {"place", "anchor", "component"});
  nb::class_<PlacesMerged> merged(m, "PlacesMerged", doc("PlacesMerged"));
  merged.def_ro("kept", &PlacesMerged::kept, doc("PlacesMerged::kept"))
      .def_ro("gone", &PlacesMerged::gone, doc("PlacesMerged::gone"));
  describe(merged, {"kept", "gone"});
}

void bind_map_changes(nb::module_& m) {
  nb::class_<ComponentJoined> joined(m, "ComponentJoined", doc("ComponentJoined"));
  joined.def_ro("component", &ComponentJoined::component, doc("ComponentJoined::component"))
      .def_ro("into", &ComponentJoined::into, doc("ComponentJoined::into"));
  describe(joined, {"component", "into"});
  nb::class_<MapMoved> moved(m, "MapMoved", doc("MapMoved"));
  moved.def_ro("scale", &MapMoved::scale, doc("MapMoved::scale"))
      .def_ro("places", &MapMoved::places, doc("MapMoved::places"))
      .def_ro("translation", &MapMoved::translation, doc("MapMoved::translation"))
      .def_ro("rotation_rad", &MapMoved::rotation_rad, doc("MapMoved::rotation_rad"))
      .def_prop_ro(
          "poses",
          [](const MapMoved& move) {
            nb::dict poses;
            for (const PlacePose& each : move.poses) {
              const Sim3& S = each.S_map_place;
              SE3 rigid(S.rotation(), S.translation());
              Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = rigid.matrix();
              matrix.topLeftCorner<3, 3>() *= S.scale();
              poses[nb::int_(each.place.value())] = nb::cast(matrix);
            }
            return poses;
          },
          nb::sig("def poses(self) -> dict[int, numpy.typing.NDArray[numpy.float64]]"),
          "New poses S_map_place of the places that have moved, by id: 4x4 matrices of "
          "similarities, "
          "whose scale is lengths in the map over lengths at the place.");
  describe(moved, {"places", "translation", "rotation_rad", "scale"});
}

}  // namespace

LogSink log_sink(const nb::object& function) {
  if (function.is_none()) return {};
  return [&function](LogLevel level, const std::string& text) {
    const nb::gil_scoped_acquire gil;
    function(level == LogLevel::kDebug  ? "debug"
             : level == LogLevel::kInfo ? "info"
                                        : "warning",
             text);
  };
}

void require_callable(const nb::object& function, const char* argument) {
  if (!function.is_none() && PyCallable_Check(function.ptr()) == 0)
    throw ArgumentError(fmt::format("{}: a function is needed, not {}", argument,
                                    nb::cast<std::string>(nb::repr(function))));
}

void bind_events(nb::module_& m) {
  bind_frame_result(m);
  bind_loop(m);
  bind_place_events(m);
  bind_map_changes(m);
  nb::class_<RunBegan> began(m, "RunBegan",
                             "A run begins; earlier events refer to another map. `run` reports it "
                             "again when it begins again with corrected images.");
  describe(began, {});
  nb::class_<LensFound> lens(m, "LensFound", doc("LensFound"));
  lens.def_ro("frame", &LensFound::frame, doc("LensFound::frame"))
      .def_ro("k1", &LensFound::k1, doc("LensFound::k1"))
      .def_ro("sigma_k1", &LensFound::sigma_k1, doc("LensFound::sigma_k1"))
      .def_ro("pass_", &LensFound::pass, doc("LensFound::pass"));
  describe(lens, {"frame", "k1", "sigma_k1"});
}

}  // namespace placegraph::python
