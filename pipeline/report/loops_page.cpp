#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/report/loops_page.h>

#include <fmt/format.h>
#include <placegraph/eval/plots/precision_recall_plot.h>
#include <placegraph/eval/trajectory/evaluation_options.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include <placegraph/pipeline/report/loop_images.h>
#include <placegraph/pipeline/report/page.h>
#include <placegraph/pipeline/report/parts.h>
#include <placegraph/pipeline/report/tables/column.h>
#include <placegraph/pipeline/report/tables/page_thinning.h>

namespace placegraph {
namespace {

using namespace report;
using nlohmann::json;

/// Number of images: those with a pose, or up to the last one that is named.
std::int64_t images_of(const LoopsPage& page) {
  if (page.poses) return static_cast<std::int64_t>(page.poses->size());
  std::int64_t last = -1;
  if (!page.truth.queries.empty()) last = page.truth.queries.rbegin()->first.value();
  for (const LoopsPageSystem& system : page.systems)
    if (!system.benchmark.queries.empty())
      last = std::max(last, system.benchmark.queries.back().query.value());
  return last + 1;
}

json frames_of(const LoopsPage& page) {
  const std::int64_t images = images_of(page);
  const bool timed = page.poses && page.poses->has_times;
  std::vector<std::int32_t> id, component;
  std::vector<double> stamp_s;
  std::vector<std::optional<Eigen::Isometry3d>> poses;
  for (std::int64_t i = 0; i < images; ++i) {
    id.push_back(static_cast<std::int32_t>(i));
    poses.emplace_back();
    if (page.poses) poses.back() = page.poses->poses[static_cast<std::size_t>(i)].T_world_body;
    component.push_back(poses.back() ? 0 : -1);
    stamp_s.push_back(
        timed ? 1e-9 * static_cast<double>(page.poses->poses[static_cast<std::size_t>(i)].stamp_ns)
              : static_cast<double>(i) / SegmentOptions().frame_rate_hz);
  }
  json frames = bare_frames(id, stamp_s);
  frames["component"] = column(component);
  frames["pose"] = pose_column(poses);
  return frames;
}

json describe_loops(const std::vector<PageLoop>& loops, bool probabilities) {
  std::vector<std::int32_t> query, match, rank;
  std::vector<float> score;
  std::vector<std::string> verdict, reason;
  for (const PageLoop& loop : loops) {
    query.push_back(static_cast<std::int32_t>(loop.query.value()));
    match.push_back(static_cast<std::int32_t>(loop.match.value()));
    rank.push_back(loop.rank);
    score.push_back(static_cast<float>(loop.score));
    verdict.push_back(loop.verdict);
    reason.push_back(loop.reason);
  }
  const json scores = column(score);
  return {{"query_frame", column(query)},
          {"match_frame", column(match)},
          {"probability", probabilities ? scores : json()},
          {"similarity", probabilities ? json() : scores},
          {"inliers", nullptr},
          {"lines", nullptr},
          {"stage", text_column(verdict)},
          {"reason", text_column(reason)},
          {"rank", column(rank)},
          {"judged", true}};
}

json figures_of(const LoopBenchmark& benchmark, const std::string& protocol) {
  const PrecisionRecall& curve = benchmark.curve;
  json figures = json::array();
  const auto add = [&](const std::string& name, const std::optional<double>& value) {
    if (value)
      figures.push_back({{"name", name}, {"value", *value}, {"unit", ""}, {"protocol", protocol}});
  };
  add("average precision", curve.average_precision);
  add("recall at 100 % precision", curve.recall_at_full_precision);
  add("F1, largest", curve.f1_max);
  for (std::size_t i = 0; i < benchmark.recall_at.size(); ++i)
    add(fmt::format("recall at {}", LoopBenchmark::kRanks[i]), benchmark.recall_at[i]);
  add("queries with a true match", benchmark.positives);
  add("queries with a candidate", benchmark.predicted_queries);
  return figures;
}

json reliability_table(const LoopsPageSystem& system) {
  std::vector<std::vector<std::string>> rows;
  for (const ReliabilityBin& bin : system.reliability->bins)
    if (bin.predictions > 0)
      rows.push_back({fmt::format("{:.3f}", bin.mean_probability),
                      fmt::format("{:.3f}", bin.share_right), fmt::format("{}", bin.predictions)});
  return describe_table(
      "Reliability of the probabilities",
      fmt::format("of all {} candidates; calibration error {:.3f}",
                  system.benchmark.candidates.size(), system.reliability->calibration_error),
      {"Mean probability", "Share right", "Candidates"}, rows);
}

json notes_of(const LoopBenchmark& benchmark) {
  json notes = json::array();
  if (benchmark.positives == 0) notes.push_back("no query has a true match; recall is not defined");
  if (benchmark.unjudged > 0)
    notes.push_back(fmt::format("{} predictions for images without ground truth are not judged",
                                benchmark.unjudged));
  if (benchmark.dropped > 0)
    notes.push_back(
        fmt::format("{} predictions whose candidate is too young or out of range are "
                    "left out",
                    benchmark.dropped));
  return notes;
}

json run_of(const LoopsPage& page, const LoopsPageSystem& system, const json& frames,
            const LogSink& log) {
  const std::vector<PageLoop> loops = page_loops(system.benchmark, page.truth);
  json run = bare_run(system.name, frames);
  run["folder"] = system.file;
  run["recording"] = page.protocol;
  run["loops"] = describe_loops(loops, system.reliability.has_value());
  run["keyframes"] =
      describe_loop_images(loops, system.file, page.poses_file, images_of(page), log);
  run["figures"] = figures_of(system.benchmark, page.protocol);
  run["notes"] = notes_of(system.benchmark);
  if (system.reliability) run["tables"].push_back(reliability_table(system));
  run["summary"]["frames"] = images_of(page);
  run["summary"]["posed"] = page.poses ? page.poses->posed() : 0;
  if (!page.poses || page.poses->posed() == 0) return run;
  std::vector<std::optional<Eigen::Vector3d>> positions_m;
  for (const StampedPose& pose : page.poses->poses) {
    positions_m.emplace_back();
    if (pose.T_world_body) positions_m.back() = pose.T_world_body->translation();
  }
  run["aligned"] = "none";
  run["up"] = up_axis(positions_m);
  run["components"].push_back({{"number", 0},
                               {"main", true},
                               {"first", 0},
                               {"last", images_of(page) - 1},
                               {"posed", page.poses->posed()}});
  return run;
}

}  // namespace

std::string precision_recall_picture(const std::string& protocol,
                                     const std::vector<NamedPrecisionRecall>& systems) {
  PrecisionRecallPlot plot;
  plot.protocol = protocol;
  for (const NamedPrecisionRecall& system : systems)
    plot.curves.push_back({system.name, system.curve});
  return to_svg(plot);
}

void write_loops_page(const std::string& file, const LoopsPage& page, const std::string& program,
                      const LogSink& log) {
  const json frames = frames_of(page);
  std::vector<NamedPrecisionRecall> curves;
  std::string names;
  json runs = json::array();
  for (const LoopsPageSystem& system : page.systems) {
    runs.push_back(run_of(page, system, frames, log));
    curves.push_back({system.name, system.benchmark.curve});
    names += (names.empty() ? "" : ", ") + system.name;
  }
  json report = bare_report(program, "Loops of " + names);
  report["runs"] = std::move(runs);
  report["pictures"].push_back(describe_picture("Precision and recall", page.protocol,
                                                precision_recall_picture(page.protocol, curves)));
  thin_report(report);
  write_file(file, page_with(report));
}

}  // namespace placegraph
