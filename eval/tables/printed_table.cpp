#include <fmt/format.h>
#include <placegraph/eval/tables/printed_table.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

// Chosen: an error of 0.0005 m is below what any ground truth knows; smaller values alone get more.
constexpr int kUsualDecimals = 4;
constexpr int kMostTableDecimals = 12;  ///< a double has 16 digits
constexpr double kFromExponent = 1e12;

/// Decimals with which a value has so many digits.
int decimals_for(double value, int digits) {
  return digits - 1 - static_cast<int>(std::floor(std::log10(value)));
}

/// Decimals that the cells of the columns from first to end need.
int needed_decimals(const FigureTable& table, std::size_t first, std::size_t end) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0, narrowest = smallest;
  for (const TableRow& row : table.rows)
    for (std::size_t column = first; column < end; ++column) {
      const TableCell& cell = row.cells[column];
      if (!cell.value || *cell.value == 0 || !cell.text.empty()) continue;
      smallest = std::min(smallest, std::abs(*cell.value));
      largest = std::max(largest, std::abs(*cell.value));
      if (!cell.interval) continue;
      const double half = 0.5 * (cell.interval->second - cell.interval->first);
      if (half > 0) narrowest = std::min(narrowest, half);
    }
  if (largest == 0) return kUsualDecimals - 1;
  int decimals =
      std::clamp(decimals_for(smallest, 3), 0, std::max(kUsualDecimals, decimals_for(largest, 3)));
  if (std::isfinite(narrowest)) decimals = std::max(decimals, decimals_for(narrowest, 2));
  return std::clamp(decimals, 0, kMostTableDecimals);
}

std::vector<PrintedGroup> groups_of(const FigureTable& table) {
  std::vector<PrintedGroup> groups;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const TableColumn& column = table.columns[i];
    if (i > 0 && same_group(table.columns[i - 1], column))
      ++groups.back().count;
    else
      groups.push_back({column.group.empty() ? "" : with_unit(column.group, column.unit), i, 1});
  }
  const bool any = std::ranges::any_of(groups, [](const auto& g) { return !g.heading.empty(); });
  return any ? groups : std::vector<PrintedGroup>();
}

}  // namespace

bool same_group(const TableColumn& a, const TableColumn& b) {
  return !a.group.empty() && a.group == b.group && a.unit == b.unit;
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

std::string number_text(double value, int decimals) {
  const double size = std::abs(value);
  const bool small = value != 0 && size < 0.5 && size < 5 * std::pow(10.0, -decimals);
  if (small || size >= kFromExponent) return fmt::format("{:.2e}", value);
  return fmt::format("{:.{}f}", value + 0.0, decimals);
}

std::vector<int> decimals_of_columns(const FigureTable& table) {
  std::vector<int> decimals;
  for (std::size_t first = 0; first < table.columns.size();) {
    std::size_t end = first + 1;
    while (end < table.columns.size() && same_group(table.columns[first], table.columns[end]))
      ++end;
    const int needed = needed_decimals(table, first, end);
    for (; first < end; ++first) decimals.push_back(table.columns[first].decimals.value_or(needed));
  }
  return decimals;
}

PrintedTable printed(const FigureTable& table) {
  table.check();
  PrintedTable result;
  result.groups = groups_of(table);
  for (const TableColumn& column : table.columns)
    result.headings.push_back(column.group.empty() ? with_unit(column.name, column.unit)
                                                   : column.name);
  const std::vector<std::vector<bool>> best = best_cells(table);
  const std::vector<int> decimals = decimals_of_columns(table);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::vector<PrintedCell>& row = result.cells.emplace_back();
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const TableCell& cell = table.rows[r].cells[c];
      PrintedCell& shown = row.emplace_back();
      shown.best = best[r][c];
      if (!cell.text.empty())
        shown.number = cell.text;
      else if (cell.value)
        shown.number = number_text(*cell.value, decimals[c]);
      if (cell.interval)
        shown.interval = fmt::format("[{}, {}]", number_text(cell.interval->first, decimals[c]),
                                     number_text(cell.interval->second, decimals[c]));
      if (cell.note.empty()) continue;
      const auto found = std::ranges::find(result.notes, cell.note);
      shown.note = static_cast<std::size_t>(found - result.notes.begin()) + 1;
      if (found == result.notes.end()) result.notes.push_back(cell.note);
    }
  }
  return result;
}

}  // namespace placegraph
