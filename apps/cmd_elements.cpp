#include "apps/cmd_elements.h"

#include <CLI/CLI.hpp>

#include "apps/cmd_group.h"
#include "apps/eval/cmd_scene_check.h"
#include "apps/flight/cmd_flight.h"
#include "apps/image/cmd_flow.h"
#include "apps/image/cmd_markers.h"
#include "apps/image/cmd_motion.h"
#include "apps/image/lines/cmd_lines.h"
#include "apps/image/lines/cmd_vanishing.h"
#include "apps/image/planes/cmd_planes.h"
#include "apps/image/planes/cmd_planes_cloud.h"
#include "apps/image/scene/cmd_scene.h"
#include "apps/map/cmd_map_label.h"
#include "apps/map/cmd_map_plan.h"
#include "apps/map/cmd_map_street.h"
#include "apps/places/cmd_match.h"
#include "apps/places/cmd_places.h"
#include "apps/places/cmd_vocabulary.h"
#include "apps/track/cmd_lines_track.h"
#include "apps/track/cmd_track_plane.h"
#include "apps/train/cmd_train.h"

namespace placegraph::apps {

void add_places_group(CLI::App& app) {
  CLI::App& places =
      add_group(app, "places", "Place recognition", "match places/corridor --out found.txt");
  add_match_command(places);
  add_classify_command(places);
  add_vocabulary_command(places);
}

void add_image_group(CLI::App& app) {
  CLI::App& image = add_group(app, "image", "Measurements in one or two images",
                              "flow a.png b.png --out f.flo --draw f.png");
  add_flow_command(image);
  add_motion_command(image);
  add_lines_commands(image);
  add_vanishing_command(image);
  add_planes_command(image);
  add_two_view_planes_command(image);
  add_markers_command(image);
  add_scene_commands(image);
}

void add_track_group(CLI::App& app) {
  CLI::App& track =
      add_group(app, "track", "Tracks through a sequence", "lines SEQUENCE -o tracks.txt");
  add_lines_track_command(track);
  add_track_plane_command(track);
}

void add_train_group(CLI::App& app) {
  CLI::App& train = add_group(app, "train", "Training of the models that come with the program",
                              "urban camvid --out urban.pgscene");
  add_train_commands(train);
  add_train_vocabulary_command(train);
}

void add_flight_group(CLI::App& app) {
  CLI::App& flight = add_group(app, "flight", "State estimation of flying robots",
                               "run out/flight --out out/states");
  add_flight_command(flight);
}

void add_map_scene_commands(CLI::App& map) {
  add_map_label_command(map);
  add_map_plan_command(map);
  add_map_street_command(map);
}

void add_eval_scene_commands(CLI::App& eval) { add_eval_labels_command(eval); }

}  // namespace placegraph::apps
