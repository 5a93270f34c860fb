#include "apps/image/flow.h"

#include <fmt/format.h>
#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/frontend/flow/optical_flow.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/calibration/read_calibration.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/picture_file.h>
#include <placegraph/io/measurements/flow_file.h>

#include <cmath>

#include "apps/image/draw_flow.h"
#include "apps/image/flow_cues_report.h"
#include "apps/support/output.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

Eigen::Vector3d vector_of(const char* option, const std::vector<double>& values) {
  require(values.size() == 3, fmt::format("{}: three numbers are needed", option));
  const Eigen::Vector3d vector(values[0], values[1], values[2]);
  require(vector.allFinite(), fmt::format("{}: is not finite", option));
  return vector;
}

/// Settings of the cues. Throws ArgumentError for contradictory arguments.
CueSetting cue_setting(const FlowArguments& arguments) {
  require(!arguments.calib.empty(), "--flow-cues: need the camera, --calib");
  require(arguments.gyro.empty() || arguments.dt_s > 0, "--gyro: needs --dt");
  require(arguments.dt_s == 0 || (arguments.dt_s >= 1e-6 && arguments.dt_s <= 1e4),
          "--dt: between 1e-6 and 1e4 s");
  require(std::isfinite(arguments.rotation_sigma), "--rotation-sigma: is not finite");
  CueSetting setting;
  setting.camera = read_calibration(arguments.calib);
  if (arguments.dt_s > 0) setting.dt_s = arguments.dt_s;
  if (!arguments.normal.empty()) {
    const Eigen::Vector3d normal = vector_of("--normal", arguments.normal);
    require(normal.norm() > 1e-9, "--normal: a direction needs a length");
    setting.normal = normal.normalized();
  }
  std::optional<Eigen::Vector3d> rotation;
  if (!arguments.gyro.empty()) rotation = arguments.dt_s * vector_of("--gyro", arguments.gyro);
  if (!arguments.rotation.empty()) rotation = vector_of("--rotation", arguments.rotation);
  if (rotation)
    setting.rotation = {SO3::exp(*rotation), arguments.rotation_sigma * arguments.rotation_sigma *
                                                 Eigen::Matrix3d::Identity()};
  return setting;
}

FlowOptions flow_options(const FlowArguments& arguments) {
  FlowOptions options;
  for (const std::string& setting : arguments.settings)
    set_option(options, setting, option_notes());
  set_option(options, "method=" + arguments.method);
  options.check();
  return options;
}

std::int64_t known_pixels(const Image& flow) {
  std::int64_t count = 0;
  for (int v = 0; v < flow.rows; ++v)
    for (int u = 0; u < flow.cols; ++u) {
      const auto& d = flow.at<cv::Vec2f>(v, u);
      count += std::isfinite(d[0]) && std::isfinite(d[1]);
    }
  return count;
}

void write_flow_files(const FlowArguments& arguments, const Image& from, const Image& flow) {
  if (!arguments.out.empty()) write_flow(arguments.out, flow);
  if (arguments.drawing.empty()) return;
  write_png(arguments.drawing, draw_flow(from, flow, arguments.drawing));
}

}  // namespace

FlowResult flow(const FlowArguments& arguments) {
  for (const std::string& file : {arguments.out, arguments.drawing})
    if (!file.empty()) require_free(file, arguments.force);
  if (!arguments.out.empty()) require_flow_extension(arguments.out);
  if (!arguments.drawing.empty()) require_drawings(arguments.drawing);
  const FlowOptions options = flow_options(arguments);
  std::optional<CueSetting> cues;
  if (arguments.cues) cues = cue_setting(arguments);
  const Image from = read_image(arguments.from).grey, to = read_image(arguments.to).grey;
  require_size(arguments.to, to, from.cols, from.rows);
  if (cues) require_size(arguments.from, from, cues->camera.width, cues->camera.height);
  std::optional<Image> truth;
  if (!arguments.truth.empty()) {
    truth = read_flow(arguments.truth);
    require_size(arguments.truth, *truth, from.cols, from.rows);
  }
  FlowResult result;
  result.method = arguments.method;
  const Stopwatch watch;
  const Image found = optical_flow(from, to, options);
  result.cpu_ms = watch.cpu_ms();
  result.known = known_pixels(found);
  if (result.known == 0) throw NoResult("no displacement was found");
  write_flow_files(arguments, from, found);
  if (truth) result.error = flow_error(found, *truth);
  if (cues) {
    result.cues = describe_cues(sampled_flow(from, found, arguments.cell_px), *cues);
    if (!any_cue(result.cues))
      result.no_result = "--flow-cues: no cue could be estimated from the flow";
  }
  return result;
}

std::string to_text(const FlowResult& result) {
  std::string line =
      fmt::format("{}: {} displacements in {:.0f} ms", result.method, result.known, result.cpu_ms);
  if (result.error)
    line += fmt::format(
        "; end-point error {:.3f} px (median {:.3f}), {:.1f} % beyond 3 px, {:.1f} % "
        "of the truth covered",
        result.error->mean_px, result.error->median_px, 100 * result.error->share_beyond_3px,
        100 * result.error->coverage);
  if (!result.cues.is_null()) line += "\n" + cue_lines(result.cues);
  return line + "\n";
}

std::string to_json(const FlowResult& result) {
  nlohmann::ordered_json json{
      {"method", result.method}, {"known", result.known}, {"cpu_ms", result.cpu_ms}};
  if (result.error) {
    json["truth_pixels"] = result.error->pixels;
    json["compared"] = result.error->compared;
    json["coverage"] = result.error->coverage;
    json["epe_mean_px"] = result.error->mean_px;
    json["epe_median_px"] = result.error->median_px;
    json["share_beyond_3px"] = result.error->share_beyond_3px;
  }
  if (!result.cues.is_null()) json["cues"] = result.cues;
  return json_text(json, 2);
}

}  // namespace placegraph::apps
