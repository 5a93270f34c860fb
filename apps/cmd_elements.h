#pragma once

namespace CLI {
class App;
}

namespace placegraph::apps {

// The commands of the library placegraph::elements. A program that is built without it
// (PLACEGRAPH_ELEMENTS=OFF) has apps/cmd_without_elements.cpp in place of them: its groups exist
// and say so, with exit code 2.

void add_places_group(CLI::App& app);
void add_image_group(CLI::App& app);
void add_track_group(CLI::App& app);
void add_flight_group(CLI::App& app);
void add_train_group(CLI::App& app);
/// `map label`, `map plan` and `map street`.
void add_map_scene_commands(CLI::App& map);
/// `eval labels`.
void add_eval_scene_commands(CLI::App& eval);

}  // namespace placegraph::apps
