#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/pipeline/cues/frame_view.h>

#include <limits>

#include "python/src/arrays.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

template <class Number>
using Array = ReadOnlyArray<Number>;

/// A member of every element of a list as an array that shares the values and keeps their owner.
template <class Number, class Element>
nb::object shared_rows(const std::vector<Element>& list, const void* first, std::size_t columns,
                       nb::handle owner) {
  static_assert(sizeof(Element) % sizeof(Number) == 0);
  constexpr std::int64_t kStride = sizeof(Element) / sizeof(Number);
  const std::size_t shape[2] = {list.size(), columns};
  const std::int64_t strides[2] = {kStride, 1};
  const void* data = list.empty() ? nullptr : first;
  return nb::cast(ReadOnlyArray<Number>(static_cast<const Number*>(data), columns > 1 ? 2 : 1,
                                        shape, owner, strides),
                  nb::rv_policy::reference);
}

/// Vectors that may be missing, as rows; NaN where they are.
template <class Vector, class Element>
Array<double> optional_rows(const std::vector<Element>& list,
                            std::optional<Vector> Element::*member) {
  constexpr std::size_t kColumns = Vector::RowsAtCompileTime;
  std::vector<double> values;
  for (const Element& each : list) {
    const Vector row = (each.*member).value_or(Vector::Constant(kNone));
    values.insert(values.end(), row.data(), row.data() + kColumns);
  }
  return owned_array(std::move(values), {list.size(), kColumns});
}

template <class Element>
Array<double> segment_rows(const std::vector<Element>& list) {
  std::vector<double> values;
  for (const Element& each : list)
    for (const Eigen::Vector2d& end : {each.segment.start, each.segment.end})
      values.insert(values.end(), {end.x(), end.y()});
  return owned_array(std::move(values), {list.size(), 4});
}

Array<std::int64_t> line_ids(const FrameView& view) {
  std::vector<std::int64_t> ids;
  for (const FrameView::Line& line : view.lines) ids.push_back(line.id.value());
  const std::size_t count = ids.size();
  return owned_array(std::move(ids), {count});
}

/// Manhattan frame and axis of every edge; -1 where there is none.
Array<std::int64_t> directions(const FrameView& view) {
  std::vector<std::int64_t> values;
  for (const FrameView::DirectedLine& line : view.directed) {
    values.push_back(line.manhattan_frame ? line.manhattan_frame->value() : -1);
    values.push_back(line.axis.value_or(-1));
  }
  return owned_array(std::move(values), {view.directed.size(), 2});
}

/// Pixels and residuals of aligned planes.
Array<double> surface_rows(const FrameView& view) {
  std::vector<double> values;
  for (const FrameView::SurfacePixel& each : view.surfaces)
    values.insert(values.end(), {each.px.x(), each.px.y(), each.residual_sigmas});
  return owned_array(std::move(values), {view.surfaces.size(), 3});
}

using Track = FrameView::Track;

/// The tracked points: an array for each member of FrameView::Track.
template <class Class>
void bind_tracks(Class& view) {
  view.def("__len__", [](const FrameView& v) { return v.tracks.size(); })
      .def_prop_ro(
          "track_ids",
          [](nb::pointer_and_handle<FrameView> v) {
            const auto& tracks = v.p->tracks;
            return shared_rows<std::int64_t>(tracks, tracks.empty() ? nullptr : &tracks[0].id, 1,
                                             v.h);
          },
          nb::sig("def track_ids(self) -> numpy.typing.NDArray[numpy.int64]"),
          doc("FrameView::Track::id"))
      .def_prop_ro(
          "px",
          [](nb::pointer_and_handle<FrameView> v) {
            const auto& tracks = v.p->tracks;
            return shared_rows<double>(tracks, tracks.empty() ? nullptr : &tracks[0].px, 2, v.h);
          },
          nb::sig("def px(self) -> numpy.typing.NDArray[numpy.float64]"),
          "Pixel of each tracked point in this frame, N x 2.")
      .def_prop_ro(
          "px_previous",
          [](nb::pointer_and_handle<FrameView> v) {
            const auto& tracks = v.p->tracks;
            return shared_rows<double>(tracks, tracks.empty() ? nullptr : &tracks[0].px_previous, 2,
                                       v.h);
          },
          nb::sig("def px_previous(self) -> numpy.typing.NDArray[numpy.float64]"),
          "Pixel of each tracked point in the previous frame, N x 2.")
      .def_prop_ro(
          "px_projected",
          [](const FrameView& v) { return optional_rows(v.tracks, &Track::px_projected); }, kNew,
          "Projection of each track's landmark [px], N x 2; NaN without one.")
      .def_prop_ro(
          "points_cam",
          [](const FrameView& v) { return optional_rows(v.tracks, &Track::point_cam); }, kNew,
          "Each track's landmark in the frame of the camera, in the scale of the track segment, "
          "N x 3; NaN without one.");
}

void bind_data_note(nb::module_& m) {
  if (nb::type<DataNote>().is_valid()) return;
  nb::class_<DataNote>(m, "DataNote", doc("DataNote"))
      .def_prop_ro(
          "cause", [](const DataNote& n) { return to_string(n.cause); }, doc("DataNote::cause"))
      .def_ro("text", &DataNote::text, doc("DataNote::text"))
      .def_ro("advice", &DataNote::advice, doc("DataNote::advice"))
      .def_ro("doubts_scale", &DataNote::doubts_scale, doc("DataNote::doubts_scale"))
      .def("__str__", [](const DataNote& n) { return n.text; });
}

}  // namespace

void bind_frame_views(nb::module_& m) {
  bind_data_note(m);
  nb::class_<FrameView> view(m, "FrameView", doc("FrameView"));
  bind_tracks(view);
  view.def_prop_ro("line_ids", &line_ids, kNew, "Ids of the tracked lines, N.")
      .def_prop_ro(
          "lines", [](const FrameView& v) { return segment_rows(v.lines); }, kNew,
          "Visible parts of the tracked lines [px], N x 4: start and end.")
      .def_prop_ro(
          "edges", [](const FrameView& v) { return segment_rows(v.directed); }, kNew,
          "Edges that were examined for Manhattan frames [px], N x 4: start and end.")
      .def_prop_ro("edge_directions", &directions, kNew,
                   "Manhattan frame and axis (0, 1, 2) of each edge, N x 2; -1: none.")
      .def_prop_ro("surfaces", &surface_rows, kNew,
                   "Pixels of planes that were aligned, N x 3: pixel and residual of the intensity "
                   "in standard deviations.")
      .def_prop_ro(
          "ground_px",
          [](nb::pointer_and_handle<FrameView> v) {
            const auto& outline = v.p->ground_px;
            return shared_rows<double>(outline, outline.data(), 2, v.h);
          },
          nb::sig("def ground_px(self) -> numpy.typing.NDArray[numpy.float64]"),
          doc("FrameView::ground_px"));
}

}  // namespace placegraph::python
