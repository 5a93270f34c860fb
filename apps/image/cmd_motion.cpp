#include "apps/image/cmd_motion.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/image/motion.h"
#include "apps/support/calib_option.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct MotionCommand {
  MotionArguments arguments;
  bool json = false;
};

void run_motion(const MotionCommand& command) {
  const MotionResult result = motion(command.arguments);
  // The JSON has the evidence even without a result.
  if (command.json) print(to_json(result));
  if (result.no_result) throw NoResult(*result.no_result);
  if (!command.json) print(to_text(result));
}

}  // namespace

void add_motion_command(CLI::App& image) {
  auto motion_command = std::make_shared<MotionCommand>();
  MotionArguments& a = motion_command->arguments;
  CLI::App* command =
      image.add_subcommand("motion", "Estimate the motion between two views from matched points");
  command->footer("placegraph image motion matches.txt --calib K.txt --json");
  command
      ->add_option("MATCHES", a.in,
                   "lines of xA yA xB yB [px]; of X Y Z x y for 3d2d, of xA yA zA xB yB zB for "
                   "3d3d [m]; further columns are not read")
      ->required()
      ->check(CLI::ExistingFile);
  add_calib_option(*command, a.calib, std::string("camera of both views: ") + kCalibFile);
  command
      ->add_option("--method", a.model,
                   "algorithm: auto chooses among essential, homography and "
                   "rotation; gravity: three points and both verticals; circular: a car; 3d2d, "
                   "3d3d: points of known place in one view or both")
      ->check(CLI::IsMember(motion_model_names()))
      ->capture_default_str();
  command->add_option("--gravity", a.options.gravity,
                      "x,y,z[,x,y,z]: downwards in the first camera [and in the second]; needed by "
                      "gravity; levels the camera of a car");
  command->add_option("--threshold", a.options.threshold_px, "largest error of an inlier [px]");
  command->add_option("--min-inliers", a.options.min_inliers, "smallest number of inliers");
  command
      ->add_option("--point-noise", a.options.noise_m,
                   "standard deviation of each coordinate of a point, for 3d3d [m]")
      ->capture_default_str();
  command->add_option("--seed", a.seed, kSeedText)->capture_default_str();
  command->add_option("-o,--out", a.out, "JSON file")->type_name(kOutput);
  command->add_flag("--json", motion_command->json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([motion_command] { run_motion(*motion_command); });
}

}  // namespace placegraph::apps
