#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/trajectory/result.h>

namespace placegraph {
namespace {

std::string alignment_text(const EvaluationResult& r) {
  std::string text = "align " + to_string(r.protocol.alignment);
  if (r.protocol.alignment == Alignment::kSim3 || r.protocol.alignment == Alignment::kScale)
    text += fmt::format(" (scale {:.6f})", r.alignment.scale);
  if (r.protocol.alignment == Alignment::kYaw) text += " about " + r.protocol.vertical;
  if (const std::string over = to_string(r.protocol.align_over); !over.empty())
    text += " over " + over;
  return text;
}

// Relative figures do not change with a rigid alignment; a fitted scale is applied before them.
std::string scale_text(const EvaluationResult& r) {
  return r.alignment.scale != 1 ? fmt::format("estimate scaled by {:.6f}", r.alignment.scale)
                                : "estimate unscaled";
}

std::string segments_text(const EvaluationResult& r) {
  return fmt::format("KITTI devkit, lengths {} m, step {}, mean over {} segments, {}",
                     fmt::join(r.protocol.lengths_m, ","), r.protocol.step,
                     r.segments.segments.size(), scale_text(r));
}

std::optional<double> when(bool has, double value) {
  return has ? std::optional<double>(value) : std::nullopt;
}

const char* pairs_text(StepPairs pairs) {
  return pairs == StepPairs::kAll ? "overlapping" : "consecutive";
}

std::vector<Metric> absolute_metrics(const EvaluationResult& r) {
  const bool has = r.outcome && r.ape.outcome, turns = has && r.ape.rotation_outcome;
  const std::string part = r.protocol.part.empty() ? "" : " " + r.protocol.part;
  const std::string ate =
      fmt::format("positions{}, {} frames, {}", part, r.posed, alignment_text(r));
  const std::string are = fmt::format("rotations, {} frames, {}", r.posed, alignment_text(r));
  const Statistics &e = r.ape.error_m, &a = r.ape.rotation_deg;
  return {
      {"ate_rmse_m", "ATE RMSE", "m", when(has, e.rmse), ate},
      {"ate_percent_of_path", "ATE/path", "%",
       when(has && r.posed_path_m > 0, 100 * e.rmse / r.posed_path_m),
       fmt::format("ATE RMSE over the true path of {:.1f} m, {}", r.posed_path_m,
                   alignment_text(r))},
      {"ate_mean_m", "ATE mean", "m", when(has, e.mean), ate},
      {"ate_median_m", "ATE median", "m", when(has, e.median), ate},
      {"ate_std_m", "ATE std", "m", when(has, e.std_dev), ate},
      {"ate_min_m", "ATE min", "m", when(has, e.min), ate},
      {"ate_max_m", "ATE max", "m", when(has, e.max), ate},
      {"ate_sse_m2", "ATE sse", "m^2", when(has, e.sse), ate},
      {"ate_p95_m", "ATE 95 %", "m", when(has, e.p95), ate},
      {"are_rmse_deg", "ARE RMSE", "deg", when(turns, a.rmse), are},
      {"are_mean_deg", "ARE mean", "deg", when(turns, a.mean), are},
      {"are_median_deg", "ARE median", "deg", when(turns, a.median), are},
      {"are_std_deg", "ARE std", "deg", when(turns, a.std_dev), are},
      {"are_min_deg", "ARE min", "deg", when(turns, a.min), are},
      {"are_max_deg", "ARE max", "deg", when(turns, a.max), are},
      {"are_sse_deg2", "ARE sse", "deg^2", when(turns, a.sse), are},
  };
}

std::vector<Metric> relative_metrics(const EvaluationResult& r) {
  const bool has_rpe = r.outcome && r.rpe.outcome;
  const std::string rpe_text = "consecutive frames, " + scale_text(r);
  std::vector<Metric> all = {
      {"rpe_trans_m", "RPE trans", "m", when(has_rpe, r.rpe.translation_m.rmse),
       "RMSE, " + rpe_text},
      {"rpe_rot_deg", "RPE rot", "deg", when(has_rpe, r.rpe.rotation_deg.rmse),
       "RMSE, " + rpe_text},
      {"rpe_rot_median_deg", "RPE rot median", "deg", when(has_rpe, r.rpe.rotation_deg.median),
       "median, " + rpe_text},
      {"rpe_heading_deg", "RPE heading", "deg",
       when(has_rpe && r.rpe.has_vertical, r.rpe.heading_deg.rmse), "RMSE, " + rpe_text},
      {"rpe_inclination_deg", "RPE inclination", "deg",
       when(has_rpe && r.rpe.has_vertical, r.rpe.inclination_deg.rmse), "RMSE, " + rpe_text},
  };
  for (const RelativeErrors& steps : r.relative) {
    const bool has = r.outcome && steps.outcome;
    const std::string key = "rpe_" + to_string(steps.delta), over = " over " + to_string(steps.delta);
    const std::string text = fmt::format("RMSE, {} {} steps, {}", steps.errors.size(),
                                         pairs_text(steps.pairs), scale_text(r));
    all.push_back({key + "_trans_m", "RPE trans" + over, "m",
                   when(has, steps.translation_m.rmse), text});
    all.push_back({key + "_rot_deg", "RPE rot" + over, "deg",
                   when(has, steps.rotation_deg.rmse), text});
    all.push_back({key + "_heading_deg", "RPE heading" + over, "deg",
                   when(has && steps.has_vertical, steps.heading_deg.rmse), text});
    all.push_back({key + "_inclination_deg", "RPE inclination" + over, "deg",
                   when(has && steps.has_vertical, steps.inclination_deg.rmse), text});
  }
  return all;
}

}  // namespace

std::vector<Metric> metrics(const EvaluationResult& r) {
  const bool ok{r.outcome};
  const bool has_segments = ok && r.segments.outcome;
  std::vector<Metric> all = absolute_metrics(r);
  all.push_back({"t_rel_percent", "t_rel", "%", when(has_segments, r.segments.t_rel_percent),
                 segments_text(r)});
  all.push_back({"r_rel_deg_per_100m", "r_rel", "deg/100m",
                 when(has_segments, r.segments.r_rel_deg_per_100m), segments_text(r)});
  for (Metric& metric : relative_metrics(r)) all.push_back(std::move(metric));
  all.push_back({"scale_drift_percent_per_100m", "scale drift", "%/100m",
                 when(ok && r.profile.scale.outcome, r.profile.scale.percent_per_100m),
                 "slope of the scale over the path, twenty stretches"});
  for (const ShareBelow& share : r.below) {
    const std::string bound = to_string(share.bound);
    const auto add = [&](const char* of, const char* protocol, std::optional<double> value) {
      all.push_back({"below_" + bound + "_" + of, of + (" below " + bound), "", value,
                     protocol + (", " + alignment_text(r))});
    };
    const bool has = ok && share.outcome;
    add("frames", "share of the judged frames", when(has, share.frames));
    add("path", "share of the true path", when(has && r.path_m > 0, share.path));
  }
  all.push_back({"coverage", "coverage", "", when(ok, r.coverage),
                 "posed frames over judged frames"});
  return all;
}

bool is_share_of_drive(const std::string& key) {
  return key == "coverage" || key.starts_with("below_");
}

std::vector<ErrorRow> error_rows(const EvaluationResult& r) {
  std::vector<ErrorRow> rows;
  if (!r.outcome) return rows;
  if (r.ape.outcome) rows.push_back({"position_m", "position", "m", r.ape.error_m});
  if (r.ape.rotation_outcome) {
    rows.push_back({"rotation_deg", "rotation", "deg", r.ape.rotation_deg});
    rows.push_back({"full", "whole pose", "", r.ape.full});
  }
  if (r.components.outcome) {
    const ErrorComponents& c = r.components;
    rows.push_back({"along_m", "along the path", "m", c.along_m, true});
    rows.push_back({"across_m", "across the path", "m", c.across_m, true});
    rows.push_back({"up_m", "along the vertical " + c.vertical, "m", c.up_m, true});
  }
  const auto add = [&](const RelativeErrors& steps, const std::string& key,
                       const std::string& name) {
    if (!steps.outcome) return;
    rows.push_back({key + "_trans_m", name + ", translation", "m", steps.translation_m});
    rows.push_back({key + "_rot_deg", name + ", rotation", "deg", steps.rotation_deg});
    if (steps.has_vertical) {
      rows.push_back({key + "_heading_deg", name + ", heading", "deg", steps.heading_deg});
      rows.push_back(
          {key + "_inclination_deg", name + ", inclination", "deg", steps.inclination_deg});
    }
    rows.push_back({key + "_full", name + ", whole motion", "", steps.full});
    rows.push_back({key + "_length_m", name + ", length", "m", steps.length_m});
  };
  add(r.rpe, "rpe", "RPE");
  for (const RelativeErrors& steps : r.relative)
    add(steps, "rpe_" + to_string(steps.delta), "RPE over " + text_of(steps.delta));
  return rows;
}

AverageResult average(const std::vector<EvaluationResult>& results, int missing) {
  AverageResult mean;
  mean.failed = missing;
  std::vector<int> counts;
  double t = 0, r = 0;
  for (const EvaluationResult& result : results) {
    if (!result.outcome) {
      ++mean.failed;
      continue;
    }
    ++mean.sequences;
    const std::vector<Metric> own = metrics(result);
    if (mean.means.empty()) {
      mean.means = own;
      for (Metric& metric : mean.means) metric.value.reset();
      counts.assign(own.size(), 0);
    }
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (!own[i].value) continue;
      mean.means[i].value = mean.means[i].value.value_or(0.0) + *own[i].value;
      ++counts[i];
    }
    for (const SegmentError& segment : result.segments.segments) {
      t += segment.t_percent;
      r += segment.r_deg_per_100m;
      ++mean.segments;
    }
  }
  for (std::size_t i = 0; i < mean.means.size(); ++i) {
    if (mean.means[i].value) *mean.means[i].value /= counts[i];
    mean.means[i].protocol = fmt::format("mean over {} sequences", counts[i]);
  }
  mean.means_of_rest = mean.means;
  if (mean.failed > 0)
    for (Metric& metric : mean.means) {
      metric.value.reset();
      metric.protocol = fmt::format("no mean: {} of {} sequences have no figures", mean.failed,
                                    mean.failed + mean.sequences);
    }
  const std::string pooled =
      fmt::format("mean over the {} segments of {} sequences", mean.segments, mean.sequences);
  const bool any = mean.segments > 0 && mean.failed == 0;
  mean.pooled_t_rel = {"pooled_t_rel_percent", "t_rel", "%", when(any, t / mean.segments), pooled};
  mean.pooled_r_rel = {"pooled_r_rel_deg_per_100m", "r_rel", "deg/100m",
                       when(any, r / mean.segments), pooled};
  return mean;
}

}  // namespace placegraph
