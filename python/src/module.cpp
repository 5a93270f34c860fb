#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/outcome.h>

#include "python/src/bindings.h"
#include "python/src/warnings.h"

namespace placegraph::python {

PyObject* doubt_class() {
  static PyObject* const kClass = PyErr_NewExceptionWithDoc(
      "placegraph.Doubt", "What speaks against a result, or against the input that it is of.",
      PyExc_RuntimeWarning, nullptr);
  return kClass;
}

void bind_errors(nb::module_& m) {
  // The first type that fits is taken: the derived ones come last. Each is also what Python's own
  // functions raise in such a case.
  const nb::object error = nb::exception<Error>(m, "Error", PyExc_Exception);
  const auto both = [&](PyObject* python) { return nb::make_tuple(error, nb::borrow(python)); };
  nb::exception<ArgumentError>(m, "ArgumentError", both(PyExc_ValueError));
  nb::exception<FileError>(m, "FileError", both(PyExc_OSError));
  nb::exception<NoResult>(m, "NoResult", m.attr("Error"));
  m.attr("Doubt") = nb::borrow(doubt_class());
  std::vector<std::string> kinds;
  for (const DoubtKind kind : kDoubtKinds) kinds.emplace_back(to_string(kind));
  m.attr("doubt_kinds") = nb::tuple(nb::cast(kinds));
}

}  // namespace placegraph::python

NB_MODULE(_core, m) {
  using namespace placegraph::python;
  m.attr("version") = PLACEGRAPH_VERSION;
  m.doc() = "The library placegraph; the package `placegraph` is what to import.";
  // Factors and callbacks that a script holds at its end are no leak of the library.
  nb::set_leak_warnings(false);
  bind_errors(m);
  bind_geometry(m);
  bind_options(m);
  bind_images(m);
  bind_image_files(m);
  bind_trajectories(m);
  bind_measured_motion(m);
  bind_frame_views(m);
  bind_datasets(m);
  bind_variables(m);
  bind_pose_graphs(m);
  bind_landmark_graphs(m);
  bind_pose_graph_optimization(m);
  bind_incremental(m);
  bind_factors(m);
  bind_factor_graph(m);
  bind_events(m);
  bind_maps(m);
  bind_localize(m);
  bind_runs(m);
  bind_slam(m);
  bind_recognizers(m);
  bind_figures(m);
  bind_synthetic(m);
  bind_evaluation(m);
  bind_trajectory_info(m);
  bind_intervals(m);
  bind_offsets(m);
  bind_tables(m);
  bind_gate(m);
  bind_edges(m);
  bind_kitti(m);
  bind_flow(m);
  bind_flow_cues(m);
  bind_motion(m);
  bind_homographies(m);
  bind_clouds(m);
  bind_tracking(m);
  bind_scene(m);
  bind_markers(m);
  bind_places(m);
  bind_loops(m);
  bind_reports(m);
}
