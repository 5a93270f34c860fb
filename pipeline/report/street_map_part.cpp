#include <placegraph/pipeline/report/street_map_part.h>

#include <placegraph/graph/core/median.h>
#include <placegraph/graph/image/png_codec.h>
#include <placegraph/io/exports/base64.h>
#include <placegraph/io/scene/street_map_file.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include <placegraph/pipeline/report/parts.h>
#include <placegraph/pipeline/report/tables/column.h>

namespace placegraph::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The squares of the lattice under a top view.
struct Lattice {
  int columns = 0, rows = 0;                  ///< squares along x and z
  std::vector<std::vector<double>> ground_y;  ///< y of the ground below its cells, plan frame

  const std::vector<double>* at(int column, int row) const {
    const bool inside = column >= 0 && row >= 0 && column < columns && row < rows;
    return inside ? &ground_y[static_cast<std::size_t>(row * columns + column)] : nullptr;
  }
};

const StreetCell* cell_at(const StreetMap& map, const TopView& view, int column, int row) {
  const int cell = view.at(column, row);
  return cell < 0 ? nullptr : &map.cells[static_cast<std::size_t>(cell)];
}

Lattice lattice_of(const StreetMap& map, const TopView& view) {
  Lattice lattice;
  lattice.columns = (view.columns + kStreetTile - 1) / kStreetTile;
  lattice.rows = (view.rows + kStreetTile - 1) / kStreetTile;
  lattice.ground_y.resize(static_cast<std::size_t>(lattice.columns * lattice.rows));
  for (int row = 0; row < view.rows; ++row)
    for (int column = 0; column < view.columns; ++column)
      if (const StreetCell* cell = cell_at(map, view, column, row)) {
        const int tile = (row / kStreetTile) * lattice.columns + column / kStreetTile;
        lattice.ground_y[static_cast<std::size_t>(tile)].push_back(
            static_cast<double>(cell->mean.y() + cell->height_m));
      }
  return lattice;
}

/// Corners of the squares in the map; not a number where no square beside one has a cell.
json corners(const StreetMap& map, const TopView& view, const Lattice& lattice) {
  std::vector<double> ground_y;
  for (const std::vector<double>& heights : lattice.ground_y)
    ground_y.push_back(heights.empty() ? double{kUnknown} : median_of(heights));
  const Eigen::Matrix3d R_map_plan = map.R_plan_map.inverse().matrix();
  std::vector<float> positions;
  for (int row = 0; row <= lattice.rows; ++row)
    for (int column = 0; column <= lattice.columns; ++column) {
      double sum = 0;
      int count = 0;
      for (const auto& [c, r] :
           {std::pair(column - 1, row - 1), {column, row - 1}, {column - 1, row}, {column, row}})
        if (const auto* heights = lattice.at(c, r); heights && !heights->empty()) {
          sum += ground_y[static_cast<std::size_t>(r * lattice.columns + c)];
          ++count;
        }
      const Eigen::Vector2d at =
          map.cell_m * (view.low + kStreetTile * Eigen::Vector2i(column, row)).cast<double>();
      const Eigen::Vector3d p =
          R_map_plan * Eigen::Vector3d(at.x(), count > 0 ? sum / count : double{kUnknown}, at.y());
      for (int i = 0; i < 3; ++i) positions.push_back(static_cast<float>(p[i]));
    }
  return column(positions, 3);
}

/// Blue, green, red and opacity of every column of cells, x to the right and z down.
Image picture_of(const StreetMap& map, const TopView& view, const Lattice& lattice) {
  Image image(lattice.rows * kStreetTile, lattice.columns * kStreetTile, CV_8UC4,
              cv::Scalar(0, 0, 0, 0));
  for (int row = 0; row < view.rows; ++row)
    for (int column = 0; column < view.columns; ++column)
      if (const StreetCell* cell = cell_at(map, view, column, row)) {
        const auto rgb =
            class_colour(map.classes[static_cast<std::size_t>(*cell->label)], *cell->label);
        image.at<cv::Vec4b>(row, column) = {rgb[2], rgb[1], rgb[0], 255};
      }
  return image;
}

/// The classes that the view shows, with the area that each has in it.
json classes_of(const StreetMap& map, const TopView& view) {
  std::vector<int> columns(map.classes.size());
  for (const int cell : view.cell)
    if (cell >= 0)
      ++columns[static_cast<std::size_t>(*map.cells[static_cast<std::size_t>(cell)].label)];
  json classes = json::array();
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c] > 0)
      classes.push_back({{"name", map.classes[c]},
                         {"rgb", class_colour(map.classes[c], static_cast<int>(c))},
                         {"area_m2", columns[c] * map.cell_m * map.cell_m}});
  return classes;
}

}  // namespace

json describe_street_map(const StreetMap& map) {
  const TopView view = top_view(map);
  if (view.columns == 0 || view.rows == 0) return {};
  const Lattice lattice = lattice_of(map, view);
  const Image image = picture_of(map, view, lattice);
  const Eigen::Vector2d low = map.cell_m * view.low.cast<double>();
  std::vector<float> R_plan_map;
  for (int i = 0; i < 9; ++i)
    R_plan_map.push_back(static_cast<float>(map.R_plan_map.matrix()(i / 3, i % 3)));
  return {{"image", "data:image/png;base64," + to_base64(encode_png(image, {6, false}))},
          {"width", image.cols},
          {"height", image.rows},
          {"cell_m", map.cell_m},
          {"low_m", {low.x(), low.y()}},
          {"R_plan_map", column(R_plan_map, 3)},
          {"columns", lattice.columns},
          {"rows", lattice.rows},
          {"ground", corners(map, view, lattice)},
          {"classes", classes_of(map, view)}};
}

std::optional<StreetMap> street_map_in(const std::string& folder) {
  const fs::path path = fs::path(folder) / "semantic_map.ply";
  if (!fs::is_regular_file(path) || fs::exists(fs::path(folder) / "semantic_map.geojson"))
    return std::nullopt;
  return read_street_map(path.string());
}

}  // namespace placegraph::report
