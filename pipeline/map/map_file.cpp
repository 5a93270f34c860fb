#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/log_message.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/pipeline/map/map_file.h>
#include <placegraph/pipeline/run.h>

#include <filesystem>

namespace placegraph {

std::string map_path_of(const std::string& file_or_folder) {
  const std::filesystem::path path(file_or_folder);
  return std::filesystem::is_directory(path) ? (path / "map.db").string() : file_or_folder;
}

StoredMap read_stored_map(const std::string& file_or_folder, const LogSink& log_sink) {
  const std::string path = map_path_of(file_or_folder);
  StoredMap stored = read_map(path);
  if (!stored.finished)
    log(log_sink, LogLevel::kWarning,
        "{}: its run was broken off; `placegraph run --resume` continues it", path);
  return stored;
}

RunOptions options_of_run(const std::string& path, const MapOrigin& origin) {
  RunOptions options;
  if (!origin.options.empty()) read_options_text(path, origin.options, options);
  return options;
}

LocalizerOptions localizer_options_of(const std::string& path, const MapOrigin& origin) {
  if (origin.view_options.empty())
    throw NoResult(path + ": holds no views of its keyframes (run with views.enabled)");
  LocalizerOptions options;
  read_options_text(path, origin.view_options, options.recognizer.cues);
  if (!origin.options.empty()) options.loops = options_of_run(path, origin).slam.loops;
  return options;
}

}  // namespace placegraph
