#include "apps/eval/eval_noise.h"

#include <fmt/format.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/support/numbers_json.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

constexpr double kMostPosition_m = 1000, kMostRotation_deg = 180;

/// A standard deviation; nothing if the text is none, or a larger one.
std::optional<double> deviation_of(std::string_view text, double most) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value >= 0 && value <= most ? std::optional(value) : std::nullopt;
}

std::string direction_text(const DirectionNoise& noise) {
  return fmt::format("lateral {:.2f} deg, vertical {:.2f} deg over {} frame{}",
                     rad_to_deg(noise.lateral_rad), rad_to_deg(noise.vertical_rad), noise.frames,
                     noise.frames == 1 ? "" : "s");
}

}  // namespace

Trajectory read_true_poses(const std::string& path) {
  const std::filesystem::path file(path);
  return warned(read_trajectory(
      (std::filesystem::is_directory(file) ? file / "poses.txt" : file).string()));
}

TruthNoise truth_noise_of(const std::string& text, const Trajectory& truth) {
  if (text == "none") return {};
  if (text == "estimate") {
    TruthNoise noise = estimate_truth_noise(truth);
    if (!noise.outcome) throw NoResult("--truth-noise estimate: " + noise.outcome.reason);
    return noise;
  }
  const std::size_t comma = text.find(',');
  if (comma != std::string::npos) {
    const auto position_m = deviation_of(std::string_view(text).substr(0, comma), kMostPosition_m),
               rotation_deg =
                   deviation_of(std::string_view(text).substr(comma + 1), kMostRotation_deg);
    if (position_m && rotation_deg) {
      TruthNoise noise = TruthNoise::white(*position_m, deg_to_rad(*rotation_deg));
      noise.interpolated = estimate_truth_noise(truth).interpolated;
      return noise;
    }
  }
  throw ArgumentError(
      "--truth-noise: '" + text +
      "' is none of none, estimate, POSITION_M,ROTATION_DEG (numbers from 0 to 1000 and 180)");
}

EvalNoiseResult eval_noise(const std::string& path) {
  const Trajectory truth = read_true_poses(path);
  EvalNoiseResult result{static_cast<int>(truth.size()), static_cast<int>(truth.posed()),
                         estimate_truth_noise(truth)};
  if (!result.noise.outcome) throw NoResult(path + ": " + result.noise.outcome.reason);
  return result;
}

std::string to_text(const EvalNoiseResult& result) {
  const TruthNoise& noise = result.noise;
  const Eigen::Vector3d t = 1e3 * noise.sigma.head<3>();
  const Eigen::Vector3d r = noise.sigma.tail<3>().unaryExpr(&rad_to_deg);
  std::string text =
      fmt::format("frames              {}, {} with a pose\n", result.frames, result.posed);
  text +=
      fmt::format("noise of a pose     {:.2f} {:.2f} {:.2f} mm along x y z\n", t.x(), t.y(), t.z());
  text += fmt::format("                    {:.4f} {:.4f} {:.4f} deg about x y z\n", r.x(), r.y(),
                      r.z());
  text += "direction of motion ";
  if (noise.direction.empty()) {
    text += "not that of a wheeled vehicle\n";
  } else {
    text += direction_text(noise.direction.front()) + "\n";
    if (noise.direction.size() > 1)
      text += "                    " + direction_text(noise.direction.back()) + "\n";
  }
  std::string stretches;
  for (const FrameStretch& stretch : noise.interpolated)
    stretches +=
        fmt::format("{}{} to {}", stretches.empty() ? "" : ", ", stretch.first, stretch.last);
  text += "interpolated        " + (stretches.empty() ? "nothing" : "frames " + stretches) + "\n";
  return text;
}

std::string to_json(const EvalNoiseResult& result) {
  const TruthNoise& noise = result.noise;
  json report = {{"frames", result.frames},
                 {"posed", result.posed},
                 {"position_m", numbers(noise.sigma.head<3>())},
                 {"rotation_deg", numbers(noise.sigma.tail<3>().unaryExpr(&rad_to_deg))},
                 {"direction", json::array()},
                 {"interpolated", json::array()}};
  for (const DirectionNoise& d : noise.direction)
    report["direction"].push_back({{"frames", d.frames},
                                   {"lateral_deg", rad_to_deg(d.lateral_rad)},
                                   {"vertical_deg", rad_to_deg(d.vertical_rad)}});
  for (const FrameStretch& stretch : noise.interpolated)
    report["interpolated"].push_back({stretch.first, stretch.last});
  return json_text(report, 1);
}

}  // namespace placegraph::apps
