// LaTeX, Markdown and HTML of table_writers.h.
#include <fmt/format.h>
#include <placegraph/eval/tables/printed_table.h>
#include <placegraph/eval/tables/table_writers.h>

#include <functional>
#include <string_view>

namespace placegraph {
namespace {

/// What stands for a character in a language; nothing: itself.
using EscapedCharacter = std::string_view (*)(char);

std::string escaped(const std::string& text, EscapedCharacter escape) {
  std::string result;
  for (const char c : text) {
    const std::string_view other = escape(c);
    if (other.empty())
      result += c;
    else
      result += other;
  }
  return result;
}

std::string_view latex_character(char c) {
  switch (c) {
    case '\\':
      return "\\textbackslash{}";
    case '~':
      return "\\textasciitilde{}";
    case '^':
      return "\\textasciicircum{}";
    case '<':
      return "\\textless{}";
    case '>':
      return "\\textgreater{}";
    case '|':
      return "\\textbar{}";
    case '"':
      return "\\char34{}";
    case '_':
      return "\\_";
    case '%':
      return "\\%";
    case '&':
      return "\\&";
    case '#':
      return "\\#";
    case '$':
      return "\\$";
    case '{':
      return "\\{";
    case '}':
      return "\\}";
    case '[':
      return "{[}";  // behind \\ it would begin a length
    case ']':
      return "{]}";
    case '\n':
    case '\r':
    case '\t':
      return " ";
    default:
      return {};
  }
}

std::string_view html_character(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

std::string_view markdown_character(char c) {
  switch (c) {
    case '\\':
      return "\\\\";
    case '|':
      return "\\|";
    case '*':
      return "\\*";
    case '_':
      return "\\_";
    case '`':
      return "\\`";
    case '~':
      return "\\~";
    case '[':
      return "\\[";
    case ']':
      return "\\]";
    case '#':
      return "\\#";
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '\n':
    case '\r':
    case '\t':
      return " ";
    default:
      return {};
  }
}

std::string latex(const std::string& text) { return escaped(text, latex_character); }
std::string html(const std::string& text) { return escaped(text, html_character); }
std::string markdown(const std::string& text) { return escaped(text, markdown_character); }

std::string latex_cell(const PrintedCell& cell) {
  std::string number = cell.number.empty() ? "--" : latex(cell.number);
  if (number.starts_with('-') && !cell.number.empty()) number = "$-$" + number.substr(1);
  if (cell.best) number = "\\textbf{" + number + "}";
  if (!cell.interval.empty()) number += " " + latex(cell.interval);
  if (cell.note > 0) number += fmt::format("\\textsuperscript{{{}}}", cell.note);
  return number;
}

std::string latex_heads(const FigureTable& table, const PrintedTable& shown) {
  std::string text, rules;
  for (const PrintedGroup& group : shown.groups) {
    text += fmt::format(" & \\multicolumn{{{}}}{{c}}{{{}}}", group.count, latex(group.heading));
    if (!group.heading.empty())
      rules +=
          fmt::format(" \\cmidrule(lr){{{}-{}}}", group.first + 2, group.first + group.count + 1);
  }
  if (!shown.groups.empty()) text = fmt::format("  {} \\\\\n {}\n", text, rules);
  text += "  " + latex(table.corner);
  for (const std::string& heading : shown.headings) text += " & " + latex(heading);
  return text + " \\\\\n";
}

std::string markdown_cell(const PrintedCell& cell) {
  std::string number = cell.number.empty() ? "-" : markdown(cell.number);
  if (cell.best) number = "**" + number + "**";
  if (!cell.interval.empty()) number += " " + markdown(cell.interval);
  if (cell.note > 0) number += fmt::format(" ({})", cell.note);
  return number;
}

std::string html_cell(const PrintedCell& cell, const std::vector<std::string>& notes) {
  std::string number = cell.number.empty() ? "–" : html(cell.number);
  if (cell.best) number = "<b>" + number + "</b>";
  if (!cell.interval.empty()) number += " <small>" + html(cell.interval) + "</small>";
  if (cell.note > 0)
    number += fmt::format("<sup title=\"{}\">{}</sup>", html(notes[cell.note - 1]), cell.note);
  return "<td>" + number + "</td>";
}

std::string html_heads(const FigureTable& table, const PrintedTable& shown) {
  std::string text = "<thead>\n";
  if (!shown.groups.empty()) {
    text += "<tr><td></td>";
    for (const PrintedGroup& group : shown.groups)
      text += fmt::format("<th scope=\"colgroup\" colspan=\"{}\">{}</th>", group.count,
                          html(group.heading));
    text += "</tr>\n";
  }
  text += "<tr><th scope=\"col\">" + html(table.corner) + "</th>";
  for (const std::string& heading : shown.headings)
    text += "<th scope=\"col\">" + html(heading) + "</th>";
  return text + "</tr>\n</thead>\n";
}

}  // namespace

std::string to_latex(const FigureTable& table) {
  const PrintedTable shown = printed(table);
  if (table.columns.empty()) return {};
  std::string text = "\\begin{table}\n  \\centering\n";
  if (!table.caption.empty()) text += fmt::format("  \\caption{{{}}}\n", latex(table.caption));
  text += fmt::format("  \\begin{{tabular}}{{l{}}}\n  \\toprule\n",
                      std::string(table.columns.size(), 'r'));
  text += latex_heads(table, shown) + "  \\midrule\n";
  bool summary = false;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    if (table.rows[r].summary && !summary && r > 0) text += "  \\midrule\n";
    summary = table.rows[r].summary;
    text += "  " + latex(table.rows[r].name);
    for (const PrintedCell& cell : shown.cells[r]) text += " & " + latex_cell(cell);
    text += " \\\\\n";
  }
  text += "  \\bottomrule\n  \\end{tabular}\n";
  std::string notes;
  for (std::size_t i = 0; i < shown.notes.size(); ++i)
    notes += fmt::format("  \\textsuperscript{{{}}} {}\\\\\n", i + 1, latex(shown.notes[i]));
  for (const std::string& note : table.notes) notes += "  " + latex(note) + "\\\\\n";
  if (!notes.empty()) text += "\n  \\smallskip\n  {\\footnotesize\n" + notes + "  }\n";
  return text + "\\end{table}\n";
}

std::string to_markdown(const FigureTable& table) {
  const PrintedTable shown = printed(table);
  std::string text, rule = "|---|", head = "| " + markdown(table.corner) + " |";
  if (!table.caption.empty()) text = markdown(table.caption) + "\n\n";
  for (const TableColumn& column : table.columns) {
    const std::string figure =
        with_unit(column.group.empty() ? column.name : column.group, column.unit);
    head += " " + markdown(figure + (column.group.empty() ? "" : " " + column.name)) + " |";
    rule += "---:|";
  }
  text += head + "\n" + rule + "\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    text += "| " + markdown(table.rows[r].name) + " |";
    for (const PrintedCell& cell : shown.cells[r]) text += " " + markdown_cell(cell) + " |";
    text += "\n";
  }
  // A blank line between them: each is a paragraph.
  for (std::size_t i = 0; i < shown.notes.size(); ++i)
    text += fmt::format("\n({}) {}\n", i + 1, markdown(shown.notes[i]));
  for (const std::string& note : table.notes) text += "\n" + markdown(note) + "\n";
  return text;
}

std::string to_html_fragment(const FigureTable& table) {
  const PrintedTable shown = printed(table);
  std::string text = "<figure class=\"placegraph-table\">\n<table>\n";
  if (!table.caption.empty()) text += "<caption>" + html(table.caption) + "</caption>\n";
  text += html_heads(table, shown) + "<tbody>\n";
  bool summary = false;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    if (table.rows[r].summary && !summary && r > 0) text += "</tbody>\n<tbody>\n";
    summary = table.rows[r].summary;
    text += "<tr><th scope=\"row\">" + html(table.rows[r].name) + "</th>";
    for (const PrintedCell& cell : shown.cells[r]) text += html_cell(cell, shown.notes);
    text += "</tr>\n";
  }
  text += "</tbody>\n</table>\n";
  std::string notes;
  for (std::size_t i = 0; i < shown.notes.size(); ++i)
    notes += fmt::format("<p><sup>{}</sup> {}</p>\n", i + 1, html(shown.notes[i]));
  for (const std::string& note : table.notes) notes += "<p>" + html(note) + "</p>\n";
  if (!notes.empty()) text += "<figcaption>\n" + notes + "</figcaption>\n";
  return text + "</figure>\n";
}

std::string to_html(const FigureTable& table) {
  constexpr std::string_view kHead =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>";
  constexpr std::string_view kStyle =
      "</title>\n<style>\n"
      ":root { color-scheme: light dark; }\n"
      "body { font: 15px/1.45 \"DejaVu Sans\", Verdana, Helvetica, Arial, sans-serif; margin: 2em; "
      "}\n"
      "figure { margin: 0; overflow-x: auto; }\n"
      "table { border-collapse: collapse; font-variant-numeric: tabular-nums; }\n"
      "caption { text-align: left; font-weight: bold; padding-bottom: .6em; }\n"
      "th, td { padding: .25em .7em; text-align: right; font-weight: normal; white-space: nowrap; "
      "}\n"
      "tr > :first-child { text-align: left; }\n"
      "th[scope=colgroup] { text-align: center; border-bottom: 1px solid #8888; }\n"
      "tbody { border-top: 1px solid; }\ntable { border-bottom: 1px solid; }\n"
      "b { font-weight: bold; }\nfigcaption { font-size: 13px; }\nfigcaption p { margin: .4em 0; "
      "}\n</style>\n</head>\n<body>\n";
  const std::string title = table.caption.empty() ? "Figures" : html(table.caption);
  return std::string(kHead) + title + std::string(kStyle) + to_html_fragment(table) +
         "</body>\n</html>\n";
}

}  // namespace placegraph
