#pragma once
#include <placegraph/eval/tables/figure_table.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Writes a table for people: aligned columns, `*` behind the best, notes below.
///
/// All writers round numbers in the same way, except CSV and JSON, which keep every digit. They throw
/// ArgumentError as FigureTable::check().
std::string to_text(const FigureTable& table);

/// Writes a table as CSV, a line for each row, the notes in the last column.
///
/// Missing figures are empty. Where any cell of a column has an interval, two columns with its bounds follow.
std::string to_csv(const FigureTable& table);

/// Writes a LaTeX table (booktabs), best figures bold, notes below; empty without columns.
std::string to_latex(const FigureTable& table);

/// Writes a table in the Markdown of GitHub, best figures bold, notes below.
std::string to_markdown(const FigureTable& table);

/// Writes a table as a JSON object.
///
/// It is {"caption", "corner", "columns": [...], "rows": [{"name", "summary", "cells"}], "notes"}.
/// Cells have value (or null), low, high, text, best, coverage and note, those that they have.
std::string to_json(const FigureTable& table);

/// Writes a `<table>` in a `<figure>` for a page of one's own, without style.
std::string to_html_fragment(const FigureTable& table);

/// Writes a page of its own with the table; it loads nothing.
std::string to_html(const FigureTable& table);

/// The endings of the files that table_file_text() writes.
///
/// .txt, .csv, .tex, .md, .json, .html.
const std::vector<std::string>& table_file_endings();

/// The text of a file of this name, as its ending says.
///
/// Throws ArgumentError for another ending.
std::string table_file_text(const FigureTable& table, const std::string& path);

}  // namespace placegraph
