#include <fmt/format.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <placegraph/eval/gate/gate.h>
#include <placegraph/eval/gate/trajectory_record.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/results/gate_files.h>

#include <limits>

#include "python/src/arrays.h"
#include "python/src/frontend/functions.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Columns of the figures of a record.
Table figure_table(const Record& record) {
  std::vector<std::string> sequence, key, unit, better;
  std::vector<std::int64_t> runs, failed;
  std::vector<double> mean, low, high, floor;
  for (const SequenceRecord& each : record.sequences)
    for (const FigureRecord& figure : each.figures) {
      const auto there = static_cast<std::int64_t>(figure.present().size());
      const ConfidenceInterval& interval = figure.interval;
      const bool known = interval.outcome && !interval.of.empty();
      sequence.push_back(each.name);
      key.push_back(figure.key);
      unit.push_back(figure.unit);
      better.emplace_back(to_string(figure.better));
      runs.push_back(static_cast<std::int64_t>(figure.values.size()));
      failed.push_back(runs.back() - there);
      mean.push_back(figure.mean().value_or(kUnknown));
      low.push_back(known ? interval.low : kUnknown);
      high.push_back(known ? interval.high : kUnknown);
      floor.push_back(figure.noise_floor);
    }
  const std::size_t n = key.size();
  Table table;
  table["sequence"] = sequence;
  table["figure"] = key;
  table["unit"] = unit;
  table["better"] = better;
  table["runs"] = owned_array(std::move(runs), {n});
  table["failed"] = owned_array(std::move(failed), {n});
  table["mean"] = owned_array(std::move(mean), {n});
  table["low"] = owned_array(std::move(low), {n});
  table["high"] = owned_array(std::move(high), {n});
  table["noise_floor"] = owned_array(std::move(floor), {n});
  return table;
}

/// Columns of the figures of a gate, the worst first.
Table judged_table(const GateResult& result) {
  std::vector<std::string> sequence, figure, unit, verdict, change, rule, reason;
  std::vector<double> before, after, worse_by;
  std::vector<std::int64_t> needed;
  for (const GateFigure& each : result.figures) {
    sequence.push_back(each.sequence);
    figure.push_back(each.figure);
    unit.push_back(each.unit);
    verdict.emplace_back(to_string(each.standing));
    before.push_back(each.before.value_or(kUnknown));
    after.push_back(each.after.value_or(kUnknown));
    change.push_back(each.change);
    worse_by.push_back(each.worse_by);
    rule.push_back(each.rule);
    reason.push_back(each.reason);
    needed.push_back(each.runs_needed);
  }
  const std::size_t n = before.size();
  Table table;
  table["sequence"] = sequence;
  table["figure"] = figure;
  table["unit"] = unit;
  table["verdict"] = verdict;
  table["before"] = owned_array(std::move(before), {n});
  table["after"] = owned_array(std::move(after), {n});
  table["change"] = change;
  table["worse_by"] = owned_array(std::move(worse_by), {n});
  table["rule"] = rule;
  table["reason"] = reason;
  table["runs_needed"] = owned_array(std::move(needed), {n});
  return table;
}

std::vector<std::optional<double>> values_of(const Record& record, const std::string& sequence,
                                             const std::string& figure) {
  const SequenceRecord* found = record.find(sequence);
  const FigureRecord* values = found ? found->find(figure) : nullptr;
  require(values != nullptr, fmt::format("the record has no figure {} of {}", figure, sequence));
  return values->values;
}

Record record_of_runs(const std::string& name, const Trajectory& truth,
                      const std::vector<EvaluationResult>& runs,
                      const std::vector<std::string>& programs) {
  const WithoutGil released;
  Record record{programs, {record_of(name, truth, runs)}};
  record.check();
  return record;
}

void bind_record(nb::module_& m) {
  nb::class_<Record>(m, "RunRecord", doc("Record"))
      .def_prop_ro("programs", as_tuple(&Record::programs), doc("Record::programs"))
      .def_prop_ro(
          "failures",
          [](const Record& record) {
            std::map<std::string, std::vector<std::string>> failures;
            for (const SequenceRecord& each : record.sequences)
              failures[each.name] = each.failures;
            return failures;
          },
          doc("SequenceRecord::failures"))
      .def("figure_table", &figure_table, "Columns of the figures of all sequences.")
      .def("values", &values_of, "sequence"_a, "figure"_a, doc("FigureRecord::values"))
      .def(
          "with_runs",
          [](const Record& record, const Record& more) {
            Record both = record;
            add_runs(more, {"the record", "the runs that are added"}, both);
            return both;
          },
          "more"_a, "A record with the runs of another one behind its own.")
      .def("to_json", [](const Record& record) { return to_json(record); },
           "The record as JSON, as `placegraph eval record` writes it.");
  m.def("record_of_runs", &record_of_runs, "name"_a, "truth"_a, "runs"_a, "programs"_a,
        doc("record_of"));
  m.def(
      "write_record",
      [](const Record& record, const std::string& path, bool force) {
        require_free(path, force);
        write_file(path, to_json(record));
      },
      "record"_a, "path"_a, "force"_a = false, nb::call_guard<WithoutGil>(),
      "Writes the file of a record. ArgumentError: it exists and `force` is False.");
  m.def("read_record", &read_record, "path"_a, nb::call_guard<WithoutGil>(), doc("read_record"));
}

GateResult judged(const Record& baseline, const std::vector<Record>& candidates,
                  const std::vector<std::string>& names, const GateRules& rules, double level,
                  double power) {
  const WithoutGil released;
  GateOptions options;
  options.level = level;
  options.power = power;
  return judge(baseline, merged(candidates, names), rules, options);
}

}  // namespace

void bind_gate(nb::module_& m) {
  bind_record(m);
  nb::class_<GateRules>(m, "GateRules", doc("GateRules"));
  m.def("default_gate_rules", [] { return default_rules(); }, "The rules of a gate that is given none.");
  m.def("read_gate_rules", &read_gate_rules, "path"_a, doc("read_gate_rules"));
  m.def("parse_gate_rules", &parse_rules, "text"_a, "source"_a = "rules",
        "Reads rules, a line each. FileError names the source and the line.");
  nb::class_<GateResult>(m, "GateJudgement", doc("GateResult"))
      .def_prop_ro("exit_code", &GateResult::exit_code, doc("GateResult::exit_code"))
      .def_ro("sentence", &GateResult::sentence, doc("GateResult::sentence"))
      .def("figure_table", &judged_table, "Columns of the judged figures, the worst first.")
      .def(
          "to_text", [](const GateResult& r, bool everything) { return to_text(r, everything); },
          "everything"_a = false, "The verdict, a table and sentences, for people.")
      .def("to_json", [](const GateResult& r) { return to_json(r); }, "The judgement as JSON.")
      .def("to_markdown", [](const GateResult& r) { return to_markdown(r); },
           "A page for a pull request: what regressed first, the rest folded.")
      .def("to_junit", [](const GateResult& r) { return to_junit(r); }, doc("to_junit"));
  m.def("judge_records", &judged, "baseline"_a, "candidates"_a, "names"_a, "rules"_a,
        "level"_a = 0.05, "power"_a = 0.8, "Judges candidates, runs of one system, by the rules.");
}

}  // namespace placegraph::python
