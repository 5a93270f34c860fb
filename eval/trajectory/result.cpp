#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/trajectory/result.h>

namespace placegraph {
namespace {

std::string alignment_text(const EvaluationResult& r) {
  std::string text = "align " + to_string(r.protocol.alignment);
  if (r.protocol.alignment == Alignment::kSim3 || r.protocol.alignment == Alignment::kScale)
    text += fmt::format(" (scale {:.6f})", r.alignment.scale);
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

}  // namespace

std::vector<Metric> metrics(const EvaluationResult& r) {
  const bool ok{r.outcome};
  const bool has_ape = ok && r.ape.outcome;
  const bool has_rpe = ok && r.rpe.outcome;
  const bool has_segments = ok && r.segments.outcome;
  const std::string ate = fmt::format("positions, {} frames, {}", r.posed, alignment_text(r));
  const std::string rpe_text = "consecutive frames, " + scale_text(r);
  return {
      {"ate_rmse_m", "ATE RMSE", "m", when(has_ape, r.ape.error_m.rmse), ate},
      {"ate_percent_of_path", "ATE/path", "%",
       when(has_ape && r.posed_path_m > 0, 100 * r.ape.error_m.rmse / r.posed_path_m),
       fmt::format("ATE RMSE over the true path of {:.1f} m, {}", r.posed_path_m,
                   alignment_text(r))},
      {"ate_mean_m", "ATE mean", "m", when(has_ape, r.ape.error_m.mean), ate},
      {"ate_median_m", "ATE median", "m", when(has_ape, r.ape.error_m.median), ate},
      {"ate_max_m", "ATE max", "m", when(has_ape, r.ape.error_m.max), ate},
      {"t_rel_percent", "t_rel", "%", when(has_segments, r.segments.t_rel_percent),
       segments_text(r)},
      {"r_rel_deg_per_100m", "r_rel", "deg/100m", when(has_segments, r.segments.r_rel_deg_per_100m),
       segments_text(r)},
      {"rpe_trans_m", "RPE trans", "m", when(has_rpe, r.rpe.translation_m.rmse),
       "RMSE, " + rpe_text},
      {"rpe_rot_deg", "RPE rot", "deg", when(has_rpe, r.rpe.rotation_deg.rmse),
       "RMSE, " + rpe_text},
      {"rpe_rot_median_deg", "RPE rot median", "deg", when(has_rpe, r.rpe.rotation_deg.median),
       "median, " + rpe_text},
      {"coverage", "coverage", "", when(ok, r.coverage), "posed frames over judged frames"},
  };
}

AverageResult average(const std::vector<EvaluationResult>& results) {
  AverageResult mean;
  std::vector<int> counts;
  double t = 0, r = 0;
  for (const EvaluationResult& result : results) {
    if (!result.outcome) continue;
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
  const std::string pooled =
      fmt::format("mean over the {} segments of {} sequences", mean.segments, mean.sequences);
  const bool any = mean.segments > 0;
  mean.pooled_t_rel = {"pooled_t_rel_percent", "t_rel", "%", when(any, t / mean.segments), pooled};
  mean.pooled_r_rel = {"pooled_r_rel_deg_per_100m", "r_rel", "deg/100m",
                       when(any, r / mean.segments), pooled};
  return mean;
}

}  // namespace placegraph
