#include "apps/report/loop_images.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/thumbnail.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/exports/base64.h>
#include <placegraph/io/map/map_database.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/page/column.h"
#include "apps/report/report_loops.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// JPEG files by the numbers of their images.
using Thumbnails = std::map<std::int64_t, std::string>;

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
                         const std::string& poses_file, std::int64_t count) {
  const fs::path map = fs::path(predictions_file).parent_path() / "map.db";
  try {
    if (fs::is_regular_file(map)) return of_map(images, map.string());
    if (poses_file.empty()) return {};
    const fs::path folder = fs::absolute(poses_file).parent_path();
    if (fs::exists(folder / "image_0") || fs::exists(folder / "image_2"))
      return of_sequence(images, folder.string(), count);
  } catch (const Error& error) {
    warn(fmt::format("no images for the report: {}", error.what()));
  }
  return {};
}

}  // namespace

json describe_loop_images(const std::vector<PageLoop>& loops, const std::string& predictions_file,
                          const std::string& poses_file, std::int64_t images) {
  std::vector<std::int32_t> id;
  json thumbnails = json::array();
  for (const auto& [image, jpeg] :
       thumbnails_of(images_of(loops), predictions_file, poses_file, images)) {
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

}  // namespace placegraph::apps
