#include <fmt/format.h>
#include <nanobind/stl/array.h>
#include <placegraph/eval/plots/evaluation_plot.h>
#include <placegraph/eval/trajectory/common_frames.h>
#include <placegraph/eval/trajectory/report.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/evaluated_files.h>

#include "python/src/arrays.h"
#include "python/src/eval/evaluation_tables.h"
#include "python/src/frontend/functions.h"
#include "python/src/values/value_class.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// The figure of a metric, whose value is None if the data allow none.
Table row_of(const Metric& metric) {
  Table row;
  row["key"] = metric.key;
  row["name"] = metric.name;
  row["unit"] = metric.unit;
  row["value"] = metric.value ? nb::object(nb::float_(*metric.value)) : nb::none();
  row["protocol"] = metric.protocol;
  return row;
}

TableList rows_of(const std::vector<Metric>& metrics) {
  TableList rows;
  for (const Metric& metric : metrics) rows.append(row_of(metric));
  return rows;
}

Table protocol_of(const EvaluationResult& result) {
  const Protocol& protocol = result.protocol;
  Table row;
  row["align"] = to_string(protocol.alignment);
  row["align_over"] = to_string(protocol.align_over);
  row["vertical"] = protocol.vertical;
  row["part"] = protocol.part;
  row["association"] = to_string(protocol.association);
  row["max_difference_s"] = protocol.max_difference_s;
  row["offset_s"] = protocol.offset_s;
  row["lengths_m"] = protocol.lengths_m;
  row["step"] = protocol.step;
  return row;
}

std::optional<Statistics> if_known(const Outcome& outcome, const Statistics& statistics) {
  return outcome ? std::optional(statistics) : std::nullopt;
}

EvaluationResult evaluated(const Trajectory& truth, const Trajectory& estimate,
                           const OptionSet& options, const std::string& name) {
  const EvaluationOptions& typed = options_in<EvaluationOptions>(options, "options");
  const WithoutGil released;
  return evaluate(truth, estimate, typed, name);
}

Figure figure_of_results(const std::vector<EvaluationResult>& results, const std::string& kind,
                         bool own_truths) {
  require(!results.empty(), "results: there is none");
  const auto chosen = choice_of<EvaluationPlot>(kind, evaluation_plot_names(), "kind");
  const WithoutGil released;
  return figure_of(results, own_truths ? EvaluatedTruth::kOwn : EvaluatedTruth::kShared, chosen);
}

/// The estimates on the frames that all have; empty if they have the same ones.
/// `truths`: that of each estimate, of one sequence, with times for those that have times.
std::vector<EvaluationResult> common_results(const std::vector<Trajectory>& truths,
                                             const std::vector<Trajectory>& estimates,
                                             const std::vector<std::string>& names,
                                             const OptionSet& options) {
  const EvaluationOptions& typed = options_in<EvaluationOptions>(options, "options");
  const WithoutGil released;
  require(truths.size() == estimates.size(), "truths: one is needed for each estimate");
  std::vector<PairingResult> paired;
  for (std::size_t i = 0; i < truths.size(); ++i)
    paired.push_back(pair_trajectories(truths[i], estimates[i], typed.association, typed.time));
  return on_common_frames(paired, names, typed).results;
}

Table average_of(const std::vector<EvaluationResult>& results) {
  const AverageResult mean = average(results);
  Table row;
  row["sequences"] = mean.sequences;
  row["failed"] = mean.failed;
  row["means_of_rest"] = rows_of(mean.means_of_rest);
  row["segments"] = mean.segments;
  row["means"] = rows_of(mean.means);
  row["pooled_t_rel"] = row_of(mean.pooled_t_rel);
  row["pooled_r_rel"] = row_of(mean.pooled_r_rel);
  return row;
}

void bind_statistics(nb::module_& m) {
  nb::class_<Statistics> statistics(m, "Statistics", doc("Statistics"));
  bind_value(statistics, Hash::kByValue);
  statistics.def_ro("rmse", &Statistics::rmse, doc("Statistics::rmse"))
      .def_ro("mean", &Statistics::mean, doc("Statistics::mean"))
      .def_ro("median", &Statistics::median, doc("Statistics::median"))
      .def_ro("std", &Statistics::std_dev, doc("Statistics::std_dev"))
      .def_ro("min", &Statistics::min, doc("Statistics::min"))
      .def_ro("max", &Statistics::max, doc("Statistics::max"))
      .def_ro("sse", &Statistics::sse, doc("Statistics::sse"))
      .def_ro("p75", &Statistics::p75, doc("Statistics::p75"))
      .def_ro("p90", &Statistics::p90, doc("Statistics::p90"))
      .def_ro("p95", &Statistics::p95, doc("Statistics::p95"))
      .def_ro("p99", &Statistics::p99, doc("Statistics::p99"))
      .def_ro("count", &Statistics::count, doc("Statistics::count"))
      .def("__repr__", [](const Statistics& s) {
        return fmt::format(
            "<placegraph.Statistics: rmse {:.6g}, mean {:.6g}, median {:.6g}, max "
            "{:.6g} of {}>",
            s.rmse, s.mean, s.median, s.max, s.count);
      });
}

void bind_result(nb::module_& m) {
  nb::class_<EvaluationResult> result(m, "EvaluationResult", doc("EvaluationResult"));
  bind_outcome(result);
  bind_value(result, Hash::kByValue);
  result.def_ro("name", &EvaluationResult::name, doc("EvaluationResult::name"))
      .def_prop_ro("warnings", as_tuple(&EvaluationResult::warnings),
                   doc("EvaluationResult::warnings"))
      .def_ro("frames", &EvaluationResult::frames, doc("EvaluationResult::frames"))
      .def_ro("posed", &EvaluationResult::posed, doc("EvaluationResult::posed"))
      .def_ro("coverage", &EvaluationResult::coverage, doc("EvaluationResult::coverage"))
      .def_prop_ro("lost_frames", as_tuple(&EvaluationResult::lost_frames),
                   doc("EvaluationResult::lost_frames"))
      .def_ro("path_m", &EvaluationResult::path_m, doc("EvaluationResult::path_m"))
      .def_ro("alignment", &EvaluationResult::alignment, doc("EvaluationResult::alignment"))
      .def_prop_ro("protocol", &protocol_of, doc("Protocol"))
      .def_prop_ro(
          "ape_m", [](const EvaluationResult& r) { return if_known(r.ape.outcome, r.ape.error_m); },
          doc("ApeResult"))
      .def_prop_ro(
          "rpe_m",
          [](const EvaluationResult& r) { return if_known(r.rpe.outcome, r.rpe.translation_m); },
          doc("RelativeErrors::translation_m"))
      .def_prop_ro(
          "rpe_deg",
          [](const EvaluationResult& r) { return if_known(r.rpe.outcome, r.rpe.rotation_deg); },
          doc("RelativeErrors::rotation_deg"))
      .def_prop_ro(
          "rpe_heading_deg",
          [](const EvaluationResult& r) {
            return r.rpe.has_vertical ? if_known(r.rpe.outcome, r.rpe.heading_deg) : std::nullopt;
          },
          "Statistics of the heading's part of the errors between consecutive frames [deg].")
      .def_prop_ro(
          "rpe_inclination_deg",
          [](const EvaluationResult& r) {
            return r.rpe.has_vertical ? if_known(r.rpe.outcome, r.rpe.inclination_deg)
                                      : std::nullopt;
          },
          "Statistics of the inclination's part of the errors between consecutive frames [deg].")
      .def(
          "metric_rows", [](const EvaluationResult& r) { return rows_of(metrics(r)); },
          "All figures, a dictionary each.")
      .def_prop_ro(
          "are_deg",
          [](const EvaluationResult& r) {
            return if_known(r.ape.rotation_outcome, r.ape.rotation_deg);
          },
          doc("ApeResult::rotation_deg"))
      .def("frame_table", &frame_table, "Columns of the evaluated frames.")
      .def("error_table", &error_table, "Columns of the statistics of every kind of error.")
      .def("step_table", &steps_over, "delta"_a = "1f", "Columns of the steps over a delta.")
      .def("profile_table", &profile_table, "by"_a,
           "Columns of the errors by 'speed' [m/s], 'turning_rate' [deg/s] or 'distance' [m].")
      .def(
          "worst_table",
          [](const EvaluationResult& r) { return worst_table(r.profile.worst); },
          "Columns of the stretches with the largest position errors, the largest first.")
      .def("segment_table", &segment_table, "Columns of the KITTI segments.")
      .def(
          "length_table",
          [](const EvaluationResult& r) { return group_table(r.segments.by_length); },
          "Columns of the means over the segments of each length [m].")
      .def(
          "speed_table", [](const EvaluationResult& r) { return group_table(r.segments.by_speed); },
          "Columns of the means over the segments of each interval of speed [m/s].")
      .def(
          "to_json", [](const EvaluationResult& r) { return to_json(r); },
          "The result as JSON, as `placegraph eval --json` prints it.")
      .def("__str__", [](const EvaluationResult& r) { return to_text(r); });
}

void bind_files(nb::module_& m) {
  const auto released = nb::call_guard<WithoutGil>();
  m.def("is_run_folder", &is_run_folder, "folder"_a, doc("is_run_folder"));
  m.def("distinct_names", &distinct_names, "paths"_a, doc("distinct_names"));
  m.def("trajectory_of_run", &trajectory_of_run, "folder"_a, "timed"_a, doc("trajectory_of_run"));
  m.def("truth_has_times", &truth_has_times, "truth"_a, doc("truth_has_times"));
  m.def("times_beside", &times_beside, "truth"_a, doc("times_beside"));
  m.def("read_evaluated", &read_evaluated, "path"_a, "times"_a = "", released,
        doc("read_evaluated"));
  m.def("read_truth", &read_truth, "path"_a, "times"_a = "", released, doc("read_truth"));
  m.def(
      "pair_files",
      [](const std::string& truths, const std::string& estimates) {
        std::vector<std::array<std::string, 3>> pairs;
        for (const EvaluatedFiles& files : pair_files(truths, estimates).pairs)
          pairs.push_back({files.name, files.truth, files.estimate});
        return pairs;
      },
      "truths"_a, "estimates"_a,
      "Pairs the files of two folders by their names: name, truth and estimate of each.");
}

}  // namespace

void bind_evaluation(nb::module_& m) {
  using Results = std::vector<EvaluationResult>;
  bind_statistics(m);
  bind_result(m);
  m.def("evaluate_trajectory", &evaluated, "truth"_a, "estimate"_a, "options"_a,
        "name"_a = "estimate", doc("evaluate"));
  m.def("evaluation_plots", &evaluation_plot_names, "Names of the pictures of an evaluation.");
  m.def("evaluation_figure", &figure_of_results, "results"_a, "kind"_a = "overview",
        "own_truths"_a = false,
        "A figure of the results that did not fail.\n\n`kind`: one of `evaluation_plots()`. "
        "`own_truths`: each result is of a sequence of its own.");
  m.def("evaluate_common_frames", &common_results, "truths"_a, "estimates"_a, "names"_a,
        "options"_a, "Estimates judged again on the frames that all of them have; none if they are the same.");
  m.def("average_results", &average_of, "results"_a,
        "Averages of several results; none over all if one has no figures.");
  m.def(
      "results_to_json",
      [](const Results& results, bool average, const Results& common) {
        return to_json(results, average, common);
      },
      "results"_a, "average"_a = false, "common"_a = Results(),
      "Several results as JSON, with their averages if `average`, and those of common frames.");
  m.def(
      "results_to_csv", [](const Results& results) { return to_csv(results); }, "results"_a,
      "Results as CSV, one number per line, with a header.");
  m.def(
      "results_to_latex", [](const Results& results) { return to_latex(results); }, "results"_a,
      "A LaTeX table (booktabs), one row per result.");
  m.def(
      "results_to_table",
      [](const Results& results, bool average) { return to_table(results, average); }, "results"_a,
      "average"_a = false, "The results as a table of text; `average` adds a row of averages.");
  bind_files(m);
}

}  // namespace placegraph::python
