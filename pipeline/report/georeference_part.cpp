#include <placegraph/pipeline/report/georeference_part.h>

#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/geodesy.h>
#include <placegraph/io/files/json_file.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include <placegraph/pipeline/report/tables/column.h>
#include <placegraph/pipeline/results/georeference_reader.h>

namespace placegraph::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFile = "georeference.json";

}  // namespace

std::string georeference_of(const std::string& folder) {
  for (const fs::path& candidate : {fs::path(folder), fs::path(folder) / "georeference"})
    if (fs::is_regular_file(candidate / kFile)) return candidate.string();
  return {};
}

json describe_georeference(const std::string& folder, const Map& map) {
  const Georeference earth = read_georeference(folder, map);
  const EnuFrame enu(earth.origin);
  std::vector<double> track;
  bool any = false;
  for (const FrameRecord& frame : map.frames) {
    const std::optional<SE3> T_enu_cam = earth.at(frame.stamp_ns);
    any = any || T_enu_cam;
    if (!T_enu_cam) {
      track.insert(track.end(), 3, std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const GeodeticPosition at = enu.to_geodetic(T_enu_cam->translation());
    for (const double value : {at.latitude_deg, at.longitude_deg, at.height_m})
      track.push_back(value);
  }
  const std::string path = (fs::path(folder) / kFile).string();
  if (!any) throw FileError(path, "is of another map: no frame has its times");
  json result = {{"latitude_deg", earth.origin.latitude_deg},
                 {"longitude_deg", earth.origin.longitude_deg},
                 {"folder", folder},
                 {"track", column(track, 3)}};
  const json file = read_json(path);
  for (const char* name : {"residual_rms_m", "fixes_used", "fixes_rejected"})
    result[name] = file.contains(name) && file[name].is_number() ? file[name] : json();
  return result;
}

}  // namespace placegraph::report
