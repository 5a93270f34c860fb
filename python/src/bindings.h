#pragma once
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include "docstrings.h"
#include "python/src/eigen_arrays.h"
#include "python/src/without_gil.h"

namespace nb = nanobind;

namespace placegraph::python {

// Each adds the classes and functions of one subject.
void bind_errors(nb::module_& m);
void bind_geometry(nb::module_& m);
void bind_options(nb::module_& m);
void bind_images(nb::module_& m);
void bind_image_files(nb::module_& m);
void bind_datasets(nb::module_& m);
void bind_measured_motion(nb::module_& m);
void bind_trajectories(nb::module_& m);
void bind_pose_graphs(nb::module_& m);
void bind_landmark_graphs(nb::module_& m);
void bind_pose_graph_optimization(nb::module_& m);
void bind_incremental(nb::module_& m);
void bind_variables(nb::module_& m);
void bind_factors(nb::module_& m);
void bind_factor_graph(nb::module_& m);
void bind_maps(nb::module_& m);
void bind_events(nb::module_& m);
void bind_frame_views(nb::module_& m);
void bind_runs(nb::module_& m);
void bind_localize(nb::module_& m);
void bind_slam(nb::module_& m);
void bind_recognizers(nb::module_& m);
void bind_synthetic(nb::module_& m);
void bind_evaluation(nb::module_& m);
void bind_trajectory_info(nb::module_& m);
void bind_flow(nb::module_& m);
void bind_edges(nb::module_& m);
void bind_flow_cues(nb::module_& m);
void bind_motion(nb::module_& m);
void bind_homographies(nb::module_& m);
void bind_clouds(nb::module_& m);
void bind_tracking(nb::module_& m);
void bind_scene(nb::module_& m);
void bind_markers(nb::module_& m);
void bind_places(nb::module_& m);
void bind_kitti(nb::module_& m);
void bind_loops(nb::module_& m);
void bind_figures(nb::module_& m);
void bind_gate(nb::module_& m);
void bind_intervals(nb::module_& m);
void bind_offsets(nb::module_& m);
void bind_tables(nb::module_& m);
void bind_reports(nb::module_& m);

}  // namespace placegraph::python
