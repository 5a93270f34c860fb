#include "apps/viewer/run_pages.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/map/map_file.h>
#include <placegraph/pipeline/report/served_page.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

/// "runs/R/frames/F/REST".
struct FramePath {
  std::size_t run = 0;
  std::int64_t frame = 0;
  std::string rest;
};

std::optional<std::int64_t> number_of(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

std::optional<FramePath> frame_path(std::string_view path) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    parts.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  if (parts.size() != 5 || parts[0] != "runs" || parts[2] != "frames") return std::nullopt;
  const auto run = number_of(parts[1]), frame = number_of(parts[3]);
  if (!run || !frame) return std::nullopt;
  return FramePath{static_cast<std::size_t>(*run), *frame, std::string(parts[4])};
}

HttpResponse json_text_response(std::string text) {
  HttpResponse response;
  response.type = "application/json";
  response.body = std::move(text);
  return response;
}

}  // namespace

HttpResponse json_response(const json& data, int status) {
  HttpResponse response =
      json_text_response(data.dump(-1, ' ', false, json::error_handler_t::replace));
  response.status = status;
  return response;
}

RunPages::RunPages(const std::vector<std::string>& runs, std::string program)
    : program_(std::move(program)) {
  for (const std::string& run : runs) {
    auto stored = std::make_shared<const StoredMap>(read_stored_map(run, messages()));
    auto images = std::make_unique<MapImages>(stored->origin);
    const std::string path = map_path_of(run);
    runs_.push_back({path, name_of_run(path), false, std::move(stored), std::move(images)});
  }
}

std::string RunPages::title() const {
  std::string title;
  for (const Run& run : runs_) title += (title.empty() ? "" : ", ") + run.name;
  return title;
}

std::shared_ptr<const StoredMap> RunPages::stored(std::size_t run) const {
  const std::lock_guard lock(mutex_);
  return runs_[run].stored;
}

std::shared_ptr<const StoredMap> RunPages::first() const { return stored(0); }

void RunPages::show(std::shared_ptr<const StoredMap> stored, bool edited) {
  const std::lock_guard lock(mutex_);
  runs_.front().stored = std::move(stored);
  runs_.front().edited = edited;
}

ServedRun RunPages::served(std::size_t number) const {
  const Run& run = runs_[number];
  ServedRun served{run.name, run.path, nullptr};
  // Both at once: the map of one state must not be described with the files of another.
  const std::lock_guard lock(mutex_);
  served.stored = run.stored;
  if (run.edited)
    served.path = (std::filesystem::path(run.path).parent_path() / "edited.db").string();
  return served;
}

HttpResponse RunPages::report() const {
  std::vector<ServedRun> runs;
  for (std::size_t i = 0; i < runs_.size(); ++i) runs.push_back(served(i));
  return json_text_response(served_runs(title(), program_, runs, messages()));
}

HttpResponse RunPages::of_frame(const std::string& path) {
  const std::optional<FramePath> at = frame_path(path);
  if (!at || at->run >= runs_.size()) return text_response(404, "no such page");
  if (at->rest == "image.jpg") {
    auto jpeg = runs_[at->run].images->jpeg(FrameId(at->frame));
    if (!jpeg)
      return text_response(
          404, fmt::format("no frame {} in {}", at->frame, stored(at->run)->origin.sequence));
    HttpResponse response;
    response.type = "image/jpeg";
    response.body = std::move(*jpeg);
    return response;
  }
  if (at->rest != "observations.json") return text_response(404, "no such page");
  const auto map = stored(at->run);
  const auto& keyframes = map->map.keyframes;
  const auto keyframe =
      std::ranges::find(keyframes, FrameId(at->frame), [](const Keyframe& k) { return k.frame; });
  if (keyframe == keyframes.end()) return text_response(404, "the frame is no keyframe");
  return json_text_response(served_observations(map->map, *keyframe));
}

HttpResponse RunPages::respond(const std::string& path) {
  try {
    if (path == "report.json") return report();
    return of_frame(path);
  } catch (const Error& error) {
    return text_response(500, error.what());
  }
}

}  // namespace placegraph::apps
