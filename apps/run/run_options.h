#pragma once
#include <placegraph/pipeline/run.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/run_messages.h"
#include "apps/run/run_watcher.h"

namespace placegraph::apps {

struct RunArguments {
  std::string sequence, out;          ///< what is run, and the folder of the results
  std::string resume;                 ///< folder of a run that was broken off, to go on with
  std::string config;                 ///< YAML file with options; empty: none
  std::vector<std::string> settings;  ///< "key=value"
  std::string odometry;               ///< file of the motion by other sensors; empty: none
  std::string mask;                   ///< file of the mask of all images; empty: none
  std::string draw;                   ///< folder, video or sheet of drawn frames; empty: none
  std::optional<std::string> sensor, cues, scene, elements;
  std::string recognizer;               ///< recognizer of loop candidates (open_describer)
  std::vector<std::string> appearance;  ///< appearance cues beside the recognizer
  std::optional<double> camera_height_m;
  std::optional<std::int64_t> seed;
  std::optional<int> threads;
  double min_posed = 0.2;  ///< share of the frames that must have a pose, else exit code 1
  bool no_loops = false;
  Verbosity verbosity = Verbosity::kNormal;
  bool force = false;             ///< write into folders that are not empty
  RunWatcher* watcher = nullptr;  ///< watches the run; not owned
};

/// map.db of a folder of results.
std::string run_map_path(const std::string& folder);

/// Defaults (or what a run that goes on was begun with) < file < `settings` < the other arguments.
/// Throws ArgumentError and FileError that name the option.
RunOptions run_options(const RunArguments& arguments, RunOptions options = {});

/// The options of the run, its output folder checked. Of a run that goes on `sequence` and `out`
/// are filled in. Throws ArgumentError where the folder is in use, or an argument says otherwise
/// than what the run was begun with.
RunOptions prepare_run(RunArguments& arguments);

}  // namespace placegraph::apps
