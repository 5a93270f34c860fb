#include <fmt/format.h>
#include <placegraph/eval/gate/gate.h>
#include <placegraph/graph/text/json_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

constexpr std::array kColumns = {"verdict", "sequence", "figure", "before", "after",
                                 "change",  "rule"};
using GateCells = std::array<std::string, kColumns.size()>;

GateCells cells_of(const GateFigure& figure) {
  const auto or_dash = [](const std::string& text) { return text.empty() ? "-" : text; };
  std::string name = or_dash(figure.figure);
  if (!figure.unit.empty()) name += " [" + figure.unit + "]";
  return {to_string(figure.standing), figure.sequence,        name, figure.before_text,
          figure.after_text,          or_dash(figure.change), or_dash(figure.rule)};
}

/// Whether a figure stands in a short report.
bool noteworthy(const GateFigure& figure) {
  return figure.standing != Standing::kSame && figure.standing != Standing::kReported;
}

const char* headline(const GateResult& result) {
  switch (result.verdict) {
    case Standing::kRegressed: return "Regressed";
    case Standing::kUnjudged: return "Cannot be judged";
    default: return "No regression";
  }
}

std::string counts_text(const GateResult& result) {
  std::string text;
  for (const Standing standing :
       {Standing::kRegressed, Standing::kUnjudged, Standing::kImproved, Standing::kWithin,
        Standing::kNew, Standing::kReported, Standing::kSame})
    if (const int count = result.count(standing))
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, to_string(standing));
  return fmt::format("{} figures: {}.", result.figures.size(), text);
}

/// Width of a text in characters of UTF-8.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string table_text(const std::vector<GateCells>& rows) {
  std::array<std::size_t, kColumns.size()> widths{};
  for (const GateCells& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  std::string text;
  for (const GateCells& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += row[i] + std::string(widths[i] - width_of(row[i]) + 2, ' ');
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string markdown_cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\n' || c == '\r')
      result += ' ';
    else if (c == '<')
      result += "&lt;";
    else if (std::string_view("|*_`\\[").find(c) != std::string_view::npos)
      result += std::string("\\") + c;
    else
      result += c;
  }
  return result;
}

std::string markdown_table(const std::vector<const GateFigure*>& figures) {
  std::string text = "|", line = "|";
  for (const char* column : kColumns) {
    text += fmt::format(" {} |", column);
    line += "---|";
  }
  text += "\n" + line + "\n";
  for (const GateFigure* figure : figures) {
    text += "|";
    const bool bold = figure->standing == Standing::kRegressed;
    const GateCells cells = cells_of(*figure);
    for (std::size_t i = 0; i < cells.size(); ++i)
      text += fmt::format(" {0}{1}{0} |", bold && i == 0 ? "**" : "", markdown_cell(cells[i]));
    text += "\n";
  }
  return text;
}

/// Text of XML 1.0, also within quotation marks.
std::string xml_text(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      case '\'': result += "&apos;"; break;
      case '\n': result += "&#10;"; break;
      case '\t': result += "&#9;"; break;
      case '\r': result += "&#13;"; break;
      default: result += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
  return result;
}

std::string test_case(const GateFigure& figure) {
  std::string text =
      fmt::format("    <testcase classname=\"{}\" name=\"{}\">\n", xml_text(figure.sequence),
                  xml_text(figure.figure.empty() ? "(the sequence)" : figure.figure));
  const std::string reported =
      fmt::format("{} to {} {} ({}), rule: {}", figure.before_text, figure.after_text, figure.unit,
                  figure.change, figure.rule);
  if (figure.standing == Standing::kRegressed || figure.standing == Standing::kUnjudged) {
    const char* element = figure.standing == Standing::kRegressed ? "failure" : "error";
    text += fmt::format("      <{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n", element,
                        to_string(figure.standing), xml_text(figure.reason), xml_text(reported));
  } else {
    text += fmt::format("      <system-out>{}: {}</system-out>\n", to_string(figure.standing),
                        xml_text(reported));
  }
  return text + "    </testcase>\n";
}

nlohmann::ordered_json figure_report(const GateFigure& figure) {
  const auto number = [](std::optional<double> value) {
    return value && std::isfinite(*value) ? nlohmann::ordered_json(*value) : nullptr;
  };
  nlohmann::ordered_json json = {{"sequence", figure.sequence},
                                 {"figure", figure.figure},
                                 {"unit", figure.unit},
                                 {"verdict", to_string(figure.standing)},
                                 {"before", number(figure.before)},
                                 {"after", number(figure.after)},
                                 {"change", figure.change},
                                 {"worse_by", number(figure.worse_by)},
                                 {"rule", figure.rule},
                                 {"reason", figure.reason}};
  if (figure.runs_needed > 0) json["runs_needed"] = figure.runs_needed;
  return json;
}

}  // namespace

std::string to_text(const GateResult& result, bool everything) {
  std::string text = fmt::format("{}: {}\n\nbefore  {}\nafter   {}\n\n", headline(result),
                                 result.sentence, result.baseline, result.candidate);
  std::vector<GateCells> rows = {GateCells()};
  std::ranges::copy(kColumns, rows.front().begin());
  std::string reasons;
  for (const GateFigure& figure : result.figures) {
    if (!everything && figure.standing == Standing::kSame) continue;
    rows.push_back(cells_of(figure));
    if (noteworthy(figure) && !figure.reason.empty())
      reasons += fmt::format("{}{}{}: {}.\n", figure.sequence, figure.figure.empty() ? "" : " ",
                             figure.figure, figure.reason);
  }
  if (rows.size() > 1) text += table_text(rows) + "\n";
  if (!reasons.empty()) text += reasons + "\n";
  return text + counts_text(result) + "\n";
}

std::string to_json(const GateResult& result) {
  nlohmann::ordered_json json = {{"verdict", result.exit_code() == 0 ? "no regression"
                                                                     : to_string(result.verdict)},
                                 {"exit_code", result.exit_code()},
                                 {"sentence", result.sentence},
                                 {"baseline", result.baseline},
                                 {"candidate", result.candidate},
                                 {"figures", nlohmann::ordered_json::array()}};
  for (const GateFigure& figure : result.figures) json["figures"].push_back(figure_report(figure));
  return json_text(json, 1);
}

std::string to_markdown(const GateResult& result) {
  std::vector<const GateFigure*> shown, folded;
  for (const GateFigure& figure : result.figures)
    (figure.standing == Standing::kRegressed || figure.standing == Standing::kUnjudged ||
             figure.standing == Standing::kImproved
         ? shown
         : folded)
        .push_back(&figure);
  std::string text = fmt::format("### {}\n\n{}. {}\n\n", headline(result),
                                 markdown_cell(result.sentence), counts_text(result));
  if (!shown.empty()) {
    text += markdown_table(shown) + "\n";
    for (const GateFigure* figure : shown)
      if (!figure->reason.empty())
        text += fmt::format("- {} {}: {}.\n", markdown_cell(figure->sequence),
                            markdown_cell(figure->figure), markdown_cell(figure->reason));
    text += "\n";
  }
  if (!folded.empty())
    text += fmt::format("<details><summary>{} more figures</summary>\n\n{}\n</details>\n\n",
                        folded.size(), markdown_table(folded));
  return text + fmt::format("Before: {}. After: {}.\n", markdown_cell(result.baseline),
                            markdown_cell(result.candidate));
}

std::string to_junit(const GateResult& result) {
  const std::string counts = fmt::format(
      "tests=\"{}\" failures=\"{}\" errors=\"{}\"", result.figures.size(),
      result.count(Standing::kRegressed), result.count(Standing::kUnjudged));
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {0}>\n"
      "  <testsuite name=\"placegraph eval gate\" {0}>\n",
      counts);
  for (const GateFigure& figure : result.figures) text += test_case(figure);
  return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace placegraph
