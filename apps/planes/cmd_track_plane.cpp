#include "apps/planes/cmd_track_plane.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "apps/planes/track_plane.h"
#include "apps/support/output.h"

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

/// An option whose value is one of an enum's names.
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

void add_track_plane_command(CLI::App& app) {
  auto track_command = std::make_shared<TrackPlaneCommand>();
  TrackPlaneArguments& a = track_command->arguments;
  CLI::App* command = app.add_subcommand("track-plane", "Follow a planar region of an image");
  command->footer(
      "placegraph track-plane sequence --template 100,80,300,80,300,220,100,220 --out track.txt");
  command->add_option("DIR", a.in, "a sequence, or a folder of images")
      ->required()
      ->check(CLI::ExistingPath);
  command
      ->add_option("--template", a.corners,
                   "x1,y1,...,x4,y4: corners of the region [px], around it, in the first image")
      ->required();
  command->add_option("--template-image", a.image, "image that the corners are of instead")
      ->check(CLI::ExistingFile);
  command
      ->add_option("-o,--out", a.out,
                   "a line a frame: number, tracked or lost, x1 y1 ... x4 y4 [px], similarity")
      ->required();
  CLI::Option* calibration =
      command
          ->add_option("--calib", track_command->calib,
                       "also the motion before the plane, with the sequence's own camera or that "
                       "of a file: a line fx fy cx cy width height [px], or a calibration.yaml")
          ->expected(0, 1);
  add_choice(*command, "--model", a.options.model, plane_model_names(), "how it may move");
  add_choice(*command, "--similarity", a.options.align.gradient.similarity, similarity_names(),
             "what is made great");
  add_choice(*command, "--optimizer", a.options.align.optimizer, align_optimizer_names(),
             "how it is found from frame to frame");
  command->add_option("--normal", a.normal,
                      "nx,ny,nz: the plane's, in the camera of the template, where it is known");
  command->add_option("--trajectory", a.trajectory,
                      "poses of the camera in units of the plane's distance; .tum or KITTI's form");
  command->add_option("--draw", a.draw, "folder for the frames with the region's outline");
  command->add_option("--seed", a.options.align.swarm.seed, "of the searches")
      ->capture_default_str();
  command->add_flag("--json", track_command->json, "print JSON");
  command->add_flag("--force", a.force, "overwrite outputs");
  command->callback([track_command, calibration] {
    if (calibration->count() > 0) track_command->arguments.calib = track_command->calib;
    run_track_plane(*track_command);
  });
}

}  // namespace placegraph::apps
