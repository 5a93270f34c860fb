#include "apps/report/report_pictures.h"

#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/report/column.h"
#include "apps/support/json_file.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json polyline(const std::string& label, bool closed, const json& points) {
  std::vector<float> coordinates;
  for (const json& point : points)
    for (int i = 0; i < 2; ++i)
      coordinates.push_back(point.at(static_cast<std::size_t>(i)).get<float>());
  return {{"label", label}, {"closed", closed}, {"points", column(coordinates, 2)}};
}

std::string content_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path.string(), "cannot be opened for reading");
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

json describe_floor_plan(const std::string& folder) {
  json plan = json::array();
  const fs::path path = fs::path(folder) / "floor_plan.json";
  if (!fs::is_regular_file(path)) return plan;
  const json file = read_json(path.string());
  try {
    for (const json& room : file.at("rooms")) {
      const std::string label = room.at("label").get<std::string>();
      plan.push_back(polyline(label.empty() ? "room" : label, true, room.at("outline")));
      for (const json& hole : room.at("holes")) plan.push_back(polyline("hole", true, hole));
    }
    for (const char* list : {"walls", "doors"})
      for (const json& part : file.at(list))
        plan.push_back(polyline(std::string(list) == "walls" ? "wall" : "door", false,
                                json::array({part.at("a"), part.at("b")})));
  } catch (const json::exception& error) {
    throw FileError(path.string(), std::string("is no floor plan: ") + error.what());
  }
  return plan;
}

json describe_pictures(const std::string& folder) {
  constexpr std::uintmax_t kMostBytes = 4'000'000;
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ".svg" &&
        entry.file_size() <= kMostBytes)
      paths.push_back(entry.path());
  std::ranges::sort(paths);
  json pictures = json::array();
  for (const fs::path& path : paths)
    pictures.push_back(
        {{"title", path.stem().string()}, {"caption", path.string()}, {"svg", content_of(path)}});
  return pictures;
}

}  // namespace placegraph::apps
