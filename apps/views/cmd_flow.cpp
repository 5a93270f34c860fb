#include "apps/views/cmd_flow.h"

#include <placegraph/frontend/internal/flow/optical_flow.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/support/calib_option.h"
#include "apps/support/output.h"
#include "apps/views/flow.h"

namespace placegraph::apps {
namespace {

struct FlowCommand {
  FlowArguments arguments;
  bool json = false;
};

void run_flow(const FlowCommand& command) {
  const FlowResult result = flow(command.arguments);
  print(command.json ? to_json(result) : to_text(result));
  if (result.no_answer) throw NoAnswer(*result.no_answer);
}

}  // namespace

void add_flow_command(CLI::App& app) {
  auto flow_command = std::make_shared<FlowCommand>();
  FlowArguments& a = flow_command->arguments;
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
  add_calib_option(*command, a.calib, kCalibFile)->needs(cues);
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
  command
      ->add_option("--turn-sigma", a.rotation_sigma,
                   "of either, from image to image, an axis [rad]")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  three("--normal", a.normal, "to the plane that is approached or passed, in the first camera");
  command->add_option("--cell", a.cell_px, "one vector in a square of so many pixels a side")
      ->check(CLI::Range(4, 512))
      ->capture_default_str();
  command->add_flag("--json", flow_command->json, "print JSON");
  command->add_flag("--force", a.force, "overwrite OUT and the drawing");
  command->callback([flow_command] { run_flow(*flow_command); });
}

}  // namespace placegraph::apps
