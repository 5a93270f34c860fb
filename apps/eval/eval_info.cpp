#include "apps/eval/eval_info.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/datasets/distinct_paths.h>
#include <placegraph/io/datasets/evaluated_files.h>
#include <placegraph/io/trajectories/trajectory_filter.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>

#include "apps/support/numbers_json.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kListed = 5;                     // spans that a text names
constexpr std::int64_t kSince1970_ns = 946684800LL * 1000000000;  // 2000-01-01: later is a date

double in_seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

/// A stamp for people: seconds since the first one, or the number of the frame.
std::string at_text(const TrajectoryInfo& info, std::int64_t stamp_ns) {
  return info.has_times ? fmt::format("{:.3f} s", in_seconds(stamp_ns - info.first_ns))
                        : fmt::format("frame {}", stamp_ns);
}

std::string length_text(const TrajectoryInfo& info, std::int64_t length_ns) {
  return info.has_times ? fmt::format("{:.3f} s", in_seconds(length_ns))
                        : fmt::format("{} frames", length_ns);
}

/// "2: first, second", with at most five of them named; "none".
template <class Item, class Text>
std::string list_text(const std::vector<Item>& items, const Text& text) {
  if (items.empty()) return "none";
  std::string list = fmt::format("{}: ", items.size());
  for (std::size_t i = 0; i < std::min(items.size(), kListed); ++i)
    list += (i == 0 ? "" : "; ") + text(items[i]);
  if (items.size() > kListed) list += fmt::format("; and {} more", items.size() - kListed);
  return list;
}

std::string time_text(const TrajectoryInfo& info) {
  if (!info.has_times) return fmt::format("none: frames {} to {}", info.first_ns, info.last_ns);
  std::string text = fmt::format("{:.3f} s, from {:.9f} to {:.9f} s",
                                 in_seconds(info.last_ns - info.first_ns),
                                 in_seconds(info.first_ns), in_seconds(info.last_ns));
  if (info.first_ns >= kSince1970_ns)
    text += fmt::format(" ({:%Y-%m-%d %H:%M:%S} UTC)",
                        fmt::gmtime(static_cast<std::time_t>(info.first_ns / 1000000000)));
  return text;
}

std::string rate_text(const TrajectoryInfo& info) {
  const Spread& spacing = info.spacing_s;
  if (spacing.count == 0) return "not evident: fewer than two poses";
  const char* unit = info.has_times ? "s" : "frames";
  return (info.has_times ? fmt::format("{:.4g} Hz; ", 1 / spacing.median) : std::string()) +
         fmt::format("spacing {:.4g} {} (median), {:.4g} to {:.4g} (5 to 95 %), {:.4g} to {:.4g} "
                     "(all)",
                     spacing.median, unit, spacing.p05, spacing.p95, spacing.min, spacing.max);
}

std::string spread_text(const Spread& spread, const std::string& unit) {
  if (spread.count == 0) return "not evident";
  return fmt::format("{:.4g} {} (median), {:.4g} to {:.4g} (5 to 95 %), at most {:.4g}",
                     spread.median, unit, spread.p05, spread.p95, spread.max);
}

std::string span_text(const TrajectoryInfo& info, const FrameSpan& span) {
  return fmt::format("{} from {}", length_text(info, span.length_ns()),
                     at_text(info, span.first_ns));
}

std::string jump_text(const TrajectoryInfo& info, const ImplausibleStep& jump) {
  return fmt::format("{:.3g} m, {:.2g} deg at {} ({})", jump.distance_m, jump.angle_deg,
                     at_text(info, jump.span.last_ns),
                     jump.times_faster
                         ? fmt::format("{:.2g} times as fast as around", *jump.times_faster)
                         : std::string("where it stands"));
}

std::string plane_text(const MotionPlane& plane) {
  if (!plane.outcome) return "not evident: " + plane.outcome.reason;
  return fmt::format("across the world's {} axis, tilted by {:.2f} deg; {:.3g} m off it (rms)",
                     plane.axis, plane.tilt_deg, plane.rms_m);
}

std::string forward_text(const ForwardAxis& forward) {
  if (!forward.outcome) return "not evident: " + forward.outcome.reason;
  return fmt::format("{} of the body, within {:.1f} deg ({:.0f} % agree){}", forward.axis,
                     forward.angle_deg, 100 * forward.steadiness,
                     forward.convention.empty() ? "" : ": as of " + forward.convention);
}

std::string likelihood_text(const Likelihood& likelihood) {
  return likelihood.outcome ? likelihood.answer : "not evident: " + likelihood.outcome.reason;
}

std::string full_text(const TrajectoryInfo& info) {
  std::string text;
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("{:<20}{}\n", name, value);
  };
  const std::string per = info.has_times ? "/s" : " a frame";
  line("frames", fmt::format("{}, {} with a pose{}", info.frames, info.posed,
                             info.has_orientation ? "" : " (positions alone)"));
  line("time", time_text(info));
  line("path", fmt::format("{:.3f} m in a box of {:.2f} x {:.2f} x {:.2f} m", info.length_m,
                           info.extent_m.x(), info.extent_m.y(), info.extent_m.z()));
  line("rate", rate_text(info));
  line("gaps", list_text(info.gaps, [&](const FrameSpan& s) { return span_text(info, s); }));
  line("stops", list_text(info.stops, [&](const FrameSpan& s) { return span_text(info, s); }));
  line("jumps",
       list_text(info.jumps, [&](const ImplausibleStep& j) { return jump_text(info, j); }));
  line("speed", spread_text(info.speed, "m" + per));
  line("turning", spread_text(info.turning_deg, "deg" + per));
  if (info.repeated > 0) line("repeated poses", fmt::format("{}", info.repeated));
  line("plane", plane_text(info.plane));
  line("forward", forward_text(info.forward));
  line("quaternions", likelihood_text(info.quaternions));
  line("unit of positions", likelihood_text(info.length_unit));
  line("unit of stamps", likelihood_text(info.time_unit));
  return text;
}

/// What is suspicious, one line each.
std::vector<std::string> doubts_of(const TrajectoryInfo& info) {
  std::vector<std::string> doubts;
  for (const auto& [what, likelihood] :
       {std::pair{"quaternions", &info.quaternions}, {"positions", &info.length_unit},
        {"stamps", &info.time_unit}})
    if (likelihood->outcome && !likelihood->as_read)
      doubts.push_back(std::string(what) + ": " + likelihood->answer);
  return doubts;
}

std::string table(const std::vector<NamedInfo>& infos) {
  std::size_t width = 10;
  for (const NamedInfo& each : infos) width = std::max(width, each.name.size());
  std::string text =
      fmt::format("{:<{}} {:>8} {:>8} {:>10} {:>10} {:>8} {:>5} {:>5} {:>5} {:>9} {:>5} {:>7}\n",
                  "trajectory", width, "frames", "posed", "time s", "path m", "rate Hz", "gaps",
                  "stops", "jumps", "speed", "plane", "forward");
  for (const auto& [name, info] : infos) {
    const std::string time =
        info.has_times ? fmt::format("{:.3f}", in_seconds(info.last_ns - info.first_ns)) : "-";
    const std::string rate = info.has_times && info.spacing_s.count > 0
                                 ? fmt::format("{:.4g}", 1 / info.spacing_s.median)
                                 : "-";
    text += fmt::format(
        "{:<{}} {:>8} {:>8} {:>10} {:>10.3f} {:>8} {:>5} {:>5} {:>5} {:>9.3g} {:>5} {:>7}\n", name,
        width, info.frames, info.posed, time, info.length_m, rate, info.gaps.size(),
        info.stops.size(), info.jumps.size(), info.speed.median,
        info.plane.outcome ? std::string(1, info.plane.axis) : "-",
        info.forward.outcome ? info.forward.axis : "-");
  }
  return text + "speed: median, m/s or m a frame; plane: the axis across it; -: not evident\n";
}

Json spread_json(const Spread& spread) {
  if (spread.count == 0) return nullptr;
  return {{"min", spread.min}, {"p05", spread.p05}, {"median", spread.median},
          {"p95", spread.p95}, {"max", spread.max}, {"count", spread.count}};
}

Json span_json(const TrajectoryInfo& info, const FrameSpan& span) {
  Json object = {{"first", span.first}, {"last", span.last}};
  if (info.has_times) {
    object["from_s"] = in_seconds(span.first_ns - info.first_ns);
    object["length_s"] = in_seconds(span.length_ns());
  } else {
    object["length_frames"] = span.length_ns();
  }
  return object;
}

Json spans_json(const TrajectoryInfo& info, const std::vector<FrameSpan>& spans) {
  Json list = Json::array();
  for (const FrameSpan& span : spans) list.push_back(span_json(info, span));
  return list;
}

/// null where nothing is evident, with the reason beside it.
Json plane_json(const MotionPlane& plane) {
  if (!plane.outcome) return {{"axis", nullptr}, {"reason", plane.outcome.reason}};
  return {{"axis", std::string(1, plane.axis)},
          {"tilt_deg", plane.tilt_deg},
          {"normal_world", numbers(plane.normal_world)},
          {"rms_m", plane.rms_m}};
}

Json forward_json(const ForwardAxis& forward) {
  if (!forward.outcome) return {{"axis", nullptr}, {"reason", forward.outcome.reason}};
  return {{"axis", forward.axis},
          {"angle_deg", forward.angle_deg},
          {"direction_body", numbers(forward.direction_body)},
          {"steadiness", forward.steadiness},
          {"convention", forward.convention}};
}

Json likelihood_json(const Likelihood& likelihood) {
  if (!likelihood.outcome) return {{"as_read", nullptr}, {"reason", likelihood.outcome.reason}};
  return {{"as_read", likelihood.as_read}, {"reason", likelihood.answer}};
}

Json jumps_json(const TrajectoryInfo& info) {
  Json list = Json::array();
  for (const ImplausibleStep& jump : info.jumps) {
    Json object = span_json(info, jump.span);
    object["distance_m"] = jump.distance_m;
    object["angle_deg"] = jump.angle_deg;
    object["times_faster"] = jump.times_faster ? Json(*jump.times_faster) : Json(nullptr);
    list.push_back(object);
  }
  return list;
}

Json info_json(const NamedInfo& named) {
  const TrajectoryInfo& info = named.info;
  Json object = {{"name", named.name},
                 {"frames", info.frames},
                 {"posed", info.posed},
                 {"has_times", info.has_times},
                 {"has_orientation", info.has_orientation},
                 {"first_ns", info.first_ns},
                 {"last_ns", info.last_ns},
                 {"path_m", info.length_m},
                 {"extent_m", numbers(info.extent_m)},
                 {info.has_times ? "spacing_s" : "spacing_frames", spread_json(info.spacing_s)},
                 {info.has_times ? "speed_m_per_s" : "speed_m_per_frame", spread_json(info.speed)},
                 {info.has_times ? "turning_deg_per_s" : "turning_deg_per_frame",
                  spread_json(info.turning_deg)},
                 {"repeated_poses", info.repeated},
                 {"gaps", spans_json(info, info.gaps)},
                 {"stops", spans_json(info, info.stops)},
                 {"jumps", jumps_json(info)},
                 {"plane", plane_json(info.plane)},
                 {"forward", forward_json(info.forward)},
                 {"quaternions", likelihood_json(info.quaternions)},
                 {"unit_of_positions", likelihood_json(info.length_unit)},
                 {"unit_of_stamps", likelihood_json(info.time_unit)},
                 {"warnings", info.warnings}};
  return object;
}

}  // namespace

std::vector<NamedInfo> eval_info(const EvalInfoArguments& arguments) {
  const TrajectoryFilter filter(arguments.apply);
  const std::vector<std::string> names = distinct_names(arguments.files);
  std::vector<NamedInfo> infos;
  for (std::size_t i = 0; i < arguments.files.size(); ++i) {
    const std::string& file = arguments.files[i];
    infos.push_back({names[i], trajectory_info(filter.apply(read_truth(file, arguments.times)))});
    for (const std::string& warning : infos.back().info.warnings) warn(warning);
    for (const std::string& doubt : doubts_of(infos.back().info)) warn(file + ": " + doubt);
  }
  return infos;
}

std::string to_text(const std::vector<NamedInfo>& infos) {
  return infos.size() == 1 ? full_text(infos.front().info) : table(infos);
}

std::string to_json(const std::vector<NamedInfo>& infos) {
  if (infos.size() == 1) return json_text(info_json(infos.front()), 1);
  Json list = Json::array();
  for (const NamedInfo& each : infos) list.push_back(info_json(each));
  return json_text(Json{{"trajectories", list}}, 1);
}

}  // namespace placegraph::apps
