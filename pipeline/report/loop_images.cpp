#include <placegraph/pipeline/report/loop_images.h>

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/thumbnail.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/exports/base64.h>
#include <placegraph/io/map/map_database.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include <placegraph/pipeline/report/tables/column.h>

namespace placegraph::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// JPEG files by the numbers of their images.
using Thumbnails = std::map<std::int64_t, std::string>;

/// The middle one of the matches that were candidates of the query.
FrameId middle_match(FrameId query, const LoopQuery& of, std::int64_t min_age) {
  std::vector<FrameId> matches;
  for (const FrameId match : of.matches)
    if (match >= of.first && match <= of.last && query.value() - match.value() >= min_age)
      matches.push_back(match);
  return matches.empty() ? of.matches.front() : matches[matches.size() / 2];
}

std::string why_missed(LoopVerdict verdict) {
  switch (verdict) {
    case LoopVerdict::kTooYoung:
      return "all candidates are too young";
    case LoopVerdict::kOutOfRange:
      return "all candidates are out of range";
    default:
      return "nothing was proposed";
  }
}

/// The images that a page has.
std::set<std::int64_t> images_of(const std::vector<PageLoop>& loops) {
  constexpr std::size_t kMost = 1000;
  std::set<std::int64_t> images;
  for (const char* verdict : {"wrong", "missed", "right"})
    for (const PageLoop& loop : loops) {
      if (loop.verdict != verdict) continue;
      if (images.size() + 2 > kMost) return images;
      images.insert(loop.query.value());
      images.insert(loop.match.value());
    }
  return images;
}

Thumbnails of_map(const std::set<std::int64_t>& images, const std::string& path) {
  Thumbnails thumbnails;
  for (Keyframe& keyframe : read_map(path).map.keyframes)
    if (!keyframe.thumbnail.empty() && images.contains(keyframe.frame.value()))
      thumbnails.emplace(keyframe.frame.value(), std::move(keyframe.thumbnail));
  return thumbnails;
}

Thumbnails of_sequence(const std::set<std::int64_t>& images, const std::string& folder,
                       std::int64_t count) {
  Thumbnails thumbnails;
  const std::unique_ptr<Dataset> dataset = open_dataset(folder);
  if (static_cast<std::int64_t>(dataset->size()) != count) return thumbnails;
  const Sensor sensor = dataset->sensors().front();
  for (const std::int64_t image : images) {
    const Frame frame = dataset->frame(static_cast<std::size_t>(image), sensor);
    thumbnails.emplace(image, thumbnail_of(frame.colour.empty() ? frame.image : frame.colour));
  }
  return thumbnails;
}

/// A page without images is still a page: what cannot be read is reported and left out.
Thumbnails thumbnails_of(const std::set<std::int64_t>& images, const std::string& predictions_file,
                         const std::string& poses_file, std::int64_t count, const LogSink& log) {
  const fs::path map = fs::path(predictions_file).parent_path() / "map.db";
  try {
    if (fs::is_regular_file(map)) return of_map(images, map.string());
    if (poses_file.empty()) return {};
    const fs::path folder = fs::absolute(poses_file).parent_path();
    if (fs::exists(folder / "image_0") || fs::exists(folder / "image_2"))
      return of_sequence(images, folder.string(), count);
  } catch (const Error& error) {
    if (log) log(LogLevel::kWarning, fmt::format("no images for the report: {}", error.what()));
  }
  return {};
}

}  // namespace

std::vector<PageLoop> page_loops(const LoopBenchmark& benchmark, const LoopTruth& truth) {
  std::vector<PageLoop> loops;
  for (const JudgedQuery& query : benchmark.queries) {
    const bool hit = query.verdict == LoopVerdict::kHit;
    if (hit || query.verdict == LoopVerdict::kMiss) {
      loops.push_back({query.query, query.best.candidate, query.best.score, query.rank,
                       hit ? "right" : "wrong", query.best.stage});
    } else if (query.has_match) {
      const FrameId match = middle_match(query.query, truth.queries.at(query.query), truth.min_age);
      loops.push_back({query.query, match, std::numeric_limits<double>::quiet_NaN(), 0, "missed",
                       why_missed(query.verdict)});
    }
  }
  return loops;
}

json describe_loop_images(const std::vector<PageLoop>& loops, const std::string& predictions_file,
                          const std::string& poses_file, std::int64_t images, const LogSink& log) {
  std::vector<std::int32_t> id;
  json thumbnails = json::array();
  for (const auto& [image, jpeg] :
       thumbnails_of(images_of(loops), predictions_file, poses_file, images, log)) {
    id.push_back(static_cast<std::int32_t>(image));
    thumbnails.push_back("data:image/jpeg;base64," + to_base64(jpeg));
  }
  const std::vector<std::int32_t> no_place(id.size(), -1);
  return {{"id", column(id)},
          {"frame", column(id)},
          {"place", column(no_place)},
          {"thumbnails", thumbnails},
          {"tracks", nullptr}};
}

}  // namespace placegraph::report
