#include <fmt/format.h>
#include <placegraph/eval/offsets/offset_estimation.h>
#include <placegraph/graph/core/angle.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

using OffsetJson = nlohmann::ordered_json;

/// "free" where the deviation is infinite.
std::string deviation_text(double deviation, const char* digits) {
  return std::isinf(deviation) ? "free" : fmt::format(fmt::runtime(digits), deviation);
}

std::string deviations_text(const Eigen::Vector3d& deviations, const char* digits) {
  return fmt::format("({} {} {})", deviation_text(deviations[0], digits),
                     deviation_text(deviations[1], digits), deviation_text(deviations[2], digits));
}

OffsetJson finite(double value) { return std::isfinite(value) ? OffsetJson(value) : nullptr; }

OffsetJson three(const Eigen::Vector3d& values) {
  return {finite(values[0]), finite(values[1]), finite(values[2])};
}

Eigen::Vector3d in_degrees(const Eigen::Vector3d& angles_rad) {
  return angles_rad / kRadPerDeg;
}

}  // namespace

std::string to_text(const OffsetEstimate& o) {
  if (!o.outcome) return "  no offsets: " + o.outcome.reason + "\n";
  std::string text;
  if (o.with_body) {
    const Eigen::Vector3d& arm = o.T_estimate_truth.translation();
    text += fmt::format("  lever arm      ({:.4f} {:.4f} {:.4f}) +- {} m\n", arm[0], arm[1], arm[2],
                        deviations_text(o.lever_arm_deviation_m, "{:.4f}"));
  }
  if (o.with_body && o.has_rotation) {
    const Eigen::Vector3d turn = in_degrees(o.T_estimate_truth.rotation().log());
    text += fmt::format("  body rotation  ({:.3f} {:.3f} {:.3f}) +- {} deg\n", turn[0], turn[1],
                        turn[2], deviations_text(in_degrees(o.rotation_deviation_rad), "{:.3f}"));
  }
  if (o.with_time)
    text += fmt::format("  time offset    {:.5f} +- {} s\n", o.time_s,
                        deviation_text(o.time_deviation_s, "{:.5f}"));
  text += fmt::format("  from {} motions of {:.3g} s, which scatter by {:.3g} m", o.motions,
                      o.motion_s, o.translation_rms_m);
  if (o.has_rotation) text += fmt::format(" and {:.3g} deg", rad_to_deg(o.rotation_rms_rad));
  text += "\n";
  for (const FreeOffset& free : o.free) text += "  " + free.text + "\n";
  return text;
}

std::string to_json(const OffsetEstimate& o) {
  OffsetJson json;
  json["outcome"] = o.outcome ? "ok" : o.outcome.reason;
  const bool body = o.outcome && o.with_body, rotation = body && o.has_rotation;
  const bool time = o.outcome && o.with_time;
  const Eigen::Quaterniond& q = o.T_estimate_truth.rotation().quaternion();
  json["lever_arm_m"] = body ? three(o.T_estimate_truth.translation()) : OffsetJson(nullptr);
  json["lever_arm_deviation_m"] = body ? three(o.lever_arm_deviation_m) : OffsetJson(nullptr);
  json["rotation_xyzw"] =
      rotation ? OffsetJson({q.x(), q.y(), q.z(), q.w()}) : OffsetJson(nullptr);
  json["rotation_deviation_deg"] =
      rotation ? three(in_degrees(o.rotation_deviation_rad)) : OffsetJson(nullptr);
  json["time_s"] = time ? OffsetJson(o.time_s) : OffsetJson(nullptr);
  json["time_deviation_s"] = time ? finite(o.time_deviation_s) : OffsetJson(nullptr);
  json["free"] = OffsetJson::array();
  for (const FreeOffset& free : o.free) json["free"].push_back(free.text);
  json["motions"] = o.motions;
  json["motion_s"] = o.motion_s;
  json["translation_rms_m"] = o.translation_rms_m;
  json["rotation_rms_deg"] = rad_to_deg(o.rotation_rms_rad);
  return json.dump();
}

}  // namespace placegraph
