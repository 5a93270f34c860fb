#include "apps/run/run_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/pipeline/elements.h>
#include <placegraph/pipeline/recognizers/image_recognizer.h>

#include <filesystem>

#include "apps/shipped/shipped_files.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

/// "geometry,semantics", either alone, or "none".
void set_scene(const std::string& list, SceneOptions& options) {
  options.geometry = options.semantics = false;
  std::vector<std::string_view> names;
  split_comma(list, names);
  for (const std::string_view name : names) {
    require(name == "geometry" || name == "semantics" || (name == "none" && names.size() == 1),
            "--scene: " + in_quotes(name) + " is none of geometry, semantics; or none");
    options.geometry = options.geometry || name == "geometry";
    options.semantics = options.semantics || name == "semantics";
  }
}

/// Names the recognizer of this call, which nothing else may open.
void set_recognizer(const RunArguments& arguments, DescriberOptions& options) {
  require(!arguments.recognizer.empty() || arguments.appearance.empty(),
          "--appearance: cues stand beside a --recognizer");
  if (arguments.recognizer.empty()) return;
  options.recognizer = arguments.recognizer;
  options.beside = fmt::format("{}", fmt::join(arguments.appearance, ","));
}

/// A run that was broken off goes on with the sequence and the options it was begun with; takes
/// them into `arguments`. Throws ArgumentError where a flag says otherwise.
RunOptions options_of_resumed(RunArguments& arguments) {
  if (fs::path(arguments.resume).filename() == "map.db")
    arguments.resume = fs::path(arguments.resume).parent_path().string();
  if (arguments.resume.empty()) arguments.resume = ".";
  require(arguments.out.empty() ||
              fs::weakly_canonical(arguments.out) == fs::weakly_canonical(arguments.resume),
          "--out: a resumed run writes into its own folder");
  arguments.out = arguments.resume;
  const std::string path = run_map_path(arguments.resume);
  if (!fs::exists(path))
    throw FileError(path, "is not there: nothing was saved that a run could go on from");
  const MapOrigin origin = read_map_origin(path);
  require(!origin.options.empty(), path + ": is no map of a run");
  require(arguments.sequence.empty() ||
              fs::weakly_canonical(arguments.sequence) == fs::weakly_canonical(origin.sequence),
          "--resume: the run was begun on " + origin.sequence);
  arguments.sequence = origin.sequence;
  RunOptions begun;
  read_options_text(path, origin.options, begun);
  RunOptions asked = run_options(arguments, begun);
  require_recognizer_again(begun.describer, path, !arguments.recognizer.empty());
  begun.threads = asked.threads;
  const auto was = list_options(begun), is = list_options(asked);
  for (std::size_t i = 0; i < was.size(); ++i)
    require(was[i].value == is[i].value, "--resume: the run was begun with " + was[i].path + ": " +
                                             was[i].value + ", not " + is[i].value);
  return asked;
}

}  // namespace

std::string run_map_path(const std::string& folder) {
  return (fs::path(folder) / "map.db").string();
}

RunOptions run_options(const RunArguments& arguments, RunOptions options) {
  if (arguments.scene) set_scene(*arguments.scene, options.scene);
  // What a plan asks of the motion gives way to all that is said of it.
  const bool begins = arguments.resume.empty();
  if (arguments.scene && options.scene.geometry && begins) enable_manhattan_and_planes(options);
  const LogSink notes = option_notes();
  if (!arguments.config.empty()) read_options(config_path(arguments.config), options, notes);
  // A run that goes on has the name of its recognizer, which says what must be given again.
  if (begins) require_no_recognizer(options.describer, "--config " + arguments.config);
  for (const std::string& setting : arguments.settings) set_option(options, setting, notes);
  if (begins) require_no_recognizer(options.describer, "--set");
  set_recognizer(arguments, options.describer);
  if (arguments.sensor) set_option(options, "sensor=" + *arguments.sensor);
  if (arguments.elements) set_elements(parse_elements(*arguments.elements), options);
  if (arguments.scene) set_scene(*arguments.scene, options.scene);
  if (arguments.cues) options.slam.odometry.cues = *arguments.cues;
  if (arguments.camera_height_m) {
    require(*arguments.camera_height_m > 0, "--camera-height: must be positive");
    options.camera_height_m = *arguments.camera_height_m;
  }
  if (!arguments.mask.empty()) options.mask = arguments.mask;
  if (!arguments.odometry.empty()) options.motion.file = arguments.odometry;
  if (arguments.seed) {
    require(*arguments.seed >= 0, "--seed: must not be negative");
    options.slam.seed = static_cast<std::uint64_t>(*arguments.seed);
  }
  if (arguments.threads) options.threads = *arguments.threads;
  if (arguments.no_loops) options.slam.loops.enabled = false;
  options.check();
  return options;
}

RunOptions prepare_run(RunArguments& arguments) {
  if (!arguments.resume.empty()) return options_of_resumed(arguments);
  require(!arguments.sequence.empty() && !arguments.out.empty(),
          "SEQUENCE and --out are needed, or --resume");
  const RunOptions options = run_options(arguments);
  require(arguments.force || !is_unfinished_map(run_map_path(arguments.out)),
          arguments.out + ": holds an unfinished run; --resume continues it, --force begins again");
  require_free_folder(arguments.out, arguments.force);
  return options;
}

}  // namespace placegraph::apps
