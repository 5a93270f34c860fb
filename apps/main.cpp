// The command line: `placegraph <command> ...`. Exit codes: 0 ok, 1 the data allowed no answer,
// 2 usage, configuration or file error.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#ifdef __GLIBC__  // known once a header of the library has been read
#include <malloc.h>
#endif

#include "apps/eval/cmd_eval.h"
#include "apps/eval/cmd_eval_edges.h"
#include "apps/eval/cmd_loops.h"
#include "apps/graph/cmd_bundle.h"
#include "apps/graph/cmd_convert.h"
#include "apps/graph/cmd_optimize.h"
#include "apps/help.h"
#include "apps/lines/cmd_lines.h"
#include "apps/lines/cmd_vanishing.h"
#include "apps/map/cmd_explain.h"
#include "apps/map/cmd_georeference.h"
#include "apps/map/cmd_localize.h"
#include "apps/map/cmd_route.h"
#include "apps/places/cmd_match.h"
#include "apps/places/cmd_places.h"
#include "apps/places/cmd_vocabulary.h"
#include "apps/planes/cmd_planes.h"
#include "apps/planes/cmd_track_plane.h"
#include "apps/run/cmd_config.h"
#include "apps/run/cmd_flight.h"
#include "apps/run/cmd_inspect.h"
#include "apps/run/cmd_run.h"
#include "apps/saved_map/cmd_map.h"
#include "apps/scene/cmd_scene.h"
#include "apps/support/output.h"
#include "apps/synth/cmd_synth.h"
#include "apps/synth/cmd_synth_graph.h"
#include "apps/train/cmd_train.h"
#include "apps/views/cmd_flow.h"
#include "apps/views/cmd_markers.h"
#include "apps/views/cmd_motion.h"

namespace {

constexpr int kNoAnswer = 1, kUsage = 2;

int complain(int code, const std::string& message) {
  std::fprintf(stderr, "placegraph: %s\n", placegraph::apps::one_line(message).c_str());
  return code;
}

bool is_command(const CLI::App& app, const std::string& name) {
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  return std::any_of(commands.begin(), commands.end(),
                     [&](const CLI::App* command) { return command->check_name(name); });
}

/// Images come and go with every frame: their memory is kept instead of being handed back to the
/// system and cleared by it anew, which costs a twentieth of a run.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kLargestKept = 64 << 20, kKept = 256 << 20;  // bytes
  mallopt(M_MMAP_THRESHOLD, kLargestKept);
  mallopt(M_TRIM_THRESHOLD, kKept);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  using namespace placegraph::apps;
  keep_freed_memory();
  CLI::App app("Visual odometry, place recognition and pose graphs.", "placegraph");
  try {
    app.formatter(std::make_shared<ExampleFormatter>());
    app.footer("placegraph eval poses.txt trajectory_optimized.kitti --align se3");
    app.set_version_flag("--version", "placegraph " PLACEGRAPH_VERSION);
    app.require_subcommand(1);
    add_bundle_command(app);
    add_config_command(app);
    add_convert_command(app);
    add_eval_command(app);
    add_eval_edges_command(app);
    add_explain_command(app);
    add_flow_command(app);
    add_georeference_command(app);
    add_flight_command(app);
    add_inspect_command(app);
    add_lines_command(app);
    add_localize_command(app);
    add_loops_command(app);
    add_map_command(app);
    add_markers_command(app);
    add_match_command(app);
    add_motion_command(app);
    add_optimize_command(app);
    add_places_command(app);
    add_planes_command(app);
    add_route_command(app);
    add_run_command(app);
    add_scene_command(app);
    add_synth_command(app);
    add_synth_graph_command(app);
    add_track_plane_command(app);
    add_train_command(app);
    add_vanishing_command(app);
    add_vocabulary_command(app);
    if (argc > 1 && argv[1][0] != '-' && !is_command(app, argv[1]))
      return complain(kUsage, "no command '" + std::string(argv[1]) + "' (see placegraph --help)");
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    return complain(kUsage, std::string(error.what()) + " (see " + help_command(app) + ")");
  } catch (const NoAnswer& reason) {
    return complain(kNoAnswer, reason.what());
  } catch (const std::exception& error) {
    return complain(kUsage, error.what());
  }
}
