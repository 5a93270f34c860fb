#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/scene/street_map_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

namespace placegraph {
namespace {

using nlohmann::ordered_json;

template <class T>
void put(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

template <class T>
T take(const char*& at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  at += sizeof(T);
  return value;
}

constexpr const char* kProperties =
    "property float x\nproperty float y\nproperty float z\nproperty uchar red\n"
    "property uchar green\nproperty uchar blue\nproperty uchar label\n"
    "property float confidence\nproperty float height\nproperty float weight\n"
    "property ushort sights\n";
constexpr std::size_t kVertexBytes = 3 * 4 + 4 + 3 * 4 + 2;

struct MapHeader {
  std::int64_t cells = -1;
  std::size_t body = 0;
};

double number_of(const std::string& path, const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != 0 || !std::isfinite(value))
    throw FileError(path, "'" + word + "' is not a number");
  return value;
}

MapHeader read_header(const std::string& path, const std::string& bytes, StreetMap& map) {
  MapHeader header;
  std::string properties;
  const std::size_t end = bytes.find("end_header\n");
  if (bytes.compare(0, 4, "ply\n") != 0 || end == std::string::npos || end > (1U << 16))
    throw FileError(path, "is not a street map: no PLY header");
  header.body = end + std::strlen("end_header\n");
  std::istringstream lines(bytes.substr(0, end));
  bool binary = false, has_rotation = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream stream(line);
    const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
    if (words.empty()) continue;
    if (line == "format binary_little_endian 1.0") binary = true;
    if (words[0] == "property") properties += line + "\n";
    if (words.size() == 3 && words[0] == "element" && words[1] == "vertex")
      header.cells = static_cast<std::int64_t>(number_of(path, words[2]));
    if (words.size() < 3 || words[0] != "comment") continue;
    if (words[1] == "class" && words.size() == 4) map.classes.push_back(words[3]);
    if (words[1] == "cell_m") map.cell_m = number_of(path, words[2]);
    if (words[1] == "R_plan_map" && words.size() == 11) {
      Eigen::Matrix3d R;
      for (int i = 0; i < 9; ++i)
        R(i / 3, i % 3) = number_of(path, words[static_cast<std::size_t>(i) + 2]);
      if (!(R * R.transpose()).isIdentity(1e-4))
        throw FileError(path, "R_plan_map: not a rotation");
      map.R_plan_map = SO3(Eigen::Quaterniond(R).normalized());
      has_rotation = true;
    }
  }
  if (!binary || properties != kProperties || header.cells < 0 || map.classes.size() < 2 ||
      !has_rotation || !(map.cell_m > 0))
    throw FileError(path, "is not a street map of placegraph");
  return header;
}

/// Converts a position to the frame of the map.
Eigen::Vector3d place_of(const StreetMap& map, const Eigen::Vector3d& p_plan) {
  return map.R_plan_map.inverse().matrix() * p_plan;
}

double rounded(double value, double digits) { return std::round(digits * value) / digits; }

}  // namespace

std::string to_ply(const StreetMap& map) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\n";
  for (std::size_t i = 0; i < map.classes.size(); ++i)
    bytes += fmt::format("comment class {} {}\n", i, map.classes[i]);
  bytes += fmt::format("comment cell_m {}\ncomment R_plan_map", map.cell_m);
  const Eigen::Matrix3d R = map.R_plan_map.matrix();
  for (int i = 0; i < 9; ++i) bytes += fmt::format(" {:.9f}", R(i / 3, i % 3));
  const auto known =
      std::count_if(map.cells.begin(), map.cells.end(), [](const auto& c) { return c.label >= 0; });
  bytes += fmt::format("\nelement vertex {}\n{}end_header\n", known, kProperties);
  for (const StreetCell& cell : map.cells) {
    if (!cell.label) continue;
    const Eigen::Vector3f p = place_of(map, cell.mean.cast<double>()).cast<float>();
    for (int i = 0; i < 3; ++i) put(bytes, p[i]);
    for (const std::uint8_t c :
         class_colour(map.classes[static_cast<std::size_t>(*cell.label)], *cell.label))
      put(bytes, c);
    put(bytes, static_cast<std::uint8_t>(*cell.label));
    put(bytes, cell.confidence);
    put(bytes, cell.height_m);
    put(bytes, cell.weight);
    put(bytes, static_cast<std::uint16_t>(std::min(cell.observations, 65535)));
  }
  return bytes;
}

StreetMap read_street_map(const std::string& path) {
  require_input_file(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path, "cannot be read");
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  StreetMap map;
  const MapHeader header = read_header(path, bytes, map);
  if ((bytes.size() - header.body) / kVertexBytes != static_cast<std::size_t>(header.cells) ||
      (bytes.size() - header.body) % kVertexBytes != 0)
    throw FileError(
        path, fmt::format("holds {} bytes of cells, {} cells are {}", bytes.size() - header.body,
                          header.cells, static_cast<std::size_t>(header.cells) * kVertexBytes));
  map.outcome = Outcome::ok();
  const char* at = bytes.data() + header.body;
  for (std::int64_t i = 0; i < header.cells; ++i) {
    StreetCell cell;
    Eigen::Vector3f p;
    for (int k = 0; k < 3; ++k) p[k] = take<float>(at);
    at += 3;  // the class determines the colour
    cell.label = take<std::uint8_t>(at);
    cell.confidence = take<float>(at);
    cell.height_m = take<float>(at);
    cell.weight = take<float>(at);
    cell.observations = take<std::uint16_t>(at);
    const Eigen::Vector3d p_plan = map.R_plan_map.matrix() * p.cast<double>();
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e6F || *cell.label >= map.class_count() ||
        !(cell.confidence >= 0 && cell.confidence <= 1) || !std::isfinite(cell.height_m) ||
        !std::isfinite(cell.weight))
      throw FileError(path, fmt::format("cell {} has an impossible value", i));
    cell.mean = p_plan.cast<float>();
    cell.at = (p_plan / map.cell_m).array().floor().cast<int>();
    map.cells.push_back(cell);
  }
  return map;
}

std::string to_json(const StreetMap& map,
                    const std::vector<std::pair<PlaceId, std::vector<float>>>& shares) {
  ordered_json document;
  document["units"] = "m";
  document["frame"] =
      "cells are cubes of the plan frame: the map's, turned by R_plan_map so that y points down";
  document["cell_m"] = map.cell_m;
  const Eigen::Matrix3d R = map.R_plan_map.matrix();
  document["R_plan_map"] = ordered_json::array();
  for (int i = 0; i < 3; ++i)
    document["R_plan_map"].push_back(ordered_json::array({R(i, 0), R(i, 1), R(i, 2)}));
  std::vector<std::int64_t> cells(map.classes.size(), 0), columns = cells;
  std::int64_t unknown = 0;
  for (const StreetCell& cell : map.cells)
    ++(cell.label ? cells[static_cast<std::size_t>(*cell.label)] : unknown);
  for (const int cell : top_view(map).cell)
    if (cell >= 0)
      ++columns[static_cast<std::size_t>(*map.cells[static_cast<std::size_t>(cell)].label)];
  document["unknown_cells"] = unknown;
  document["classes"] = ordered_json::array();
  for (std::size_t c = 0; c < map.classes.size(); ++c)
    document["classes"].push_back(
        {{"name", map.classes[c]},
         {"colour", class_colour(map.classes[c], static_cast<int>(c))},
         {"cells", cells[c]},
         {"area_m2", rounded(static_cast<double>(columns[c]) * map.cell_m * map.cell_m, 1e2)}});
  document["places"] = ordered_json::array();
  for (const auto& [place, of] : shares) {
    if (of.empty()) continue;
    ordered_json shares_by_class;
    for (std::size_t c = 0; c < of.size(); ++c)
      shares_by_class[map.classes[c]] = rounded(static_cast<double>(of[c]), 1e4);
    document["places"].push_back({{"place", place}, {"shares", shares_by_class}});
  }
  return document.dump(1) + "\n";
}

namespace {

using Ring = std::vector<Eigen::Vector2i>;

/// Patches of one class in a top view, connected by their sides; each has its rings, the outer
/// first.
class Patches {
 public:
  Patches(int columns, int rows, std::vector<int> labels)
      : columns_(columns), rows_(rows), labels_(std::move(labels)), patch_(labels_.size(), -1) {}

  /// Calls f(label, cells, rings) for each of the next patches.
  template <class F>
  void for_each(const F& f) {
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        const std::size_t i = index(column, row);
        if (labels_[i] < 0 || patch_[i] >= 0) continue;
        const std::vector<Eigen::Vector2i> cells = fill(column, row);
        f(labels_[i], cells.size(), rings(cells));
        ++count_;
      }
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  bool contains(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_ &&
           patch_[index(column, row)] == count_;
  }

  std::vector<Eigen::Vector2i> fill(int column, int row) {
    const int label = labels_[index(column, row)];
    std::vector<Eigen::Vector2i> cells{{column, row}};
    patch_[index(column, row)] = count_;
    for (std::size_t k = 0; k < cells.size(); ++k)
      for (const Eigen::Vector2i& step : kSteps) {
        const Eigen::Vector2i next = cells[k] + step;
        if (next[0] < 0 || next[1] < 0 || next[0] >= columns_ || next[1] >= rows_) continue;
        const std::size_t i = index(next[0], next[1]);
        if (labels_[i] != label || patch_[i] >= 0) continue;
        patch_[i] = count_;
        cells.push_back(next);
      }
    return cells;
  }

  /// Sides of cells with the patch on their left, joined to rings; where two rings meet in a
  /// corner, the ring continues along its cell.
  std::vector<Ring> rings(const std::vector<Eigen::Vector2i>& cells) const {
    std::map<std::array<int, 2>, std::vector<int>> sides;  // directions by start point
    for (const Eigen::Vector2i& cell : cells)
      for (int d = 0; d < 4; ++d) {
        const Eigen::Vector2i& out = kSteps[static_cast<std::size_t>((d + 3) % 4)];
        if (contains(cell[0] + out[0], cell[1] + out[1])) continue;
        const Eigen::Vector2i from = cell + kCorners[static_cast<std::size_t>(d)];
        sides[{from[0], from[1]}].push_back(d);
      }
    std::vector<Ring> all;
    while (!sides.empty()) {
      Ring ring;
      Eigen::Vector2i at(sides.begin()->first[0], sides.begin()->first[1]);
      int direction = sides.begin()->second.front();
      for (auto here = sides.find({at[0], at[1]}); here != sides.end();
           here = sides.find({at[0], at[1]})) {
        std::vector<int>& choices = here->second;
        auto next = std::find(choices.begin(), choices.end(), (direction + 1) % 4);
        if (next == choices.end() || ring.empty()) next = choices.begin();
        if (ring.empty() || *next != direction) ring.push_back(at);
        direction = *next;
        choices.erase(next);
        if (choices.empty()) sides.erase(here);
        at += kSteps[static_cast<std::size_t>(direction)];
        if (at == ring.front()) break;
      }
      all.push_back(std::move(ring));
    }
    const auto outer =
        std::find_if(all.begin(), all.end(), [](const Ring& r) { return is_outer_ring(r); });
    if (outer != all.end()) std::iter_swap(all.begin(), outer);
    return all;
  }

  /// Whether a ring is counter-clockwise.
  static bool is_outer_ring(const Ring& ring) {
    std::int64_t area = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2i &a = ring[i], &b = ring[(i + 1) % ring.size()];
      area += std::int64_t{a[0]} * b[1] - std::int64_t{b[0]} * a[1];
    }
    return area > 0;
  }

  static inline const std::array<Eigen::Vector2i, 4> kSteps = {
      Eigen::Vector2i(1, 0), Eigen::Vector2i(0, 1), Eigen::Vector2i(-1, 0), Eigen::Vector2i(0, -1)};
  /// Start corner of the side of a cell in each direction, with the cell on its left.
  static inline const std::array<Eigen::Vector2i, 4> kCorners = {
      Eigen::Vector2i(0, 0), Eigen::Vector2i(1, 0), Eigen::Vector2i(1, 1), Eigen::Vector2i(0, 1)};
  int columns_, rows_, count_ = 0;
  std::vector<int> labels_, patch_;
};

}  // namespace

std::string to_geojson(const StreetMap& map, const GeodeticPosition& origin, double min_area_m2) {
  const EnuFrame frame(origin);
  const TopView view = top_view(map);
  std::vector<int> labels;
  double height = 0;
  std::size_t count = 0;
  for (const int cell : view.cell) {
    labels.push_back(cell < 0 ? -1 : *map.cells[static_cast<std::size_t>(cell)].label);
    if (cell < 0) continue;
    height += static_cast<double>(map.cells[static_cast<std::size_t>(cell)].mean[1]);
    ++count;
  }
  if (count > 0) height /= static_cast<double>(count);
  const auto position = [&](const Eigen::Vector2i& corner) {
    const Eigen::Vector3d p((view.low[0] + corner[0]) * view.cell_m, height,
                            (view.low[1] + corner[1]) * view.cell_m);
    const GeodeticPosition at = frame.to_geodetic(place_of(map, p));
    return ordered_json::array({rounded(at.longitude_deg, 1e8), rounded(at.latitude_deg, 1e8)});
  };
  std::vector<ordered_json> polygons(map.classes.size(), ordered_json::array());
  std::vector<double> area(map.classes.size(), 0);
  Patches patches(view.columns, view.rows, std::move(labels));
  patches.for_each([&](int label, std::size_t cells, const std::vector<Ring>& rings) {
    const double of = static_cast<double>(cells) * view.cell_m * view.cell_m;
    if (of < min_area_m2) return;
    area[static_cast<std::size_t>(label)] += of;
    ordered_json polygon = ordered_json::array();
    for (const Ring& ring : rings) {
      ordered_json points = ordered_json::array();
      for (const Eigen::Vector2i& corner : ring) points.push_back(position(corner));
      points.push_back(points.front());
      polygon.push_back(std::move(points));
    }
    polygons[static_cast<std::size_t>(label)].push_back(std::move(polygon));
  });
  ordered_json features = ordered_json::array();
  for (std::size_t c = 0; c < map.classes.size(); ++c) {
    if (polygons[c].empty()) continue;
    const auto rgb = class_colour(map.classes[c], static_cast<int>(c));
    features.push_back(
        {{"type", "Feature"},
         {"properties",
          {{"class", map.classes[c]},
           {"area_m2", rounded(area[c], 1e2)},
           {"colour", fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2])}}},
         {"geometry", {{"type", "MultiPolygon"}, {"coordinates", std::move(polygons[c])}}}});
  }
  const ordered_json document = {
      {"type", "FeatureCollection"},
      {"placegraph", {{"origin", {origin.longitude_deg, origin.latitude_deg, origin.height_m}}}},
      {"features", std::move(features)}};
  return document.dump() + "\n";
}

}  // namespace placegraph
