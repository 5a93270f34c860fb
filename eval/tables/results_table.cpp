// table_of() of figure_table.h.
#include <fmt/format.h>
#include <placegraph/eval/tables/figure_table.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/spelling.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace placegraph {
namespace {

/// A heading across the systems, with a cell for each figure and system.
struct TableLine {
  std::string name;
  bool summary = false;
  std::vector<std::vector<TableCell>> cells;  ///< [figure][system]
};

const SequenceFigures* find_sequence(const NamedResults& system, const std::string& name) {
  const auto found = std::ranges::find(system.sequences, name, &SequenceFigures::name);
  return found == system.sequences.end() ? nullptr : &*found;
}

std::vector<std::string> sequence_names(const std::vector<NamedResults>& systems) {
  std::vector<std::string> names;
  for (const NamedResults& system : systems) {
    std::set<std::string> own;
    for (const SequenceFigures& sequence : system.sequences) {
      require(own.insert(sequence.name).second,
              fmt::format("table: {} has two results of {}", system.name, sequence.name));
      if (std::ranges::count(names, sequence.name) == 0) names.push_back(sequence.name);
    }
  }
  return names;
}

/// One metric of each key, for its name and its unit.
std::vector<Metric> metrics_of(const std::vector<NamedResults>& systems,
                               const std::vector<std::string>& keys) {
  std::vector<Metric> all, chosen;
  std::vector<std::string> known;
  for (const NamedResults& system : systems)
    for (const SequenceFigures& sequence : system.sequences)
      for (const Metric& metric : sequence.figures)
        if (std::ranges::count(known, metric.key) == 0) {
          known.push_back(metric.key);
          all.push_back(metric);
        }
  for (const std::string& key : keys) {
    const auto found = std::ranges::find(all, key, &Metric::key);
    require(found != all.end(), known.empty() ? std::string("table: no system has a figure")
                                              : fmt::format("table: no result has a figure '{}'{}",
                                                            key, did_you_mean(key, known)));
    require(std::ranges::count(keys, key) == 1,
            fmt::format("table: the figure '{}' is asked for twice", key));
    chosen.push_back(*found);
  }
  return chosen;
}

TableCell cell_of(const SequenceFigures* sequence, const std::string& key) {
  TableCell cell;
  cell.coverage = 0;
  if (sequence == nullptr) {
    cell.note = "no estimate";
    return cell;
  }
  const auto metric = std::ranges::find(sequence->figures, key, &Metric::key);
  if (metric != sequence->figures.end() && metric->value && std::isfinite(*metric->value)) {
    cell.value = metric->value;
    cell.coverage = sequence->coverage;
    cell.note = sequence->remark;
    if (const auto found = sequence->intervals.find(key); found != sequence->intervals.end())
      cell.interval = found->second;
    return cell;
  }
  const auto reason = sequence->reasons.find(key);
  if (!sequence->failure.empty())
    cell.note = sequence->failure;
  else
    cell.note = reason != sequence->reasons.end() ? reason->second : "no such figure";
  return cell;
}

/// The mean of a system's cells of one figure over these lines.
TableCell mean_of(const std::vector<TableLine>& lines, const std::vector<std::size_t>& over,
                  std::size_t figure, std::size_t system) {
  TableCell mean;
  mean.coverage = 0;
  double sum = 0;
  for (const std::size_t line : over) {
    const TableCell& cell = lines[line].cells[figure][system];
    sum += *cell.value;
    mean.coverage += cell.coverage / static_cast<double>(over.size());
  }
  mean.value = sum / static_cast<double>(over.size());
  return mean;
}

/// The lines that have a figure of this system.
std::vector<std::size_t> lines_with(const std::vector<TableLine>& lines, std::size_t figure,
                                    const auto& has_all) {
  std::vector<std::size_t> with;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (has_all(lines[i].cells[figure])) with.push_back(i);
  return with;
}

TableLine mean_of_all(const std::vector<TableLine>& lines) {
  TableLine mean{fmt::format("mean of all {}", lines.size()), true, {}};
  const std::size_t figures = lines.front().cells.size(), systems = lines.front().cells[0].size();
  for (std::size_t f = 0; f < figures; ++f) {
    std::vector<TableCell>& cells = mean.cells.emplace_back();
    for (std::size_t s = 0; s < systems; ++s) {
      const auto with =
          lines_with(lines, f, [s](const auto& row) { return row[s].value.has_value(); });
      if (with.size() == lines.size()) {
        cells.push_back(mean_of(lines, with, f, s));
        continue;
      }
      cells.emplace_back().note = fmt::format("no mean of all: {} of {} have no figure",
                                              lines.size() - with.size(), lines.size());
    }
  }
  return mean;
}

/// Nothing if every system has every figure on every line.
std::optional<TableLine> mean_of_common(const std::vector<TableLine>& lines) {
  const std::size_t figures = lines.front().cells.size(), systems = lines.front().cells[0].size();
  TableLine mean{"", true, {}};
  std::set<std::size_t> counts;
  for (std::size_t f = 0; f < figures; ++f) {
    const auto common = lines_with(lines, f, [](const auto& row) {
      return std::ranges::all_of(row, [](const TableCell& c) { return c.value.has_value(); });
    });
    counts.insert(common.size());
    std::vector<TableCell>& cells = mean.cells.emplace_back(systems);
    for (std::size_t s = 0; s < systems; ++s)
      if (common.empty())
        cells[s].note = "no sequence of which all systems have the figure";
      else
        cells[s] = mean_of(lines, common, f, s);
    for (TableCell& cell : cells)
      if (cell.value) cell.note = fmt::format("over {} of {}", common.size(), lines.size());
  }
  if (counts.size() == 1 && *counts.begin() == lines.size()) return std::nullopt;
  mean.name = "mean of those that all have";
  if (counts.size() == 1 && *counts.begin() > 0) {
    mean.name = fmt::format("mean of the {} that all have", *counts.begin());
    for (std::vector<TableCell>& cells : mean.cells)
      for (TableCell& cell : cells) cell.note.clear();
  }
  return mean;
}

TableColumn column_of(const Metric& metric, const std::string& name, bool alone) {
  TableColumn column;
  column.name = alone ? metric.name : name;
  column.group = alone ? "" : metric.name;
  column.unit = metric.unit;
  if (is_share_of_drive(metric.key)) column.better = BetterFigure::kHigher;
  if (metric.key.starts_with("scale_drift")) column.better = BetterFigure::kNearerZero;
  return column;
}

/// The lines of sequences, and below them their means.
std::vector<TableLine> lines_of(const std::vector<NamedResults>& systems,
                                const std::vector<Metric>& figures) {
  std::vector<TableLine> lines;
  for (const std::string& name : sequence_names(systems)) {
    TableLine& line = lines.emplace_back(TableLine{name, false, {}});
    for (const Metric& figure : figures) {
      line.cells.emplace_back();
      for (const NamedResults& system : systems)
        line.cells.back().push_back(cell_of(find_sequence(system, name), figure.key));
    }
  }
  if (lines.size() < 2) return lines;
  TableLine all = mean_of_all(lines);
  std::optional<TableLine> common = mean_of_common(lines);
  lines.push_back(std::move(all));
  if (common) lines.push_back(std::move(*common));
  return lines;
}

void sequences_in_rows(const std::vector<NamedResults>& systems, const std::vector<Metric>& figures,
                       const std::vector<TableLine>& lines, FigureTable& table) {
  table.corner = "sequence";
  table.best = TableBest::kRow;
  if (systems.size() == 1) table.caption = systems.front().name;
  for (const Metric& figure : figures)
    for (const NamedResults& system : systems)
      table.columns.push_back(column_of(figure, system.name, systems.size() == 1));
  for (const TableLine& line : lines) {
    TableRow& row = table.rows.emplace_back(TableRow{line.name, {}, line.summary});
    for (const std::vector<TableCell>& cells : line.cells)
      row.cells.insert(row.cells.end(), cells.begin(), cells.end());
  }
}

void systems_in_rows(const std::vector<NamedResults>& systems, const std::vector<Metric>& figures,
                     const std::vector<TableLine>& lines, FigureTable& table) {
  table.corner = "system";
  table.best = TableBest::kColumn;
  if (lines.size() == 1) table.caption = lines.front().name;
  for (const Metric& figure : figures)
    for (const TableLine& line : lines)
      table.columns.push_back(column_of(figure, line.name, lines.size() == 1));
  for (std::size_t s = 0; s < systems.size(); ++s) {
    TableRow& row = table.rows.emplace_back(TableRow{systems[s].name, {}, false});
    for (std::size_t f = 0; f < figures.size(); ++f)
      for (const TableLine& line : lines) row.cells.push_back(line.cells[f][s]);
  }
}

}  // namespace

SequenceFigures sequence_figures(const EvaluationResult& result, const std::string& name) {
  SequenceFigures figures;
  figures.name = name;
  figures.figures = metrics(result);
  if (!result.outcome) {
    figures.failure = result.outcome.reason;
    figures.coverage = 0;
    return figures;
  }
  for (const Metric& metric : figures.figures) {
    if (metric.value) continue;
    const bool relative = metric.key.starts_with("rpe"), absolute = metric.key.starts_with("ate");
    const Outcome& outcome = absolute   ? result.ape.outcome
                             : metric.key.starts_with("are") ? result.ape.rotation_outcome
                             : relative ? result.rpe.outcome
                                        : result.segments.outcome;
    figures.reasons[metric.key] =
        outcome.reason.empty() ? "the data allow no such figure" : outcome.reason;
  }
  for (const FigureInterval& each : result.intervals)
    if (each.interval.outcome)
      figures.intervals[each.key] = {each.interval.low, each.interval.high};
  figures.coverage = result.coverage;
  if (result.posed < result.judged)
    figures.remark = fmt::format("of {} of {} frames", result.posed, result.judged);
  return figures;
}

FigureTable table_of(const std::vector<NamedResults>& systems, const std::vector<std::string>& keys,
                     TableRows rows) {
  require(!systems.empty(), "table: no system is given");
  require(!keys.empty(), "table: no figure is asked for");
  std::set<std::string> names;
  for (const NamedResults& system : systems)
    require(names.insert(system.name).second,
            fmt::format("table: two systems have the name {}", system.name));
  const std::vector<Metric> figures = metrics_of(systems, keys);
  const std::vector<TableLine> lines = lines_of(systems, figures);
  FigureTable table;
  (rows == TableRows::kSequences ? sequences_in_rows : systems_in_rows)(systems, figures, lines,
                                                                        table);
  return table;
}

}  // namespace placegraph
