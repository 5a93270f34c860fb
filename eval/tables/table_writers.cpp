#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/tables/printed_table.h>
#include <placegraph/eval/tables/table_writers.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/csv_text.h>
#include <placegraph/graph/text/json_text.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

/// Characters of a text in UTF-8.
std::size_t width_of_text(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string blanks(width - std::min(width, width_of_text(text)), ' ');
  return right ? blanks + text : text + blanks;
}

/// A text without line breaks.
std::string on_one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text;
}

/// What stands before and behind the last digit: numbers of a column end below each other.
std::pair<std::string, std::string> text_cell(const PrintedCell& cell) {
  std::string behind = cell.best ? "*" : "";
  if (!cell.interval.empty()) behind += " " + cell.interval;
  if (cell.note > 0) behind += fmt::format(" ({})", cell.note);
  return {cell.number.empty() ? "-" : on_one_line(cell.number), behind};
}

/// Widths of the parts of the columns.
struct ColumnWidths {
  std::vector<std::size_t> number, behind, whole;

  ColumnWidths(const PrintedTable& table) : number(table.headings.size()), behind(number) {
    for (const std::vector<PrintedCell>& row : table.cells)
      for (std::size_t c = 0; c < row.size(); ++c) {
        const auto [before, after] = text_cell(row[c]);
        number[c] = std::max(number[c], width_of_text(before));
        behind[c] = std::max(behind[c], width_of_text(after));
      }
    for (std::size_t c = 0; c < number.size(); ++c)
      whole.push_back(std::max(number[c] + behind[c], width_of_text(table.headings[c])));
    // A heading across several columns widens the last one.
    for (const PrintedGroup& group : table.groups) {
      std::size_t all = 2 * (group.count - 1);
      for (std::size_t c = group.first; c < group.first + group.count; ++c) all += whole[c];
      if (const std::size_t wanted = width_of_text(group.heading); wanted > all)
        whole[group.first + group.count - 1] += wanted - all;
    }
  }
};

void add_text_row(std::string line, std::string& text) {
  line.erase(line.find_last_not_of(' ') + 1);
  text += line + "\n";
}

std::string text_heads(const FigureTable& table, const PrintedTable& shown,
                       const ColumnWidths& widths, std::size_t name_width) {
  std::string text, line = std::string(name_width, ' ');
  for (const PrintedGroup& group : shown.groups) {
    std::size_t width = 2 * (group.count - 1);
    for (std::size_t c = group.first; c < group.first + group.count; ++c) width += widths.whole[c];
    line += "  " + padded(on_one_line(group.heading), width, false);
  }
  if (!shown.groups.empty()) add_text_row(line, text);
  line = padded(on_one_line(table.corner), name_width, false);
  for (std::size_t c = 0; c < shown.headings.size(); ++c)
    line += "  " +
            padded(padded(on_one_line(shown.headings[c]), widths.whole[c] - widths.behind[c], true),
                   widths.whole[c], false);
  add_text_row(line, text);
  return text;
}

nlohmann::ordered_json cell_json(const TableCell& cell, bool best) {
  nlohmann::ordered_json json;
  json["value"] = cell.value ? nlohmann::ordered_json(*cell.value) : nullptr;
  if (cell.interval) {
    json["low"] = cell.interval->first;
    json["high"] = cell.interval->second;
  }
  if (!cell.text.empty()) json["text"] = cell.text;
  if (best) json["best"] = true;
  if (cell.value) json["coverage"] = cell.coverage;
  if (!cell.note.empty()) json["note"] = cell.note;
  return json;
}

/// Name of a column where no heading stands above it.
std::string whole_heading(const TableColumn& column) {
  const std::string figure = column.group.empty() ? column.name : column.group;
  return with_unit(figure, column.unit) + (column.group.empty() ? "" : " " + column.name);
}

}  // namespace

std::string to_text(const FigureTable& table) {
  const PrintedTable shown = printed(table);
  const ColumnWidths widths(shown);
  std::size_t name_width = width_of_text(table.corner);
  for (const TableRow& row : table.rows) name_width = std::max(name_width, width_of_text(row.name));
  std::string text = table.caption.empty() ? "" : on_one_line(table.caption) + "\n\n";
  text += text_heads(table, shown, widths, name_width);
  bool above = false;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    if (table.rows[r].summary && !above && r > 0) text += "\n";
    above = table.rows[r].summary;
    std::string line = padded(on_one_line(table.rows[r].name), name_width, false);
    for (std::size_t c = 0; c < shown.headings.size(); ++c) {
      const auto [before, behind] = text_cell(shown.cells[r][c]);
      line += "  " + padded(padded(before, widths.whole[c] - widths.behind[c], true) + behind,
                            widths.whole[c], false);
    }
    add_text_row(line, text);
  }
  const bool any_best = std::ranges::any_of(shown.cells, [](const auto& row) {
    return std::ranges::any_of(row, &PrintedCell::best);
  });
  if (any_best || !shown.notes.empty() || !table.notes.empty()) text += "\n";
  if (any_best)
    text += table.best == TableBest::kRow ? "* best of its row\n" : "* best of its column\n";
  for (std::size_t i = 0; i < shown.notes.size(); ++i)
    text += fmt::format("({}) {}\n", i + 1, on_one_line(shown.notes[i]));
  for (const std::string& note : table.notes) text += on_one_line(note) + "\n";
  return text;
}

std::string to_csv(const FigureTable& table) {
  table.check();
  CsvText csv;
  std::vector<bool> bounded;
  csv.add(table.corner);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    bounded.push_back(std::ranges::any_of(
        table.rows, [c](const TableRow& row) { return row.cells[c].interval.has_value(); }));
    const std::string heading = whole_heading(table.columns[c]);
    csv.add(heading);
    if (bounded[c]) csv.add(heading + " low").add(heading + " high");
  }
  csv.add("notes").end_row();
  for (const TableRow& row : table.rows) {
    csv.add(row.name);
    std::string notes;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const TableCell& cell = row.cells[c];
      cell.text.empty() && cell.value ? csv.add(*cell.value) : csv.add(cell.text);
      if (bounded[c] && cell.interval)
        csv.add(cell.interval->first).add(cell.interval->second);
      else if (bounded[c])
        csv.add("").add("");
      if (!cell.note.empty())
        notes += fmt::format("{}{}: {}", notes.empty() ? "" : "; ", whole_heading(table.columns[c]),
                             cell.note);
    }
    csv.add(notes).end_row();
  }
  return csv.text();
}

std::string to_json(const FigureTable& table) {
  const std::vector<std::vector<bool>> best = best_cells(table);
  nlohmann::ordered_json json;
  json["caption"] = table.caption;
  json["corner"] = table.corner;
  json["columns"] = nlohmann::ordered_json::array();
  for (const TableColumn& column : table.columns)
    json["columns"].push_back(
        {{"name", column.name}, {"group", column.group}, {"unit", column.unit}});
  json["rows"] = nlohmann::ordered_json::array();
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    nlohmann::ordered_json row = {{"name", table.rows[r].name},
                                  {"summary", table.rows[r].summary},
                                  {"cells", nlohmann::ordered_json::array()}};
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      row["cells"].push_back(cell_json(table.rows[r].cells[c], best[r][c]));
    json["rows"].push_back(std::move(row));
  }
  json["notes"] = table.notes;
  return json_text(json, 2);
}

const std::vector<std::string>& table_file_endings() {
  static const std::vector<std::string> endings = {".txt", ".csv", ".tex", ".md", ".json", ".html"};
  return endings;
}

std::string table_file_text(const FigureTable& table, const std::string& path) {
  if (path.ends_with(".txt")) return to_text(table);
  if (path.ends_with(".csv")) return to_csv(table);
  if (path.ends_with(".tex")) return to_latex(table);
  if (path.ends_with(".md")) return to_markdown(table);
  if (path.ends_with(".json")) return to_json(table);
  if (path.ends_with(".html")) return to_html(table);
  throw ArgumentError(
      fmt::format("{}: a table ends in one of {}", path, fmt::join(table_file_endings(), ", ")));
}

}  // namespace placegraph
