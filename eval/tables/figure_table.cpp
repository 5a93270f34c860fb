#include <fmt/format.h>
#include <placegraph/eval/tables/figure_table.h>
#include <placegraph/eval/tables/printed_table.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// A best value that is of fewer frames than another by more than this share is not marked.
/// Chosen: the frames before a system has begun are fewer, half a drive is more.
constexpr double kSameCoverage = 0.01;

/// A cell among those it is compared with.
struct ComparedCell {
  const TableCell* cell;
  std::size_t row, column;
};

bool is_compared(const TableCell& cell) { return cell.value && cell.text.empty(); }

/// Marks the best of cells that are figures of one kind.
void mark_best(const std::vector<ComparedCell>& cells, BetterFigure better, int decimals,
               std::vector<std::vector<bool>>& marks) {
  if (better == BetterFigure::kNone || cells.size() < 2) return;
  const auto cost = [better](const ComparedCell& c) {
    if (better == BetterFigure::kNearerZero) return std::abs(*c.cell->value);
    return better == BetterFigure::kHigher ? -*c.cell->value : *c.cell->value;
  };
  const ComparedCell& first = *std::ranges::min_element(cells, {}, cost);
  const TableCell& best = *first.cell;
  const auto text_of = [&](const ComparedCell& c) { return number_text(cost(c), decimals); };
  const std::string text = text_of(first);
  double most_coverage = 0;
  for (const ComparedCell& each : cells)
    most_coverage = std::max(most_coverage, each.cell->coverage);
  if (best.coverage < most_coverage - kSameCoverage) return;
  for (const ComparedCell& each : cells)
    if (text_of(each) == text &&
        each.cell->coverage >= most_coverage - kSameCoverage)
      marks[each.row][each.column] = true;
}

}  // namespace

void FigureTable::check() const {
  for (const TableColumn& column : columns)
    require(!column.decimals || (*column.decimals >= 0 && *column.decimals <= 17),
            "table: a column has from 0 to 17 decimals");
  for (const TableRow& row : rows) {
    require(row.cells.size() == columns.size(),
            fmt::format("table: the row '{}' has {} cells for {} columns", row.name,
                        row.cells.size(), columns.size()));
    for (const TableCell& cell : row.cells)
      require((!cell.value || std::isfinite(*cell.value)) &&
                  (!cell.interval ||
                   (std::isfinite(cell.interval->first) && std::isfinite(cell.interval->second))),
              fmt::format("table: the row '{}' has a number that is not finite", row.name));
  }
}

std::vector<std::vector<bool>> best_cells(const FigureTable& table) {
  table.check();
  std::vector<std::vector<bool>> marks(table.rows.size(),
                                       std::vector<bool>(table.columns.size(), false));
  const std::vector<int> decimals = decimals_of_columns(table);
  const auto compare = [&](const std::vector<ComparedCell>& cells, std::size_t column) {
    mark_best(cells, table.columns[column].better, decimals[column], marks);
  };
  for (std::size_t c = 0; table.best == TableBest::kColumn && c < table.columns.size(); ++c) {
    std::vector<ComparedCell> cells;
    for (std::size_t r = 0; r < table.rows.size(); ++r)
      if (const TableCell& cell = table.rows[r].cells[c];
          is_compared(cell) && !table.rows[r].summary)
        cells.push_back({&cell, r, c});
    compare(cells, c);
  }
  for (std::size_t r = 0; table.best == TableBest::kRow && r < table.rows.size(); ++r)
    for (std::size_t first = 0, end = 0; first < table.columns.size(); first = end) {
      std::vector<ComparedCell> cells;
      for (end = first + 1;
           end < table.columns.size() && same_group(table.columns[first], table.columns[end]);)
        ++end;
      if (table.rows[r].summary && table.columns[first].better == BetterFigure::kNearerZero) continue;
      for (std::size_t c = first; c < end; ++c)
        if (const TableCell& cell = table.rows[r].cells[c]; is_compared(cell))
          cells.push_back({&cell, r, c});
      compare(cells, first);
    }
  return marks;
}

}  // namespace placegraph
