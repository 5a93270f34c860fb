#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/results/evo_archives.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>

namespace placegraph {
namespace {

/// How evo 1.38.1 says in a title what was aligned.
std::string evo_alignment_text(Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return "(not aligned)";
    case Alignment::kOrigin:
      return "(with origin alignment)";
    case Alignment::kSe3:
      return "(with SE(3) Umeyama alignment)";
    case Alignment::kSim3:
      return "(with Sim(3) Umeyama alignment)";
    default:
      return fmt::format("(with {} alignment)", to_string(alignment));
  }
}

/// A line of a TUM file, or of a KITTI file without times.
std::string pose_line(const FramePair& pair, const Eigen::Isometry3d& T, bool timed) {
  if (!timed) {
    std::string line;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        line += fmt::format("{}{}", line.empty() ? "" : " ", T(row, column));
    return line + "\n";
  }
  const Eigen::Quaterniond q(T.linear());
  const auto seconds = pair.stamp_ns / 1'000'000'000, rest = pair.stamp_ns % 1'000'000'000;
  return fmt::format("{}.{:09} {} {} {} {} {} {} {}\n", seconds, rest, T.translation().x(),
                     T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w());
}

EvoArray evo_list(std::vector<double> values) {
  const std::size_t count = values.size();
  return {count, 1, std::move(values)};
}

/// Path lengths up to each position.
std::vector<double> distances_of(const std::vector<Eigen::Vector3d>& positions_m) {
  std::vector<double> distances_m;
  for (std::size_t i = 0; i < positions_m.size(); ++i)
    distances_m.push_back(
        i == 0 ? 0 : distances_m.back() + (positions_m[i] - positions_m[i - 1]).norm());
  return distances_m;
}

std::vector<std::pair<std::string, double>> evo_statistics(const ApeResult& ape) {
  const std::vector<double>& errors = ape.frame_errors_m;
  const double mean = ape.error_m.mean;
  double squares = 0, deviations = 0;
  for (const double error : errors) {
    squares += error * error;
    deviations += (error - mean) * (error - mean);
  }
  return {{"rmse", ape.error_m.rmse},
          {"mean", mean},
          {"median", ape.error_m.median},
          {"std", std::sqrt(deviations / static_cast<double>(errors.size()))},
          {"min", *std::ranges::min_element(errors)},
          {"max", ape.error_m.max},
          {"sse", squares}};
}

void add_trajectories(const EvaluationResult& result, EvoResult& evo) {
  std::vector<Eigen::Vector3d> truth_m, estimate_m;
  std::vector<double> times_s, since_begin_s;
  std::string truth, estimate;
  for (const FramePair& pair : result.aligned_pairs) {
    if (!pair.T_world_estimate) continue;
    truth_m.push_back(pair.T_world_truth.translation());
    estimate_m.push_back(pair.T_world_estimate->translation());
    truth += pose_line(pair, pair.T_world_truth, result.has_times);
    estimate += pose_line(pair, *pair.T_world_estimate, result.has_times);
    times_s.push_back(1e-9 * static_cast<double>(pair.stamp_ns));
    since_begin_s.push_back(times_s.back() - times_s.front());
  }
  const char* ending = result.has_times ? ".tum" : ".kitti";
  evo.trajectories[evo.reference + ending] = std::move(truth);
  evo.trajectories[evo.estimate + ending] = std::move(estimate);
  if (!result.has_times) return;
  evo.arrays["seconds_from_start"] = evo_list(std::move(since_begin_s));
  evo.arrays["timestamps"] = evo_list(std::move(times_s));
  evo.arrays["distances_from_start"] = evo_list(distances_of(truth_m));
  evo.arrays["distances"] = evo_list(distances_of(estimate_m));
}

/// "APE (m)" without its unit, and the unit.
std::pair<std::string, std::string> label_parts(const std::string& label) {
  const std::size_t bracket = label.rfind(" (");
  if (bracket == std::string::npos || !label.ends_with(')')) return {label, ""};
  return {label.substr(0, bracket), label.substr(bracket + 2, label.size() - bracket - 3)};
}

/// Small letters and digits, and one underscore for what stands between them.
std::string evo_key(const std::string& text) {
  std::string key;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!key.empty() && key.back() != '_')
      key += '_';
  }
  while (key.ends_with('_')) key.pop_back();
  return key;
}

}  // namespace

EvoResult evo_result_of(const EvaluationResult& result, const std::string& reference) {
  if (!result.outcome || !result.ape.outcome)
    throw NoResult(result.name + ": " +
                   (result.outcome ? result.ape.outcome.reason : result.outcome.reason));
  EvoResult evo;
  evo.title = "APE w.r.t. translation part (m)\n" + evo_alignment_text(result.protocol.alignment);
  evo.label = "APE (m)";
  evo.reference = reference;
  evo.estimate = result.name == reference ? result.name + " (estimate)" : result.name;
  evo.statistics = evo_statistics(result.ape);
  evo.arrays["error_array"] = evo_list(result.ape.frame_errors_m);
  if (result.protocol.alignment != Alignment::kNone) {
    Eigen::Matrix<double, 4, 4, Eigen::RowMajor> S = Eigen::Matrix4d::Identity();
    S.topLeftCorner<3, 3>() = result.alignment.scale * result.alignment.R_truth_estimate;
    S.topRightCorner<3, 1>() = result.alignment.t_truth_estimate;
    evo.arrays["alignment_transformation_sim3"] = {4, 4, {S.data(), S.data() + S.size()}};
  }
  add_trajectories(result, evo);
  return evo;
}

SequenceFigures figures_of_evo(const EvoResult& result, const std::string& name) {
  SequenceFigures figures;
  figures.name = name;
  std::string protocol = result.title;
  std::ranges::replace(protocol, '\n', ' ');
  const auto [figure, unit] = label_parts(result.label.empty() ? "error" : result.label);
  for (const auto& [statistic, value] : result.statistics)
    figures.figures.push_back({evo_key(result.label + "_" + statistic), figure + " " + statistic,
                               unit == "unit-less" ? "" : unit, value, protocol});
  return figures;
}

}  // namespace placegraph
