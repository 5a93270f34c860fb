#include <placegraph/eval/kitti/kitti_plots.h>
#include <placegraph/eval/kitti/kitti_report.h>
#include <placegraph/pipeline/kitti/kitti_benchmark.h>
#include <placegraph/pipeline/kitti/kitti_files.h>

#include <limits>

#include "python/src/arrays.h"
#include "python/src/frontend/functions.h"
#include "python/src/values/value_class.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

/// Calls `add(system, name of the sequence, sequence)` for every sequence with a truth, and for the
/// mean, which has no sequence.
template <class Add>
void for_each_figures(const KittiBenchmark& benchmark, const Add& add) {
  for (const KittiSystem& system : benchmark.systems) {
    for (const KittiSequence& sequence : system.sequences)
      if (sequence.has_truth) add(system.name, sequence.name, sequence.figures, &sequence);
    add(system.name, std::string("mean"), system.mean, nullptr);
  }
}

/// Columns of the figures of every sequence and of the means.
Table kitti_figure_table(const KittiBenchmark& benchmark) {
  std::vector<std::string> systems, sequences;
  std::vector<double> frames, path, t, r;
  std::vector<std::int64_t> segments;
  for_each_figures(benchmark, [&](const std::string& system, const std::string& name,
                                  const KittiFigures& figures, const KittiSequence* sequence) {
    const bool judged{figures.outcome};
    systems.push_back(system);
    sequences.push_back(name);
    frames.push_back(sequence ? sequence->frames : kNoFigure);
    path.push_back(sequence && !sequence->pairs.empty() ? sequence->path_m : kNoFigure);
    segments.push_back(figures.segments);
    t.push_back(judged ? figures.t_rel_percent : kNoFigure);
    r.push_back(judged ? figures.r_rel_deg_per_100m : kNoFigure);
  });
  const std::size_t n = t.size();
  Table table;
  table["system"] = systems;
  table["sequence"] = sequences;
  table["frames"] = owned_array(std::move(frames), {n});
  table["path_m"] = owned_array(std::move(path), {n});
  table["segments"] = owned_array(std::move(segments), {n});
  table["t_rel_percent"] = owned_array(std::move(t), {n});
  table["r_rel_deg_per_100m"] = owned_array(std::move(r), {n});
  return table;
}

/// Columns of the means over lengths or about speeds.
Table kitti_row_table(const KittiBenchmark& benchmark, bool over_speed) {
  std::vector<std::string> systems, sequences;
  std::vector<double> at, t, r;
  std::vector<std::int64_t> segments;
  for_each_figures(benchmark, [&](const std::string& system, const std::string& name,
                                  const KittiFigures& figures, const KittiSequence*) {
    for (const KittiRow& row : over_speed ? figures.by_speed : figures.by_length) {
      systems.push_back(system);
      sequences.push_back(name);
      at.push_back(row.at);
      segments.push_back(row.segments);
      t.push_back(row.t_percent);
      r.push_back(row.r_deg_per_100m);
    }
  });
  const std::size_t n = at.size();
  Table table;
  table["system"] = systems;
  table["sequence"] = sequences;
  table[over_speed ? "speed_m_per_s" : "length_m"] = owned_array(std::move(at), {n});
  table["segments"] = owned_array(std::move(segments), {n});
  table["t_percent"] = owned_array(std::move(t), {n});
  table["r_deg_per_100m"] = owned_array(std::move(r), {n});
  return table;
}

/// Columns of the faults, or of the warnings.
Table kitti_fault_table(const KittiBenchmark& benchmark, bool warnings) {
  std::vector<std::string> systems, files, texts;
  std::vector<std::int64_t> lines;
  for (const KittiSystem& system : benchmark.systems)
    for (const KittiFault& fault : warnings ? system.warnings : system.faults) {
      systems.push_back(system.name);
      files.push_back(fault.file);
      lines.push_back(fault.line);
      texts.push_back(fault.text);
    }
  const std::size_t n = lines.size();
  Table table;
  table["system"] = systems;
  table["file"] = files;
  table["line"] = owned_array(std::move(lines), {n});
  table["text"] = texts;
  return table;
}

std::optional<Figure> kitti_figure(const KittiBenchmark& benchmark, const std::string& sequence,
                                   const std::string& kind) {
  const auto chosen = choice_of<KittiPlot>(kind, kitti_plot_names(), "kind");
  const WithoutGil released;
  return figure_of(benchmark, sequence, chosen);
}

}  // namespace

void bind_kitti(nb::module_& m) {
  nb::class_<KittiBenchmark> benchmark(m, "KittiBenchmark", doc("KittiBenchmark"));
  bind_value(benchmark, Hash::kByValue);
  benchmark.def_prop_ro("fault_count", &KittiBenchmark::faults, doc("KittiBenchmark::faults"))
      .def("figure_table", &kitti_figure_table, "Columns of the figures of every sequence.")
      .def(
          "length_table", [](const KittiBenchmark& b) { return kitti_row_table(b, false); },
          "Columns of the means over the segments of each length [m].")
      .def(
          "speed_table", [](const KittiBenchmark& b) { return kitti_row_table(b, true); },
          "Columns of the means over the segments about each speed [m/s].")
      .def(
          "fault_table", [](const KittiBenchmark& b) { return kitti_fault_table(b, false); },
          "Columns of the faults.")
      .def(
          "warning_table", [](const KittiBenchmark& b) { return kitti_fault_table(b, true); },
          "Columns of the warnings.")
      .def("figure", &kitti_figure, "sequence"_a, "kind"_a,
           "A figure of a sequence, or of 'avg', all of them; None if there is nothing to draw.")
      .def("write", &write_kitti_files, "folder"_a, "format"_a = "png", "force"_a = false,
           nb::call_guard<WithoutGil>(), doc("write_kitti_files"))
      .def(
          "to_json", [](const KittiBenchmark& b) { return to_json(b); },
          "The figures and faults as JSON, as `placegraph eval kitti --json` prints them.")
      .def(
          "to_csv", [](const KittiBenchmark& b) { return to_csv(b); }, "The figures as CSV.")
      .def("__str__", [](const KittiBenchmark& b) { return to_text(b); });
  m.def("kitti_plots", &kitti_plot_names, "Names of the pictures of KITTI's benchmark.");
  m.def("evaluate_kitti", &evaluate_kitti, "truths"_a, "estimates"_a,
        "sequences"_a = std::vector<std::string>{}, nb::call_guard<WithoutGil>(),
        doc("evaluate_kitti"));
}

}  // namespace placegraph::python
