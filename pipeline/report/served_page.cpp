#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/jpeg_codec.h>
#include <placegraph/io/exports/base64.h>
#include <placegraph/pipeline/map/map_geometry.h>
#include <placegraph/pipeline/report/map_part.h>
#include <placegraph/pipeline/report/run_part.h>
#include <placegraph/pipeline/report/served_page.h>
#include <placegraph/pipeline/report/tables/column.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_map>

namespace placegraph {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kJpegQuality = 90;

std::string text_of(const json& data) {
  return data.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

std::string name_of_run(const std::string& map_path) {
  const fs::path path = fs::absolute(fs::path(map_path)).lexically_normal();
  return path.filename() == "map.db" ? path.parent_path().filename().string()
                                     : path.stem().string();
}

std::string served_runs(const std::string& title, const std::string& program,
                        const std::vector<ServedRun>& runs, const LogSink& log) {
  json described = json::array();
  for (const ServedRun& run : runs) {
    described.push_back(report::describe_run_for_report(*run.stored, run.path, "", log));
    described.back()["name"] = run.name;
  }
  return text_of(report::report_data(title, program, std::move(described)));
}

std::string served_observations(const Map& map, const Keyframe& keyframe) {
  const std::vector<PlacedLandmark> landmarks = geometry_of(map, std::nullopt).landmarks;
  const report::LandmarkRows rows(landmarks.size());
  std::unordered_map<LandmarkId, std::size_t> positions;
  for (std::size_t i = 0; i < landmarks.size(); ++i) positions[landmarks[i].id] = i;
  std::vector<float> points;
  for (const LandmarkObservation& seen : keyframe.observations) {
    const auto found = positions.find(seen.landmark);
    const std::optional<std::size_t> row =
        found == positions.end() ? std::nullopt : rows.row_of(found->second);
    points.push_back(seen.px.x());
    points.push_back(seen.px.y());
    points.push_back(row ? static_cast<float>(*row) : -1.0F);
  }
  return text_of({{"points", report::column(points, 3)}});
}

std::string column_json(const std::vector<float>& values, int width) {
  return report::column(values, width).dump();
}
std::string column_json(const std::vector<std::int32_t>& values, int width) {
  return report::column(values, width).dump();
}
std::string column_json(const std::vector<std::uint8_t>& values, int width) {
  return report::column(values, width).dump();
}

std::string text_column_json(const std::vector<std::string>& texts) {
  return text_of(report::text_column(texts));
}

std::string jpeg_url(const Image& image) {
  return "data:image/jpeg;base64," + to_base64(jpeg_of_page(image));
}

std::string jpeg_of_page(const Image& image) { return encode_jpeg(image, kJpegQuality); }

}  // namespace placegraph
