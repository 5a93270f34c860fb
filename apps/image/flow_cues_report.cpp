#include "apps/image/flow_cues_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/support/numbers_json.h"

namespace placegraph::apps {
namespace {

using nlohmann::ordered_json;

ordered_json list_of(const Eigen::VectorXd& vector) {
  ordered_json list = ordered_json::array();
  for (const double value : vector) list.push_back(value);
  return list;
}

ordered_json refused(const Outcome& outcome) {
  return {{"outcome", to_string(outcome.code)}, {"reason", outcome.reason}};
}

ordered_json affine_json(const AffineFlow& flow) {
  if (!flow.outcome) return refused(flow.outcome);
  return {{"outcome", "ok"},
          {"divergence", flow.divergence()},
          {"divergence_variance", flow.divergence_variance()},
          {"centre", list_of(flow.centre)},
          {"gradient", rows_json(flow.gradient)},
          {"covariance", rows_json(flow.covariance)}};
}

ordered_json balance_json(const LateralBalance& balance) {
  if (!balance.outcome) return refused(balance.outcome);
  return {{"outcome", "ok"},
          {"balance", balance.balance},
          {"variance", balance.sigma * balance.sigma},
          {"left", balance.left},
          {"right", balance.right}};
}

ordered_json ventral_json(const VentralMotion& motion, double dt) {
  if (!motion.outcome) return refused(motion.outcome);
  return {{"outcome", "ok"},
          {"speed_over_distance", list_of(motion.over_distance / dt)},
          {"covariance", rows_json(Eigen::Matrix3d(motion.covariance / (dt * dt)))},
          {"agreeing", motion.inliers},
          {"chi2_per_dof", motion.chi2_per_dof}};
}

ordered_json contact_json(const TimeToContact& contact) {
  if (!contact.outcome) return refused(contact.outcome);
  return {
      {"outcome", "ok"}, {"time", contact.seconds}, {"variance", contact.sigma * contact.sigma}};
}

std::string or_why(const ordered_json& cue, const std::string& line) {
  return cue["outcome"] == "ok" ? line : "none: " + cue["reason"].get<std::string>();
}

double number(const ordered_json& cue, const char* key) {
  return cue.contains(key) ? cue[key].get<double>() : NAN;
}

}  // namespace

ordered_json describe_cues(const std::vector<FlowVector>& flow, const CueSetting& setting) {
  const KnownRotation known_rotation = setting.rotation.value_or(KnownRotation{});
  const double dt = setting.dt_s.value_or(1);
  const std::vector<DerotatedFlow> derotated = derotate(setting.camera, flow, known_rotation);
  const VentralMotion motion = ventral_motion(derotated, setting.normal, known_rotation.covariance);
  ordered_json cues{{"vectors", derotated.size()},
                    {"time_unit", setting.dt_s ? "s" : "image"},
                    {"turn_rad", nullptr},
                    {"normal", list_of(setting.normal)}};
  if (setting.rotation) cues["turn_rad"] = list_of(setting.rotation->R_1_2.log());
  cues["affine"] = affine_json(affine_flow(derotated, known_rotation.covariance));
  cues["ventral"] = ventral_json(motion, dt);
  cues["time_to_contact"] = contact_json(time_to_contact(motion, setting.normal, dt));
  cues["balance"] = balance_json(lateral_balance(derotated, known_rotation.covariance));
  return cues;
}

bool any_cue(const ordered_json& cues) {
  const auto estimated = [&](const char* cue) { return cues[cue]["outcome"] == "ok"; };
  return estimated("affine") || estimated("ventral") || estimated("time_to_contact") ||
         estimated("balance");
}

std::string cue_lines(const ordered_json& cues) {
  const std::string unit = cues["time_unit"];
  const auto sigma = [](const ordered_json& cue, const char* key) {
    return std::sqrt(number(cue, key));
  };
  const ordered_json &affine = cues["affine"], &ventral = cues["ventral"],
                     &contact = cues["time_to_contact"], &balance = cues["balance"];
  std::string over;
  if (ventral["outcome"] == "ok")
    for (std::size_t i = 0; i < 3; ++i)
      over += fmt::format("{:.5f} +- {:.5f} ", ventral["speed_over_distance"][i].get<double>(),
                          std::sqrt(ventral["covariance"][i][i].get<double>()));
  return fmt::format(
             "{} vectors, {}\n", cues["vectors"].get<std::size_t>(),
             cues["turn_rad"].is_null() ? "no rotation subtracted" : "rotation subtracted") +
         "divergence: " +
         or_why(affine, fmt::format("{:.5f} +- {:.5f} an image", number(affine, "divergence"),
                                    sigma(affine, "divergence_variance"))) +
         "\nspeed over distance: " + or_why(ventral, over + "1/" + unit) + "\ntime to contact: " +
         or_why(contact, fmt::format("{:.3f} +- {:.3f} {}", number(contact, "time"),
                                     sigma(contact, "variance"), unit)) +
         "\nleft-right balance: " +
         or_why(balance, fmt::format("{:.4f} +- {:.4f}", number(balance, "balance"),
                                     sigma(balance, "variance")));
}

}  // namespace placegraph::apps
