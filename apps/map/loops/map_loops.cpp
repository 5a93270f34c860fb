#include "apps/map/loops/map_loops.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/pipeline/map/map_file.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

std::optional<FrameId> frame_id(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return FrameId(number);
}

std::pair<FrameId, FrameId> frames_of(const std::string& pair) {
  const std::size_t colon = pair.find(':');
  const auto query = frame_id(std::string_view(pair).substr(0, colon));
  const auto match = colon == std::string::npos
                         ? std::nullopt
                         : frame_id(std::string_view(pair).substr(colon + 1));
  require(query && match,
          fmt::format("'{}': two frames are needed, as in 612:40 (query:match)", pair));
  return {*query, *match};
}

void apply(LoopEdit edit, const std::pair<FrameId, FrameId>& frames, LoopEditor& editor) {
  const auto& [query, match] = frames;
  switch (edit) {
    case LoopEdit::kRefuse:
      (void)editor.refuse(query, match);
      return;
    case LoopEdit::kAccept:
      (void)editor.accept(query, match);
      return;
    case LoopEdit::kAdd:
      (void)editor.add(query, match);
  }
}

}  // namespace

MapLoopsResult map_loops(const MapLoopsArguments& arguments) {
  require_free(arguments.out, arguments.force);
  std::vector<std::pair<FrameId, FrameId>> pairs;
  for (const std::string& pair : arguments.pairs) pairs.push_back(frames_of(pair));
  const std::string path = map_path_of(arguments.map);
  StoredMap stored = read_stored_map(arguments.map, messages());
  const SlamOptions options = options_of_run(path, stored.origin).slam;
  try {
    LoopEditor editor(std::move(stored), options);
    for (const auto& pair : pairs) apply(arguments.edit, pair, editor);
    MapLoopsResult result{.out = arguments.out, .edits = {}, .motion = {}};
    if (!arguments.keep_poses) result.motion = editor.optimize();
    write_map(arguments.out, editor.stored());
    result.edits = editor.edits();
    result.loops = static_cast<std::size_t>(
        std::ranges::count_if(editor.stored().map.loops, &LoopRecord::accepted));
    return result;
  } catch (const ArgumentError& error) {
    throw ArgumentError(path + ": " + error.what());
  }
}

std::string to_text(const MapLoopsResult& result) {
  std::string text;
  for (const std::string& edit : result.edits) text += edit + "\n";
  text += fmt::format("{}: {} accepted loops", result.out, result.loops);
  if (const auto& motion = result.motion)
    text +=
        fmt::format(", {} places (before: {}), {} components (before: {})", motion->places_after,
                    motion->places_before, motion->components_after, motion->components_before);
  return text + "\n";
}

std::string to_json(const MapLoopsResult& result) {
  nlohmann::json json = {
      {"map", result.out}, {"edits", result.edits}, {"loops_accepted", result.loops}};
  if (const auto& motion = result.motion)
    json["optimization"] = {{"places_before", motion->places_before},
                            {"places", motion->places_after},
                            {"components_before", motion->components_before},
                            {"components", motion->components_after},
                            {"translation", motion->translation},
                            {"rotation_rad", motion->rotation_rad}};
  return json_text(json, 1);
}

}  // namespace placegraph::apps
