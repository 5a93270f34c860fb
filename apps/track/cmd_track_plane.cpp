#include "apps/track/cmd_track_plane.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "apps/support/option_texts.h"
#include "apps/support/output.h"
#include "apps/track/track_plane.h"

namespace placegraph::apps {
namespace {

struct TrackPlaneCommand {
  TrackPlaneArguments arguments;
  std::string calib;
  bool json = false;
};

void run_track_plane(const TrackPlaneCommand& command) {
  const TrackPlaneResult result = track_plane(command.arguments);
  print(command.json ? to_json(result) : to_text(result));
}

/// Adds an option whose value is one of the names of an enum.
template <class Enum>
void add_choice(CLI::App& command, const std::string& name, Enum& value,
                const std::vector<std::string>& names, const std::string& doc) {
  command
      .add_option_function<std::string>(
          name,
          [&value, names](const std::string& chosen) {
            const auto at = std::find(names.begin(), names.end(), chosen) - names.begin();
            value = static_cast<Enum>(at);
          },
          doc)
      ->check(CLI::IsMember(names))
      ->default_str(names[static_cast<std::size_t>(value)]);
}

}  // namespace

void add_track_plane_command(CLI::App& track) {
  auto track_command = std::make_shared<TrackPlaneCommand>();
  TrackPlaneArguments& a = track_command->arguments;
  CLI::App* command = track.add_subcommand("plane", "Track a planar region of an image");
  command->footer(
      "placegraph track plane sequence --template 100,80,300,80,300,220,100,220 --out track.txt");
  command->add_option("DIR", a.in, "a sequence, or a folder of images")
      ->required()
      ->check(CLI::ExistingPath);
  command
      ->add_option("--template", a.corners,
                   "x1,y1,...,x4,y4: corners of the region [px], around it, in the first image")
      ->type_name(kInput)
      ->required();
  command->add_option("--template-image", a.image, "image that the corners are of instead")
      ->check(CLI::ExistingFile);
  command
      ->add_option("-o,--out", a.out,
                   "file: number, tracked or lost, x1 y1 ... x4 y4 [px], similarity per frame")
      ->type_name(kOutput)
      ->required();
  CLI::Option* calibration =
      command
          ->add_option("--calib", track_command->calib,
                       "also the motion before the plane, with the sequence's own camera or that "
                       "of a file: a line fx fy cx cy width height [px], or a calibration.yaml")
          ->type_name(kInput)
          ->expected(0, 1);
  add_choice(*command, "--motion-model", a.options.model, plane_model_names(),
             "motion model of the region");
  add_choice(*command, "--similarity", a.options.align.gradient.similarity, similarity_names(),
             "similarity to maximize");
  add_choice(*command, "--optimizer", a.options.align.optimizer, align_optimizer_names(),
             "optimizer of the search from frame to frame");
  command->add_option("--normal", a.normal, "normal of the plane in the first camera, x,y,z");
  command
      ->add_option("--trajectory", a.trajectory,
                   "poses of the camera in units of the plane's distance; .tum or KITTI's form")
      ->type_name(kInput);
  command
      ->add_option("--draw", a.draw, "folder for the images, drawn with the region")
      ->type_name(kOutput);
  command->add_option("--seed", a.options.align.swarm.seed, kSeedText)->capture_default_str();
  command->add_flag("--json", track_command->json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([track_command, calibration] {
    if (calibration->count() > 0) track_command->arguments.calib = track_command->calib;
    run_track_plane(*track_command);
  });
}

}  // namespace placegraph::apps
