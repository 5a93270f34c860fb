#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/trajectory/report.h>
#include <placegraph/graph/text/csv_text.h>
#include <placegraph/graph/text/json_text.h>

#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json groups_json(const std::vector<SegmentGroup>& groups, bool speed) {
  Json rows = Json::array();
  for (const SegmentGroup& group : groups) {
    Json row;
    if (speed) {
      row["from_m_per_s"] = group.from;
      row["to_m_per_s"] = group.to;
    } else {
      row["length_m"] = group.from;
    }
    row["segments"] = group.segments;
    row["t_rel_percent"] = group.t_percent;
    row["r_rel_deg_per_100m"] = group.r_deg_per_100m;
    rows.push_back(row);
  }
  return rows;
}

Json object(const EvaluationResult& r) {
  Json json;
  json["name"] = r.name;
  json["outcome"] = r.outcome ? "ok" : r.outcome.reason;
  json["align"] = to_string(r.protocol.alignment);
  json["scale"] = r.outcome ? Json(r.alignment.scale) : Json(nullptr);
  json["frames"] = r.frames;
  json["judged"] = r.judged;
  json["posed"] = r.posed;
  json["estimate_frames"] = r.estimate_frames;
  json["estimate_without_truth"] = r.estimate_without_truth;
  for (const Metric& metric : metrics(r)) json[metric.key] = number(metric.value);
  json["path_m"] = r.path_m;
  json["association"] = to_string(r.protocol.association);
  if (r.protocol.association == Association::kTime) {
    json["max_difference_s"] = r.protocol.max_difference_s;
    json["offset_s"] = r.protocol.offset_s;
  }
  if (r.offsets) json["offsets"] = Json::parse(to_json(*r.offsets));
  json["lengths_m"] = r.protocol.lengths_m;
  json["step"] = r.protocol.step;
  json["averaging"] = "mean over all segments";
  json["segments"] = r.segments.segments.size();
  json["segments_skipped"] = r.segments.skipped;
  json["per_length"] = groups_json(r.segments.by_length, false);
  json["per_speed"] = groups_json(r.segments.by_speed, true);
  json["lost_frames"] = r.lost_frames;
  json["warnings"] = r.warnings;
  return json;
}

Json average_json(const AverageResult& mean) {
  Json json;
  json["sequences"] = mean.sequences;
  json["averaging"] =
      "metrics: mean over sequences; pooled_*: mean over all segments of all "
      "sequences";
  for (const Metric& metric : mean.means) json[metric.key] = number(metric.value);
  json[mean.pooled_t_rel.key] = number(mean.pooled_t_rel.value);
  json[mean.pooled_r_rel.key] = number(mean.pooled_r_rel.value);
  json["segments"] = mean.segments;
  return json;
}

std::string latex_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string("_%&#${}").find(c) != std::string::npos) escaped += '\\';
    if (c == '\\')
      escaped += "\\textbackslash{}";
    else if (c == '~' || c == '^')
      escaped += fmt::format("\\{}{{}}", c);
    else
      escaped += c;
  }
  return escaped;
}

std::string cell(const std::optional<double>& value, const char* missing) {
  return value ? fmt::format("{:.4f}", *value) : missing;
}

// The columns of comparison tables, by key.
std::vector<Metric> columns(const std::vector<Metric>& all) {
  std::vector<Metric> chosen;
  for (const char* key : {"ate_rmse_m", "ate_percent_of_path", "t_rel_percent",
                          "r_rel_deg_per_100m", "rpe_trans_m", "rpe_rot_deg", "rpe_rot_median_deg"})
    for (const Metric& metric : all)
      if (metric.key == key) chosen.push_back(metric);
  return chosen;
}

std::string protocol_line(const EvaluationResult& r) {
  return fmt::format(
      "align {}; association by {}; t_rel and r_rel over segments of {} m, start "
      "step {}, mean over all segments",
      to_string(r.protocol.alignment), to_string(r.protocol.association),
      fmt::join(r.protocol.lengths_m, ", "), r.protocol.step);
}

std::string groups_text(const SegmentResult& segments) {
  std::string text = "\n  length [m]   segments   t_rel [%]   r_rel [deg/100m]\n";
  for (const SegmentGroup& g : segments.by_length)
    text += fmt::format("  {:>10g} {:>10} {:>11.4f} {:>18.4f}\n", g.from, g.segments, g.t_percent,
                        g.r_deg_per_100m);
  text += "\n  speed [m/s]  segments   t_rel [%]   r_rel [deg/100m]\n";
  for (const SegmentGroup& g : segments.by_speed)
    text +=
        fmt::format("  {:>10} {:>10} {:>11.4f} {:>18.4f}\n", fmt::format("{:g}-{:g}", g.from, g.to),
                    g.segments, g.t_percent, g.r_deg_per_100m);
  return text;
}

}  // namespace

std::string to_json(const EvaluationResult& result) { return json_text(object(result), 2); }

std::string to_json(const std::vector<EvaluationResult>& results, bool with_average) {
  Json json;
  json["results"] = Json::array();
  for (const EvaluationResult& result : results) json["results"].push_back(object(result));
  if (with_average) json["average"] = average_json(average(results));
  return json_text(json, 2);
}

std::string to_csv(const std::vector<EvaluationResult>& results) {
  CsvText csv;
  csv.row("name", "record", "key", "value", "unit", "first_frame", "last_frame", "length_m",
          "speed_m_per_s", "protocol");
  for (const EvaluationResult& r : results) {
    for (const Metric& m : metrics(r))
      csv.row(r.name, "metric", m.key, m.value ? fmt::format("{}", *m.value) : "", m.unit, "", "",
              "", "", m.protocol);
    for (const SegmentError& s : r.segments.segments) {
      const auto row = [&](const char* key, double value, const char* unit) {
        csv.row(r.name, "segment", key, value, unit, s.first_frame, s.last_frame, s.length_m,
                s.speed_m_per_s, "");
      };
      row("t_rel_percent", s.t_percent, "%");
      row("r_rel_deg_per_100m", s.r_deg_per_100m, "deg/100m");
    }
  }
  return csv.text();
}

std::string to_latex(const std::vector<EvaluationResult>& results) {
  std::string rows, head = "estimate & posed";
  if (results.empty()) return {};
  for (const Metric& metric : columns(metrics(results.front())))
    head += fmt::format(" & {} [{}]", latex_text(metric.name), latex_text(metric.unit));
  for (const EvaluationResult& r : results) {
    rows += fmt::format("  {} & {}/{}", latex_text(r.name), r.posed, r.judged);
    for (const Metric& metric : columns(metrics(r))) rows += " & " + cell(metric.value, "--");
    rows += " \\\\\n";
  }
  return fmt::format(
      "\\begin{{table}}\n  \\centering\n  \\caption{{{}.}}\n  \\begin{{tabular}}{{lr{}}}\n"
      "  \\toprule\n  {} \\\\\n  \\midrule\n{}  \\bottomrule\n  \\end{{tabular}}\n\\end{{table}}\n",
      latex_text(protocol_line(results.front())),
      std::string(columns(metrics(results.front())).size(), 'r'), head, rows);
}

std::string to_text(const EvaluationResult& r) {
  if (!r.outcome) return fmt::format("{}: no figures: {}\n", r.name, r.outcome.reason);
  std::string text =
      fmt::format("{}: {} of {} {}frames posed ({:.1f} %), path {:.1f} m\n", r.name, r.posed,
                  r.judged, r.judged < r.frames ? "judged " : "", 100 * r.coverage, r.path_m);
  if (r.judged < r.frames || r.estimate_without_truth > 0)
    text += fmt::format(
        "  {} frames in the ground truth, {} in the estimate, {} of them without "
        "ground truth\n",
        r.frames, r.estimate_frames, r.estimate_without_truth);
  text +=
      fmt::format("  align {}, scale {:.6f}, association by {}\n", to_string(r.protocol.alignment),
                  r.alignment.scale, to_string(r.protocol.association));
  if (r.offsets) text += to_text(*r.offsets);
  for (const Metric& m : metrics(r)) {
    if (m.key == "coverage") continue;
    text +=
        fmt::format("  {:<15} {:>10} {:<9} {}\n", m.name, cell(m.value, "-"), m.unit, m.protocol);
  }
  if (r.segments.outcome) text += groups_text(r.segments);
  return text;
}

std::string to_table(const std::vector<EvaluationResult>& results, bool with_average) {
  std::size_t width = 22;
  for (const EvaluationResult& r : results) width = std::max(width, r.name.size());
  if (results.empty()) return {};
  std::string text = fmt::format("{:<{}} {:>13}", "estimate", width, "posed");
  for (const Metric& metric : columns(metrics(results.front())))
    text += fmt::format(" {:>14}", metric.name);
  text += fmt::format(" {:>9}\n{:<{}} {:>13}", "scale", "", width, "");
  for (const Metric& metric : columns(metrics(results.front())))
    text += fmt::format(" {:>14}", "[" + metric.unit + "]");
  text += "\n";
  for (const EvaluationResult& r : results) {
    text += fmt::format("{:<{}} {:>13}", r.name, width, fmt::format("{}/{}", r.posed, r.judged));
    for (const Metric& metric : columns(metrics(r)))
      text += fmt::format(" {:>14}", cell(metric.value, "-"));
    text +=
        r.outcome ? fmt::format(" {:>9.6f}\n", r.alignment.scale) : " " + r.outcome.reason + "\n";
  }
  if (with_average) {
    const AverageResult mean = average(results);
    text += fmt::format("{:<{}} {:>13}", fmt::format("mean over sequences"), width,
                        fmt::format("{} seq.", mean.sequences));
    for (const Metric& metric : columns(mean.means))
      text += fmt::format(" {:>14}", cell(metric.value, "-"));
    text += fmt::format("\n{:<{}} {:>13} {:>14} {:>14} {:>14}\n", "mean over all segments", width,
                        fmt::format("{} segm.", mean.segments), "",
                        cell(mean.pooled_t_rel.value, "-"), cell(mean.pooled_r_rel.value, "-"));
  }
  return text + protocol_line(results.front()) + "\n";
}

}  // namespace placegraph
