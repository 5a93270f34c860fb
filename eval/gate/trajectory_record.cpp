#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/gate/trajectory_record.h>
#include <placegraph/eval/association/pairing.h>
#include <placegraph/eval/trajectory/figure_intervals.h>
#include <placegraph/eval/uncertainty/run_interval.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace placegraph {
namespace {

/// FNV-1a (Fowler, Noll and Vo) over 64 bits, on the bytes of numbers from the lowest on.
class PoseHash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      hash_ ^= (word >> (8 * byte)) & 0xff;
      hash_ *= 0x100000001b3ULL;
    }
  }
  /// Zero has one sign.
  void add(double number) { add(std::bit_cast<std::uint64_t>(std::nearbyint(number * 1e9) + 0.0)); }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

std::map<std::string, std::string> options_of(const Protocol& protocol) {
  std::map<std::string, std::string> options = {
      {"align", to_string(protocol.alignment)},
      {"associate", to_string(protocol.association)},
      {"lengths_m", fmt::format("{}", fmt::join(protocol.lengths_m, ","))},
      {"step", std::to_string(protocol.step)}};
  if (const std::string over = to_string(protocol.align_over); !over.empty())
    options["align_over"] = over;
  if (!protocol.part.empty()) options["part"] = protocol.part;
  if (!protocol.vertical.empty()) options["vertical"] = protocol.vertical;
  if (protocol.pairs == StepPairs::kAll) options["pairs"] = "all";
  if (!protocol.filters.empty()) options["apply"] = protocol.filters;
  if (!protocol.truth_filters.empty()) options["apply_truth"] = protocol.truth_filters;
  if (!protocol.offsets.empty()) options["estimate"] = protocol.offsets;
  if (protocol.association == Association::kTime) {
    options["max_difference_s"] = fmt::format("{}", protocol.max_difference_s);
    // A time that is estimated is one of each run.
    if (protocol.offsets.find("time") == std::string::npos)
      options["offset_s"] = fmt::format("{}", protocol.offset_s);
  }
  return options;
}

Better better_of(const std::string& key) {
  if (is_share_of_drive(key)) return Better::kLarger;
  return key.starts_with("scale_drift") ? Better::kNearerZero : Better::kSmaller;
}

/// Fewer judged frames make a coverage that is no worse.
void add_judged_frames(const std::vector<EvaluationResult>& runs, SequenceRecord& sequence) {
  FigureRecord& figure = sequence.figures.emplace_back();
  figure.key = "judged_frames";
  figure.better = Better::kLarger;
  for (const EvaluationResult& run : runs)
    figure.values.push_back(run.outcome ? std::optional<double>(run.judged) : std::nullopt);
}

/// Of one run the intervals that its errors along the drive allow, of several those of the runs.
void fill_intervals(const std::vector<EvaluationResult>& runs, SequenceRecord& sequence) {
  std::vector<FigureInterval> of_drive;
  if (runs.size() == 1) of_drive = intervals_of_drive(runs.front());
  for (FigureRecord& figure : sequence.figures) {
    const std::vector<double> values = figure.present();
    if (values.empty() || values.front() < 0) continue;
    if (runs.size() > 1) {
      figure.interval = interval_of_runs(values);
      continue;
    }
    const auto found = std::ranges::find(of_drive, figure.key, &FigureInterval::key);
    if (found != of_drive.end())
      figure.interval = found->interval;
    else
      figure.interval.outcome = Outcome::failure(Outcome::Code::kTooFewData, "one run");
  }
}

/// What the noise of the truth adds to the figures of any run.
void fill_noise_floors(const Trajectory& truth, const EvaluationResult& run,
                       SequenceRecord& sequence) {
  const std::map<std::string, double> floors = noise_floors(run, estimate_truth_noise(truth));
  for (FigureRecord& figure : sequence.figures)
    if (const auto found = floors.find(figure.key); found != floors.end())
      figure.noise_floor = found->second;
}

}  // namespace

std::string truth_fingerprint(const Trajectory& truth) {
  PoseHash hash;
  for (const StampedPose& pose : truth.poses) {
    hash.add(static_cast<std::uint64_t>(pose.T_world_body.has_value()));
    if (!pose.T_world_body) continue;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) hash.add((*pose.T_world_body)(row, column));
  }
  return fmt::format("{:016x}", hash.value());
}

SequenceRecord record_of(const std::string& name, const Trajectory& truth,
                           const std::vector<EvaluationResult>& runs) {
  require(!runs.empty(), name + ": no run is given");
  SequenceRecord sequence;
  sequence.name = name;
  sequence.truth = {truth_fingerprint(truth), static_cast<int>(truth.posed()),
                    truth.path_length()};
  // A run that was refused has no association of its own.
  const auto ok = std::ranges::find_if(runs, [](const EvaluationResult& r) { return !!r.outcome; });
  if (ok != runs.end()) sequence.options = options_of(ok->protocol);
  for (const Metric& metric : metrics(runs.front())) {
    FigureRecord& figure = sequence.figures.emplace_back();
    figure.key = metric.key;
    figure.unit = metric.unit;
    figure.better = better_of(metric.key);
  }
  for (const EvaluationResult& run : runs) {
    if (!run.outcome)
      sequence.failures.push_back(run.name + ": " + run.outcome.reason);
    else
      require(options_of(run.protocol) == sequence.options,
              name + ": " + run.name + " was judged with other options than the runs before");
    const std::vector<Metric> own = metrics(run);
    for (FigureRecord& figure : sequence.figures) {
      const auto found = std::ranges::find(own, figure.key, &Metric::key);
      figure.values.push_back(found == own.end() ? std::nullopt : found->value);
    }
  }
  add_judged_frames(runs, sequence);
  fill_intervals(runs, sequence);
  if (ok != runs.end()) fill_noise_floors(truth, *ok, sequence);
  return sequence;
}

}  // namespace placegraph
