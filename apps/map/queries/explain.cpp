#include "apps/map/queries/explain.h"

#include <fmt/format.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/scene/environment.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/pipeline/map/explanation.h>
#include <placegraph/pipeline/map/map_file.h>
#include <placegraph/pipeline/results/run_map.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>
#include <cmath>

#include "apps/map/queries/image_content.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

json json_of(const LoopRecord& loop) {
  return {{"query_frame", loop.query_frame}, {"match_frame", loop.match_frame},
          {"stage", to_string(loop.stage)},  {"probability", loop.probability},
          {"likeness", loop.similarity},     {"model", to_string(loop.model)},
          {"inliers", loop.inliers},         {"lines", loop.lines}};
}

json list_of(const std::vector<LoopRecord>& loops) {
  json list = json::array();
  for (const LoopRecord& loop : loops) list.push_back(json_of(loop));
  return list;
}

/// Pose T_map_cam of the frame and its standard deviations in the graph.
json where(const Explanation& explanation, const Map& map) {
  if (!explanation.posed) return {{"posed", false}};
  const Eigen::Vector3d& t = explanation.T_map_cam.translation();
  const Eigen::Quaterniond q = explanation.T_map_cam.rotation().quaternion();
  json at = {{"posed", true},
             {"place", *explanation.place},
             {"labels", explanation.labels},
             {"keyframe", *explanation.keyframe},
             {"distance_to_keyframe", explanation.distance_to_keyframe},
             {"component", explanation.component},
             {"unit", map.metric ? "m" : "arbitrary"},
             {"position", {t.x(), t.y(), t.z()}},
             {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}},
             {"covariance", nullptr}};
  if (!explanation.covariance) return at;
  json rows = json::array();
  for (int i = 0; i < 6; ++i) {
    const Vector6d row = explanation.covariance->row(i).transpose();
    rows.push_back(std::vector<double>(row.data(), row.data() + 6));
  }
  at["covariance"] = rows;
  const Vector6d sigma = explanation.covariance->diagonal().cwiseMax(0).cwiseSqrt();
  at["sigma_position"] = sigma.head<3>().norm();
  at["sigma_angle_deg"] = rad_to_deg(sigma.tail<3>().norm());
  return at;
}

/// Assumptions of the run at this frame.
json assumed_by(const StoredMap& stored, const RunOptions& options,
                const Explanation& explanation) {
  const auto& calibration = stored.origin.calibration;
  const double height_m = calibration ? calibration->camera_height_m.value_or(0) : 0;
  const bool monocular = calibration && calibration->baseline_m == 0 && !calibration->depth;
  json assumed = {{"sensor", monocular ? "monocular" : "measured depth"},
                  {"cues", options.slam.odometry.cues},
                  {"metric", stored.map.metric}};
  if (monocular && height_m > 0) assumed["ground_below_camera_m"] = height_m;
  const Place* place =
      explanation.posed ? stored.map.place_graph.find(*explanation.place) : nullptr;
  if (const auto kind = place ? environment_of(*place) : std::nullopt) {
    const Assumptions there = assumptions_of(*kind);
    assumed["environment"] = {{"kind", environment_name(*kind)},
                              {"heeded", options.slam.context.enabled},
                              {"ground_height", there.ground_height},
                              {"manhattan_world", there.manhattan_frame},
                              {"street_surfaces", there.street_surfaces}};
  }
  return assumed;
}

std::string joined(const json& list) {
  std::string text;
  for (const json& value : list) text += fmt::format("{:.4g} ", value.get<double>());
  return text;
}

/// Names with percentages or counts; "nothing" for an empty object.
std::string named(const json& values) {
  std::string text;
  for (const auto& [name, value] : values.items())
    text += value.is_number_float() ? fmt::format("{} {:.0f} %, ", name, 100 * value.get<double>())
                                    : fmt::format("{} {}, ", name, value.dump());
  return text.empty() ? "nothing" : text.substr(0, text.size() - 2);
}

std::string labels_of(const json& labels) {
  std::string text;
  for (const json& label : labels) text += " '" + label.get<std::string>() + "'";
  return text;
}

std::string where_text(const json& at) {
  if (!at["posed"].get<bool>()) {
    return "where      not posed: tracking was lost or not yet initialized\n";
  }
  const char* const unit = unit_of(at["unit"] == "m");
  std::string text =
      fmt::format("where      place {}{}, {:.3g} {} from its keyframe {}, component {}\n",
                  at["place"].get<std::int64_t>(), labels_of(at["labels"]),
                  at["distance_to_keyframe"].get<double>(), unit,
                  at["keyframe"].get<std::int64_t>(), at["component"].get<int>());
  text += fmt::format("           position {}{}, orientation {}(x y z w)\n", joined(at["position"]),
                      unit, joined(at["quaternion_xyzw"]));
  if (at.contains("sigma_position"))
    text +=
        fmt::format("           sigma {:.3g} {} and {:.3g} deg, relative to the first place\n",
                    at["sigma_position"].get<double>(), unit, at["sigma_angle_deg"].get<double>());
  return text;
}

std::string assumptions(const json& assumed) {
  std::string text = fmt::format("{}, cues {}", assumed["sensor"].get<std::string>(),
                                 assumed["cues"].get<std::string>());
  if (assumed.contains("ground_below_camera_m"))
    text += fmt::format(", ground {:g} m below the camera",
                        assumed["ground_below_camera_m"].get<double>());
  if (assumed.contains("environment")) {
    const json& there = assumed["environment"];
    text += ", a " + there["kind"].get<std::string>() + ":";
    for (const char* what : {"ground_height", "manhattan_world", "street_surfaces"})
      text += std::string(there[what].get<bool>() ? " " : " no ") + what;
  }
  return text + (assumed["metric"].get<bool>() ? ", metric" : ", unknown scale");
}

std::string sees_text(const json& sees) {
  if (sees.contains("unknown"))
    return fmt::format("sees       unknown: {}\n", sees["unknown"].get<std::string>());
  return fmt::format("sees       {}\n           {} (of a street by {:.0f} %)\n",
                     named(sees["surfaces"]), named(sees["classes"]),
                     100 * sees["street"].get<double>());
}

}  // namespace

ExplainResult explain(const ExplainArguments& arguments) {
  const StoredMap stored = read_stored_map(arguments.map, messages());
  const auto explanation = explain_frame(stored.map, arguments.frame);
  if (!explanation) throw NoResult(arguments.map + ": has no frame " + to_string(arguments.frame));
  RunOptions options;
  if (!stored.origin.options.empty())
    read_options_text(map_path_of(arguments.map), stored.origin.options, options);
  return {{{"frame", explanation->frame},
           {"stamp_s", 1e-9 * static_cast<double>(explanation->stamp_ns)},
           {"where", where(*explanation, stored.map)},
           {"known_by",
            {{"inliers", explanation->inliers},
             {"features", explanation->features},
             {"features_placed", explanation->features_placed},
             {"constraints", explanation->constraints},
             {"loops", list_of(explanation->loops)}}},
           {"sees", image_content(stored, *explanation)},
           {"assumed", assumed_by(stored, options, *explanation)},
           {"refused", list_of(explanation->refused)}}};
}

std::string to_text(const ExplainResult& result) {
  const json& explanation = result.explanation;
  std::string text =
      fmt::format("frame      {}, {:.3f} s\n", explanation["frame"].get<std::int64_t>(),
                  explanation["stamp_s"].get<double>());
  text += where_text(explanation["where"]);
  const json& by = explanation["known_by"];
  text +=
      fmt::format("known by   {} landmarks; keyframe with {} features, {} placed; constraints {}\n",
                  by["inliers"].get<int>(), by["features"].get<int>(),
                  by["features_placed"].get<int>(), by["constraints"].dump());
  for (const json& loop : by["loops"])
    text += fmt::format("           loop {} -> {}: {} points, {} lines ({}), probability {:.3f}\n",
                        loop["query_frame"].get<std::int64_t>(),
                        loop["match_frame"].get<std::int64_t>(), loop["inliers"].get<int>(),
                        loop["lines"].get<int>(), loop["model"].get<std::string>(),
                        loop["probability"].get<double>());
  text += sees_text(explanation["sees"]);
  text += fmt::format("assumed    {}\n", assumptions(explanation["assumed"]));
  if (explanation["refused"].empty()) text += "refused    nothing\n";
  for (const json& loop : explanation["refused"])
    text += fmt::format("refused    frame {} by {}: probability {:.3f}, {} points\n",
                        loop["match_frame"].get<std::int64_t>(), loop["stage"].get<std::string>(),
                        loop["probability"].get<double>(), loop["inliers"].get<int>());
  return text;
}

std::string to_json(const ExplainResult& result) { return json_text(result.explanation, 1); }

}  // namespace placegraph::apps
