#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/png_codec.h>
#include <placegraph/io/config/yaml_document.h>
#include <placegraph/io/exports/base64.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/scene/ground_picture_file.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;

constexpr int kMostGroundSide_px = 1600;  ///< chosen: twice the largest panel
constexpr uchar kFreeGrey = 255, kUnknownGrey = 215, kOccupiedGrey = 70;

/// Puts the pixels into the picture, which knows its place, as many as a plot can show.
void take_pixels(const Image& image, GroundPicture& picture) {
  const double factor =
      std::max(1.0, static_cast<double>(std::max(image.cols, image.rows)) / kMostGroundSide_px);
  picture.columns = std::max(1, static_cast<int>(std::lround(image.cols / factor)));
  picture.rows = std::max(1, static_cast<int>(std::lround(image.rows / factor)));
  picture.right_m *= static_cast<double>(image.cols) / picture.columns;
  picture.down_m *= static_cast<double>(image.rows) / picture.rows;
  Image small = image;
  if (factor > 1) cv::resize(image, small, {picture.columns, picture.rows}, 0, 0, cv::INTER_AREA);
  picture.source = "data:image/png;base64," + to_base64(encode_png(small, {6, false}));
}

/// How a map_server says cells apart.
struct GridThresholds {
  bool negate = false;
  double occupied = 0.65, free = 0.25;  ///< those of map_server
  std::string mode = "trinary";
};

bool negate_of(const YamlDocument& document) {
  const YAML::Node node = document.member(document.root(), "negate");
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  if (text == "1" || text == "true") return true;
  if (text != "0" && text != "false") document.fail(node, "negate: is neither 0 nor 1");
  return false;
}

GridThresholds thresholds_of(const YamlDocument& document) {
  GridThresholds result;
  result.negate = negate_of(document);
  const auto occupied = document.optional_number(document.root(), "occupied_thresh"),
             free = document.optional_number(document.root(), "free_thresh");
  result.occupied = occupied.value_or(result.occupied);
  result.free = free.value_or(result.free);
  if (!(result.free >= 0 && result.free < result.occupied && result.occupied <= 1))
    document.fail(document.root(),
                  "free_thresh and occupied_thresh are not 0 <= free < occupied "
                  "<= 1");
  const YAML::Node mode = document.root()["mode"];
  if (mode.IsDefined()) result.mode = document.text(document.root(), "mode");
  if (result.mode != "trinary" && result.mode != "scale" && result.mode != "raw")
    document.fail(mode, "mode: is none of trinary, scale, raw");
  return result;
}

/// The grey in which a cell is shown.
uchar shown_grey(uchar value, const GridThresholds& thresholds) {
  if (thresholds.mode == "raw")  // percent of being occupied; what is above is unknown
    return value > 100 ? kUnknownGrey
                       : static_cast<uchar>(kFreeGrey - value * (kFreeGrey - kOccupiedGrey) / 100);
  const double occupied = (thresholds.negate ? value : 255 - value) / 255.0;
  if (occupied > thresholds.occupied) return kOccupiedGrey;
  if (occupied < thresholds.free) return kFreeGrey;
  if (thresholds.mode == "trinary") return kUnknownGrey;
  const double share = (occupied - thresholds.free) / (thresholds.occupied - thresholds.free);
  return static_cast<uchar>(std::lround(kFreeGrey - share * (kFreeGrey - kOccupiedGrey)));
}

GroundPicture occupancy_picture(const std::string& path) {
  const YamlDocument document(path);
  if (!document.root().IsMap()) throw FileError(path, "is no description of a map");
  const double cell_m = document.number(document.root(), "resolution");
  if (!(cell_m > 0))
    document.fail(document.member(document.root(), "resolution"), "resolution: is not above 0");
  const std::vector<double> origin = document.numbers(document.root(), "origin", 3);
  const GridThresholds thresholds = thresholds_of(document);
  const fs::path image = document.text(document.root(), "image");
  Image grey = read_image((fs::path(path).parent_path() / image).string()).grey.clone();
  for (int row = 0; row < grey.rows; ++row)
    for (int column = 0; column < grey.cols; ++column)
      grey.at<uchar>(row, column) = shown_grey(grey.at<uchar>(row, column), thresholds);
  GroundPicture picture;
  const Vector2d along(std::cos(origin[2]), std::sin(origin[2])), up(-along[1], along[0]);
  picture.right_m = cell_m * along;
  picture.down_m = -cell_m * up;
  picture.corner_m = Vector2d(origin[0], origin[1]) + grey.rows * cell_m * up;
  take_pixels(grey, picture);
  return picture;
}

/// The world file beside a picture: its first and last letter of the ending and a w, or .wld.
std::string world_file_of(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  std::vector<std::string> candidates;
  if (ending.size() >= 4) candidates.push_back(std::string(".") + ending[1] + ending.back() + "w");
  candidates.push_back(ending + "w");
  candidates.emplace_back(".wld");
  std::string names;
  for (const std::string& candidate : candidates) {
    const std::string file = fs::path(path).replace_extension(candidate).string();
    if (fs::exists(file)) return file;
    names += (names.empty() ? "" : ", ") + file;
  }
  throw FileError(path, "has no world file beside it (" + names + ") and no corners are given");
}

void place_by_world_file(const std::string& path, GroundPicture& picture) {
  TextFile file(path);
  double values[6];
  std::string_view line;
  for (double& value : values) {
    if (!file.next_data(line)) throw FileError(path, "has fewer than six numbers");
    std::vector<std::string_view> fields;
    split_blank(line, fields);
    if (fields.size() != 1) file.fail("expected one number a line");
    value = file.number(fields[0], "number");
  }
  picture.right_m = {values[0], values[1]};
  picture.down_m = {values[2], values[3]};
  Eigen::Matrix2d axes;
  axes << picture.right_m, picture.down_m;
  if (axes.determinant() == 0) throw FileError(path, "its pixels have no extent");
  // The last two are the centre of the first pixel.
  picture.corner_m = Vector2d(values[4], values[5]) - 0.5 * (picture.right_m + picture.down_m);
}

void place_by_corners(const std::vector<double>& corners_m, const Image& image,
                      GroundPicture& picture) {
  require(corners_m.size() == 4 && corners_m[0] < corners_m[2] && corners_m[1] < corners_m[3],
          "corners of a map: are not x,y of the lower left and then of the upper right one");
  picture.corner_m = {corners_m[0], corners_m[3]};
  picture.right_m = {(corners_m[2] - corners_m[0]) / image.cols, 0};
  picture.down_m = {0, (corners_m[1] - corners_m[3]) / image.rows};
}

}  // namespace

GroundPicture read_ground_picture(const std::string& path, const std::vector<double>& corners_m) {
  const std::string ending = fs::path(path).extension().string();
  GroundPicture picture;
  if (ending == ".yaml" || ending == ".yml") {
    require(corners_m.empty(), path + ": an occupancy grid has its origin; it takes no corners");
    picture = occupancy_picture(path);
  } else {
    const GreyAndColour image = read_image(path);
    const Image& pixels = image.colour.empty() ? image.grey : image.colour;
    if (corners_m.empty())
      place_by_world_file(world_file_of(path), picture);
    else
      place_by_corners(corners_m, pixels, picture);
    take_pixels(pixels, picture);
  }
  picture.name = fs::path(path).filename().string();
  return picture;
}

}  // namespace placegraph
