#include "apps/views/cmd_flow.h"

#include <fmt/format.h>
#include <placegraph/eval/scene/flow_error.h>
#include <placegraph/frontend/flow/optical_flow.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/measurements/flow_file.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "apps/support/calib_option.h"
#include "apps/support/read_calib.h"
#include "apps/support/output.h"
#include "apps/support/usage.h"
#include "apps/views/draw_flow.h"
#include "apps/views/flow_cues_report.h"

namespace placegraph::apps {
namespace {

struct FlowArguments {
  std::string from, to, method = "dis", out, drawing, truth, camera;
  std::vector<std::string> settings;
  std::vector<double> gyro, turn, normal;
  double dt_s = 0, turn_sigma = 1e-3;
  int cell_px = 16;
  bool cues = false, as_json = false, force = false;
};

Eigen::Vector3d vector_of(const char* option, const std::vector<double>& values) {
  const Eigen::Vector3d vector(values[0], values[1], values[2]);
  require(vector.allFinite(), fmt::format("{}: is not finite", option));
  return vector;
}

/// What is known beside the images; throws ArgumentError for what does not fit together.
CueSetting cue_setting(const FlowArguments& arguments) {
  require(!arguments.camera.empty(), "--cues: need the camera, --calib");
  require(arguments.gyro.empty() || arguments.dt_s > 0, "--gyro: needs --dt");
  require(arguments.dt_s == 0 || (arguments.dt_s >= 1e-6 && arguments.dt_s <= 1e4),
          "--dt: between 1e-6 and 1e4 s");
  require(std::isfinite(arguments.turn_sigma), "--turn-sigma: is not finite");
  CueSetting setting;
  setting.camera = read_calib(arguments.camera);
  if (arguments.dt_s > 0) setting.dt_s = arguments.dt_s;
  if (!arguments.normal.empty()) {
    const Eigen::Vector3d normal = vector_of("--normal", arguments.normal);
    require(normal.norm() > 1e-9, "--normal: a direction needs a length");
    setting.normal = normal.normalized();
  }
  std::optional<Eigen::Vector3d> turn;
  if (!arguments.gyro.empty()) turn = arguments.dt_s * vector_of("--gyro", arguments.gyro);
  if (!arguments.turn.empty()) turn = vector_of("--turn", arguments.turn);
  if (turn)
    setting.turn = {SO3::exp(*turn),
                    arguments.turn_sigma * arguments.turn_sigma * Eigen::Matrix3d::Identity()};
  return setting;
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

void flow(const FlowArguments& arguments) {
  for (const std::string& file : {arguments.out, arguments.drawing})
    if (!file.empty()) require_free(file, arguments.force);
  if (!arguments.out.empty()) require_flow_extension(arguments.out);
  FlowOptions options;
  for (const std::string& setting : arguments.settings) set_option(options, setting);
  set_option(options, "method=" + arguments.method);
  options.check();
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
  const Stopwatch watch;
  const Image found = optical_flow(from, to, options);
  const double cpu_ms = watch.cpu_ms();
  const std::int64_t known = known_pixels(found);
  if (known == 0) throw NoAnswer("no displacement was found");
  if (!arguments.out.empty()) write_flow(arguments.out, found);
  if (!arguments.drawing.empty()) {
    std::vector<unsigned char> png;
    cv::imencode(".png", draw_flow(from, found), png);
    write_file(arguments.drawing, std::string(png.begin(), png.end()));
  }
  nlohmann::ordered_json figures{
      {"method", arguments.method}, {"known", known}, {"cpu_ms", cpu_ms}};
  std::string line =
      fmt::format("{}: {} displacements in {:.0f} ms", arguments.method, known, cpu_ms);
  if (truth) {
    const FlowError error = flow_error(found, *truth);
    figures["truth_pixels"] = error.pixels;
    figures["compared"] = error.compared;
    figures["coverage"] = error.coverage;
    figures["epe_mean_px"] = error.mean_px;
    figures["epe_median_px"] = error.median_px;
    figures["share_beyond_3px"] = error.share_beyond_3px;
    line += fmt::format(
        "; end-point error {:.3f} px (median {:.3f}), {:.1f} % beyond 3 px, {:.1f} % "
        "of the truth covered",
        error.mean_px, error.median_px, 100 * error.share_beyond_3px, 100 * error.coverage);
  }
  if (cues) {
    figures["cues"] = describe_cues(sampled_flow(from, found, arguments.cell_px), *cues);
    line += "\n" + cue_lines(figures["cues"]);
  }
  fmt::print("{}\n", arguments.as_json ? figures.dump(2) : line);
  if (cues && !any_cue(figures["cues"])) throw NoAnswer("--cues: the flow tells none");
}

}  // namespace

void add_flow_command(CLI::App& app) {
  auto arguments = std::make_shared<FlowArguments>();
  FlowArguments& a = *arguments;
  CLI::App* command = app.add_subcommand("flow", "Optical flow between two images");
  command->footer("placegraph flow a.png b.png --method horn-schunck --out f.flo --draw f.png");
  command->add_option("FROM", a.from, "first image")->required();
  command->add_option("TO", a.to, "second image")->required();
  command->add_option("--method", a.method, "how displacements are found")
      ->check(CLI::IsMember(flow_method_names()))
      ->capture_default_str();
  command->add_option("-o,--out", a.out, "file to write: .flo (Middlebury) or .png (KITTI)");
  command->add_option("--draw", a.drawing, "picture of it (PNG)");
  command->add_option("--truth", a.truth, "true flow to compare with: .flo or .png");
  command->add_option("--set", a.settings, "an option of the method, key=value; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  auto* cues = command->add_flag("--cues", a.cues,
                                 "also what the flow tells at once: divergence, speed over "
                                 "distance, time to contact, balance; see docs/flow.md");
  add_calib_option(*command, a.camera, kCalibFile)->needs(cues);
  command->add_option("--dt", a.dt_s, "time between the images [s]; without, images are counted")
      ->check(CLI::PositiveNumber)
      ->needs(cues);
  const auto three = [&](const char* name, std::vector<double>& values, const char* what) {
    return command->add_option(name, values, what)->expected(3)->delimiter(',')->needs(cues);
  };
  auto* gyro = three("--gyro", a.gyro,
                     "how the camera turns [rad/s], its own axes: that is taken out of the flow");
  three("--turn", a.turn, "the same as a rotation vector from image to image [rad]")
      ->excludes(gyro);
  command->add_option("--turn-sigma", a.turn_sigma, "of either, from image to image, an axis [rad]")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  three("--normal", a.normal, "to the plane that is approached or passed, in the first camera");
  command->add_option("--cell", a.cell_px, "one vector in a square of so many pixels a side")
      ->check(CLI::Range(4, 512))
      ->capture_default_str();
  command->add_flag("--json", a.as_json, "print JSON");
  command->add_flag("--force", a.force, "overwrite OUT and the drawing");
  command->callback([arguments] { flow(*arguments); });
}

}  // namespace placegraph::apps
