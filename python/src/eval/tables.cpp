#include <fmt/format.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/pair.h>
#include <placegraph/eval/tables/table_writers.h>
#include <placegraph/pipeline/results/evo_archives.h>

#include "python/src/arrays.h"
#include "python/src/frontend/functions.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

nb::dict arrays_of(const EvoResult& result) {
  nb::dict arrays;
  for (const auto& [name, array] : result.arrays) {
    std::vector<double> values = array.values;
    arrays[name.c_str()] =
        array.columns == 1 ? nb::cast(owned_array(std::move(values), {array.rows}))
                           : nb::cast(owned_array(std::move(values), {array.rows, array.columns}));
  }
  return arrays;
}

nb::dict statistics_of_evo(const EvoResult& result) {
  nb::dict statistics;
  for (const auto& [name, value] : result.statistics) statistics[name.c_str()] = value;
  return statistics;
}

void bind_evo(nb::module_& m) {
  nb::class_<EvoResult>(m, "EvoResult", doc("EvoResult"))
      .def_ro("title", &EvoResult::title, doc("EvoResult::title"))
      .def_ro("label", &EvoResult::label, doc("EvoResult::label"))
      .def_ro("reference", &EvoResult::reference, doc("EvoResult::reference"))
      .def_ro("estimate", &EvoResult::estimate, doc("EvoResult::estimate"))
      .def_prop_ro("statistics", &statistics_of_evo, doc("EvoResult::statistics"))
      .def_prop_ro("arrays", &arrays_of, doc("EvoResult::arrays"))
      .def_ro("trajectories", &EvoResult::trajectories, doc("EvoResult::trajectories"))
      .def("__repr__", [](const EvoResult& r) {
        return fmt::format("<placegraph.EvoResult: {} of {} against {}>", r.label, r.estimate,
                           r.reference);
      });
  m.def("read_evo_result", &read_evo_result, "path"_a, nb::call_guard<WithoutGil>(),
        doc("read_evo_result"));
  m.def(
      "write_evaluation_for_evo",
      [](const std::string& path, const EvaluationResult& result, const std::string& reference) {
        write_evo_result(path, evo_result_of(result, reference));
      },
      "path"_a, "result"_a, "reference"_a, nb::call_guard<WithoutGil>(), doc("evo_result_of"));
}

using Evaluated = std::vector<std::pair<std::string, const EvaluationResult*>>;

FigureTable table_of_systems(const std::vector<std::pair<std::string, Evaluated>>& systems,
                             const std::vector<std::string>& figures, const std::string& rows) {
  std::vector<NamedResults> named;
  for (const auto& [name, sequences] : systems) {
    NamedResults& system = named.emplace_back();
    system.name = name;
    for (const auto& [sequence, result] : sequences)
      system.sequences.push_back(sequence_figures(*result, sequence));
  }
  return table_of(named, figures, choice_of<TableRows>(rows, {"sequences", "systems"}, "rows"));
}

}  // namespace

void bind_tables(nb::module_& m) {
  bind_evo(m);
  nb::class_<FigureTable>(m, "FigureTable", doc("FigureTable"))
      .def(
          "to_text", [](const FigureTable& t) { return to_text(t); }, "The table for people: aligned columns, notes below.")
      .def(
          "to_csv", [](const FigureTable& t) { return to_csv(t); },
          "The table as CSV: a line for each row, the notes in the last column.")
      .def(
          "to_latex", [](const FigureTable& t) { return to_latex(t); },
          "The table for LaTeX (booktabs), best figures bold, notes below.")
      .def(
          "to_markdown", [](const FigureTable& t) { return to_markdown(t); }, "The table in the Markdown of GitHub, best figures bold, notes below.")
      .def(
          "to_json", [](const FigureTable& t) { return to_json(t); },
          "The table as JSON, as `placegraph eval table --json` prints it.")
      .def(
          "to_html", [](const FigureTable& t) { return to_html(t); }, doc("to_html"))
      .def(
          "_repr_html_", [](const FigureTable& t) { return to_html_fragment(t); },
          doc("to_html_fragment"))
      .def("__repr__", [](const FigureTable& t) { return to_text(t); });
  m.def("table_of_systems", &table_of_systems, "systems"_a, "figures"_a, "rows"_a = "sequences",
        doc("table_of"));
}

}  // namespace placegraph::python
