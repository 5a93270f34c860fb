#include "apps/image/cmd_flow.h"

#include <placegraph/frontend/flow/optical_flow.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/image/flow.h"
#include "apps/support/calib_option.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct FlowCommand {
  FlowArguments arguments;
  bool json = false;
};

void run_flow(const FlowCommand& command) {
  const FlowResult result = flow(command.arguments);
  print(command.json ? to_json(result) : to_text(result));
  if (result.no_result) throw NoResult(*result.no_result);
}

}  // namespace

void add_flow_command(CLI::App& image) {
  auto flow_command = std::make_shared<FlowCommand>();
  FlowArguments& a = flow_command->arguments;
  CLI::App* command = image.add_subcommand("flow", "Estimate the optical flow between two images");
  command->footer(
      "placegraph image flow a.png b.png --method horn-schunck --out f.flo --draw f.png");
  command
      ->add_option("FROM", a.from, "first image")
      ->type_name(kInput)
      ->required();
  command
      ->add_option("TO", a.to, "second image")
      ->type_name(kInput)
      ->required();
  command->add_option("--method", a.method, "algorithm")
      ->check(CLI::IsMember(flow_method_names()))
      ->capture_default_str();
  command
      ->add_option("-o,--out", a.out, "file to write: .flo (Middlebury) or .png (KITTI)")
      ->type_name(kOutput);
  command
      ->add_option("--draw", a.drawing, "PNG file for the flow, drawn in colours")
      ->type_name(kOutput);
  command
      ->add_option("--truth", a.truth, "true flow to compare with: .flo or .png")
      ->type_name(kInput);
  command->add_option("--set", a.settings, kSetText)->type_size(1)->allow_extra_args(false);
  auto* cues = command->add_flag("--flow-cues", a.cues,
                                 "also print divergence, speed over distance, time to contact "
                                 "and balance; see docs/flow.md");
  add_calib_option(*command, a.calib, kCalibFile)->needs(cues);
  command->add_option("--dt", a.dt_s, "time between the images [s]; default: 1 per image")
      ->check(CLI::PositiveNumber)
      ->needs(cues);
  const auto three = [&](const char* name, std::vector<double>& values, const char* what) {
    return command->add_option(name, values, what)->expected(3)->delimiter(',')->needs(cues);
  };
  auto* gyro = three("--gyro", a.gyro,
                     "angular velocity of the camera in its axes; its flow is subtracted [rad/s]");
  three("--rotation", a.rotation, "rotation vector of the camera between the images [rad]")
      ->excludes(gyro);
  command
      ->add_option("--rotation-sigma", a.rotation_sigma,
                   "standard deviation of the rotation about each axis [rad]")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  three("--normal", a.normal, "normal of the plane in the first camera, x,y,z");
  command->add_option("--cell", a.cell_px, "side of the square with one vector [px]")
      ->check(CLI::Range(4, 512))
      ->capture_default_str();
  command->add_flag("--json", flow_command->json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([flow_command] { run_flow(*flow_command); });
}

}  // namespace placegraph::apps
