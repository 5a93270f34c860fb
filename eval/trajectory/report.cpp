#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/trajectory/figure_intervals.h>
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

/// The statistics by their names in files.
std::vector<std::pair<const char*, double>> named_values(const Statistics& s) {
  return {{"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median}, {"std", s.std_dev},
          {"min", s.min},   {"max", s.max},   {"sse", s.sse},       {"p75", s.p75},
          {"p90", s.p90},   {"p95", s.p95},   {"p99", s.p99}};
}

Json statistics_json(const Statistics& s) {
  Json json;
  for (const auto& [name, value] : named_values(s)) json[name] = value;
  json["count"] = s.count;
  return json;
}

/// The errors over the steps of each delta that was asked for.
Json relative_json(const std::vector<RelativeErrors>& relative) {
  Json rows = Json::array();
  for (const RelativeErrors& steps : relative) {
    Json row;
    row["delta"] = to_string(steps.delta);
    row["pairs"] = steps.pairs == StepPairs::kAll ? "all" : "consecutive";
    row["outcome"] = steps.outcome ? "ok" : steps.outcome.reason;
    row["steps"] = steps.errors.size();
    row["gaps"] = steps.gaps;
    if (steps.outcome) {
      row["translation_m"] = statistics_json(steps.translation_m);
      row["rotation_deg"] = statistics_json(steps.rotation_deg);
      if (steps.has_vertical) {
        row["heading_deg"] = statistics_json(steps.heading_deg);
        row["inclination_deg"] = statistics_json(steps.inclination_deg);
      }
      row["full"] = statistics_json(steps.full);
      row["length_m"] = statistics_json(steps.length_m);
    }
    rows.push_back(row);
  }
  return rows;
}

Json profile_rows(const std::vector<ErrorGroup>& groups, const char* unit) {
  Json rows = Json::array();
  for (const ErrorGroup& group : groups) {
    Json row;
    row[std::string("from_") + unit] = group.from;
    row[std::string("to_") + unit] = group.to;
    row["frames"] = group.frames;
    row["position_rmse_m"] = group.ate_rmse_m;
    row["step_trans_rmse_m"] = group.rpe_trans_m;
    row["step_rot_rmse_deg"] = group.rpe_rot_deg;
    rows.push_back(row);
  }
  return rows;
}

Json worst_json(const std::vector<WorstStretch>& stretches, bool has_times) {
  Json rows = Json::array();
  for (const WorstStretch& stretch : stretches) {
    Json row;
    row["first_frame"] = stretch.first_frame;
    row["last_frame"] = stretch.last_frame;
    if (has_times) row["from_s"] = stretch.first_s, row["to_s"] = stretch.last_s;
    row["from_m"] = stretch.first_m;
    row["to_m"] = stretch.last_m;
    row["largest_m"] = stretch.largest;
    rows.push_back(row);
  }
  return rows;
}

/// Everything that is known of the errors beside the figures.
void add_errors(const EvaluationResult& r, Json& json) {
  for (const ErrorRow& row : error_rows(r)) json["errors"][row.key] = statistics_json(row.statistics);
  if (!r.outcome) return;
  json["vertical"] = r.components.outcome ? Json(r.components.vertical) : Json(nullptr);
  json["relative"] = relative_json(r.relative);
  json["by_speed"] = profile_rows(r.profile.by_speed, "m_per_s");
  json["by_turning_rate"] = profile_rows(r.profile.by_turning, "deg_per_s");
  json["by_distance"] = profile_rows(r.profile.by_distance, "m");
  json["worst"] = worst_json(r.profile.worst, r.has_times);
  json["worst_steps"] = worst_json(r.profile.worst_steps, r.has_times);
  if (r.profile.scale.outcome)
    json["scale_of_stretches"] = {r.profile.scale.smallest, r.profile.scale.largest};
}

Json object(const EvaluationResult& r) {
  Json json;
  json["name"] = r.name;
  json["outcome"] = r.outcome ? "ok" : r.outcome.reason;
  json["align"] = to_string(r.protocol.alignment);
  if (const std::string over = to_string(r.protocol.align_over); !over.empty())
    json["align_over"] = over;
  if (!r.protocol.part.empty()) json["part"] = r.protocol.part;
  if (r.outcome && !r.alignment.free_axes.empty()) {
    const Eigen::Vector3d& axis = r.alignment.free_axes.front();
    json["free_axis"] = {axis[0], axis[1], axis[2]};
  }
  json["scale"] = r.outcome ? Json(r.alignment.scale) : Json(nullptr);
  json["frames"] = r.frames;
  json["judged"] = r.judged;
  json["posed"] = r.posed;
  json["estimate_frames"] = r.estimate_frames;
  json["estimate_without_truth"] = r.estimate_without_truth;
  json["estimate_beside_nearer"] = r.estimate_beside_nearer;
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
  add_errors(r, json);
  if (!r.intervals.empty()) json["intervals"] = Json::parse(to_json(r.intervals));
  json["lost_frames"] = r.lost_frames;
  json["warnings"] = r.warnings;
  return json;
}

Json average_json(const AverageResult& mean) {
  Json json;
  json["sequences"] = mean.sequences;
  json["failed"] = mean.failed;
  json["averaging"] =
      "metrics: mean over sequences; pooled_*: mean over all segments of all "
      "sequences";
  for (const Metric& metric : mean.means) json[metric.key] = number(metric.value);
  if (mean.failed > 0)
    for (const Metric& metric : mean.means_of_rest)
      json["of_the_others"][metric.key] = number(metric.value);
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
  for (const char* key :
       {"ate_rmse_m", "ate_percent_of_path", "t_rel_percent", "r_rel_deg_per_100m", "rpe_trans_m",
        "rpe_rot_deg", "rpe_rot_median_deg", "are_rmse_deg"})
    for (const Metric& metric : all)
      if (metric.key == key) chosen.push_back(metric);
  for (const Metric& metric : all)  // of the steps and bounds that were asked for
    if (metric.name.find(" over ") != std::string::npos || metric.key.starts_with("below_"))
      chosen.push_back(metric);
  return chosen;
}

std::string protocol_line(const EvaluationResult& r) {
  return fmt::format(
      "align {}; association by {}; t_rel and r_rel over segments of {} m, start "
      "step {}, mean over all segments",
      to_string(r.protocol.alignment), to_string(r.protocol.association),
      fmt::join(r.protocol.lengths_m, ", "), r.protocol.step);
}

std::string average_row(const std::string& name, int sequences, std::size_t width,
                        const std::vector<Metric>& means) {
  std::string row = fmt::format("{:<{}} {:>13}", name, width, fmt::format("{} seq.", sequences));
  for (const Metric& metric : columns(means)) row += fmt::format(" {:>14}", cell(metric.value, "-"));
  return row + "\n";
}

/// The rows of averages; a sequence without figures is never left out in silence.
std::string average_text(const AverageResult& mean, std::size_t width) {
  const int all = mean.sequences + mean.failed;
  std::string text = average_row("mean over sequences", all, width, mean.means);
  if (mean.failed > 0)
    text += fmt::format("{:<{}} {} of {} sequences have no figures: no mean over all\n", "", width,
                        mean.failed, all) +
            average_row("mean of the others", mean.sequences, width, mean.means_of_rest);
  if (mean.failed == 0)
    text += fmt::format("{:<{}} {:>13} {:>14} {:>14} {:>14} {:>14}\n", "mean over all segments",
                        width, fmt::format("{} segm.", mean.segments), "", "",
                        cell(mean.pooled_t_rel.value, "-"), cell(mean.pooled_r_rel.value, "-"));
  return text;
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

/// Statistics of every kind of error, a row each.
std::string errors_text(const EvaluationResult& r) {
  std::string text = fmt::format("\n  {:<38} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}\n",
                                 "errors", "rmse", "mean", "median", "std", "95 %", "max", "count");
  for (const ErrorRow& row : error_rows(r)) {
    if (row.key.ends_with("full") || row.key.ends_with("length_m")) continue;
    const Statistics& s = row.statistics;
    text += fmt::format("  {:<38} {:>10.4f} {:>10.4f} {:>10.4f} {:>10.4f} {:>10.4f} {:>10.4f} {:>10}\n",
                        row.name + " [" + row.unit + "]", s.rmse, s.mean, s.median, s.std_dev,
                        s.p95, s.max, s.count);
  }
  if (r.profile.worst.empty()) return text;
  const WorstStretch& worst = r.profile.worst.front();
  return text + fmt::format("  largest position errors at frames {} to {}, {:.1f} to {:.1f} m along the path: {:.4f} m\n",
                            worst.first_frame, worst.last_frame, worst.first_m, worst.last_m,
                            worst.largest);
}

/// Figures that the table of errors has are not lines of their own.
bool has_own_line(const Metric& metric) {
  if (metric.key == "ate_rmse_m" || metric.key == "ate_percent_of_path" ||
      metric.key == "are_rmse_deg")
    return true;
  return metric.key != "coverage" && !metric.key.starts_with("ate_") &&
         !metric.key.starts_with("are_");
}

}  // namespace

std::string to_json(const EvaluationResult& result) { return json_text(object(result), 2); }

std::string to_json(const std::vector<EvaluationResult>& results, bool with_average,
                    const std::vector<EvaluationResult>& common, int missing) {
  Json json;
  json["results"] = Json::array();
  for (const EvaluationResult& result : results) json["results"].push_back(object(result));
  for (const EvaluationResult& result : common) json["common"].push_back(object(result));
  if (with_average) json["average"] = average_json(average(results, missing));
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
    for (const ErrorRow& row : error_rows(r))
      for (const auto& [what, value] : named_values(row.statistics))
        csv.row(r.name, "errors", row.key + "_" + what, value, row.unit, "", "", "", "", "");
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

static std::string metrics_text(const EvaluationResult& r) {
  std::string text;
  const std::vector<Metric> all = metrics(r);
  std::size_t width = 15;
  for (const Metric& m : all) width = std::max(width, has_own_line(m) ? m.name.size() : 0);
  for (const Metric& m : all)
    if (has_own_line(m))
      text += fmt::format("  {:<{}} {:>10} {:<9} {}\n", m.name, width, cell(m.value, "-"), m.unit,
                          m.protocol);
  return text;
}

std::string to_text(const EvaluationResult& r) {
  if (!r.outcome) return fmt::format("{}: no figures: {}\n", r.name, r.outcome.reason);
  std::string text =
      fmt::format("{}: {} of {} {}frames posed ({:.1f} %), path {:.1f} m\n", r.name, r.posed,
                  r.judged, r.judged < r.frames ? "judged " : "", 100 * r.coverage, r.path_m);
  if (r.judged < r.frames || r.estimate_without_truth > 0)
    text += fmt::format(
        "  {} frames in the ground truth, {} in the estimate, {} of them without "
        "ground truth, {} with one that a nearer pose uses\n",
        r.frames, r.estimate_frames, r.estimate_without_truth - r.estimate_beside_nearer,
        r.estimate_beside_nearer);
  text +=
      fmt::format("  align {}, scale {:.6f}, association by {}\n", to_string(r.protocol.alignment),
                  r.alignment.scale, to_string(r.protocol.association));
  if (r.offsets) text += to_text(*r.offsets);
  text += metrics_text(r);
  text += errors_text(r);
  if (!r.intervals.empty()) text += "\n  confidence\n" + to_text(r.intervals);
  if (r.segments.outcome) text += groups_text(r.segments);
  return text;
}

std::string to_table(const std::vector<EvaluationResult>& results, bool with_average,
                     int missing) {
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
  if (with_average) text += average_text(average(results, missing), width);
  return text + protocol_line(results.front()) + "\n";
}

}  // namespace placegraph
