#include <fmt/format.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/files/name_order.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/loops/delimited_table.h>
#include <placegraph/io/loops/image_set.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <set>

namespace placegraph {
namespace {

namespace fs = std::filesystem;

/// What is known of where an image was taken.
struct ImagePlace {
  std::optional<double> x, y, z;           ///< [m]
  std::optional<double> latitude, longitude, heading;  ///< [deg]
  std::optional<int> zone;                 ///< of UTM
  char letter = 'N';                       ///< of its latitude band
};

/// Gathers the places of images, all known in the same way.
class PlaceList {
 public:
  explicit PlaceList(std::string path) : path_(std::move(path)) {}

  void add(const ImagePlace& place, int line) {
    const auto fail = [&](const std::string& what) {
      throw line > 0 ? FileError(path_, line, what) : FileError(path_, what);
    };
    const bool geodetic = place.latitude && place.longitude;
    if (!geodetic && !(place.x && place.y)) fail("no position of the image");
    GeodeticPosition position{place.latitude.value_or(0), place.longitude.value_or(0),
                              place.z.value_or(0)};
    try {
      if (geodetic) position.check();
      if (!geodetic && place.zone) position = from_utm(*place.zone, place.letter >= 'N', *place.x, *place.y);
    } catch (const ArgumentError& error) {
      fail(error.what());
    }
    geodetic_ &= geodetic || place.zone;
    metric_ &= place.x && place.y;
    if (place.zone) zones_.insert(fmt::format("{} {}", *place.zone, place.letter >= 'N' ? 'N' : 'S'));
    unzoned_ |= !place.zone;
    if (!metric_ && !geodetic_) fail("a position in other coordinates than those before");
    positions_.push_back(position);
    positions_m_.emplace_back(place.x.value_or(0), place.y.value_or(0), place.z.value_or(0));
    headings_.push_back(place.heading);
  }

  /// Fills in poses and positions.
  void give(ImageSet& set) const {
    const bool one_zone = zones_.size() == 1 && !unzoned_;
    const bool metres = metric_ && (one_zone || !geodetic_);
    if (geodetic_) set.positions = positions_;
    if (metres && one_zone) set.zone = *zones_.begin();
    Trajectory& poses = set.poses;
    poses.has_times = false;
    poses.has_orientation = std::all_of(headings_.begin(), headings_.end(),
                                        [](const auto& heading) { return heading.has_value(); });
    for (std::size_t i = 0; i < positions_m_.size(); ++i) {
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      if (metres) T.translation() = positions_m_[i];
      if (poses.has_orientation)  // clockwise from north; the angle about z is the other way round
        T.linear() = Eigen::AngleAxisd(-deg_to_rad(*headings_[i]), Eigen::Vector3d::UnitZ()).matrix();
      poses.poses.push_back({static_cast<std::int64_t>(i), T});
    }
    set.form = set.zone.empty() ? (metres ? "positions [m]" : "latitudes and longitudes")
                                : "UTM coordinates of zone " + set.zone;
    if (!metres && zones_.size() > 1) set.form = "UTM coordinates of several zones";
    if (poses.has_orientation) set.form += " with headings";
  }

 private:
  std::string path_;
  std::vector<GeodeticPosition> positions_;
  std::vector<Eigen::Vector3d> positions_m_;
  std::vector<std::optional<double>> headings_;
  std::set<std::string> zones_;
  bool geodetic_ = true, metric_ = true, unzoned_ = false;
};

std::optional<double> finite(std::string_view field) {
  const auto value = parse_double(field);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// The place in a name `.../@ east @ north @ zone @ letter @ latitude @ longitude @ pano @ tile @
/// heading @ ...`; nothing if the name has none.
std::optional<ImagePlace> place_of_name(std::string_view name) {
  const std::size_t begin = name.find('@');
  if (begin == std::string_view::npos) return std::nullopt;
  std::vector<std::string_view> fields;
  split_at('@', name.substr(begin + 1), fields);
  if (fields.size() < 3) return std::nullopt;  // the last is the end of the name
  const auto field = [&](std::size_t i) { return i + 1 < fields.size() ? finite(fields[i]) : std::nullopt; };
  ImagePlace place;
  place.x = field(0);
  place.y = field(1);
  if (const auto zone = field(2); zone && *zone >= 1 && *zone <= 60 && fields.size() > 4 && fields[3].size() == 1) {
    place.zone = static_cast<int>(*zone);
    place.letter = fields[3].front();
  }
  place.latitude = field(4);
  place.longitude = field(5);
  place.heading = field(8);
  if (!place.latitude || !place.longitude) place.latitude = place.longitude = std::nullopt;
  if (!(place.x && place.y) && !place.latitude) return std::nullopt;
  return place;
}

/// Names, with their places where all names have one.
ImageSet set_of_names(std::vector<std::string> names, const std::string& path) {
  ImageSet set;
  set.form = "names of images";
  PlaceList places(path);
  std::size_t placed = 0;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const auto place = place_of_name(names[i])) {
      places.add(*place, static_cast<int>(i) + 1);
      ++placed;
    }
  if (placed > 0 && placed < names.size())
    throw FileError(path, fmt::format("{} of {} names of images have a position (@ east @ north @ ...)",
                                      placed, names.size()));
  set.names = std::move(names);
  if (placed == 0) return set;
  places.give(set);
  set.form = "names of images with " + set.form;
  return set;
}

std::vector<std::string> images_below(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && has_image_extension(entry.path().string()))
      names.push_back(fs::relative(entry.path(), folder).string());
  if (names.empty()) throw FileError(folder, "has no images");
  sort_by_name(names);
  return names;
}

using Columns = std::initializer_list<std::string_view>;
std::optional<std::size_t> column(const std::vector<std::string>& header, Columns names) {
  for (const std::string_view name : names)
    if (const auto at = std::find(header.begin(), header.end(), name); at != header.end())
      return static_cast<std::size_t>(at - header.begin());
  return std::nullopt;
}

bool names_a_place(const std::string& field) {
  return column({field}, {"latitude", "lat", "easting", "utm_east", "utm_easting"}).has_value();
}

bool has_place_header(const std::string& path) {
  return !DelimitedTable(path, names_a_place).header().empty();
}

/// A table under a header that names latitude and longitude, or east and north.
ImageSet read_place_table(const std::string& path) {
  DelimitedTable table(path, names_a_place);
  const std::vector<std::string>& header = table.header();
  const auto name = column(header, {"image", "name", "filename", "file", "key", "path"});
  const auto x = column(header, {"easting", "utm_east", "utm_easting", "x"});
  const auto y = column(header, {"northing", "utm_north", "utm_northing", "y"});
  const auto latitude = column(header, {"latitude", "lat"});
  const auto longitude = column(header, {"longitude", "lon", "lng", "long"});
  const auto heading = column(header, {"heading", "compass", "compass_angle", "ca", "yaw", "bearing"});
  const auto height = column(header, {"height", "altitude", "alt", "z"});
  ImageSet set;
  PlaceList places(path);
  std::vector<std::string_view> fields;
  while (table.next(fields)) {
    const auto number = [&](const std::optional<std::size_t>& at) -> std::optional<double> {
      if (!at) return std::nullopt;
      return table.file().number(fields[*at], header[*at].c_str());
    };
    ImagePlace place;
    place.x = number(x);
    place.y = number(y);
    place.z = number(height);
    place.latitude = number(latitude);
    place.longitude = number(longitude);
    place.heading = number(heading);
    places.add(place, table.file().line());
    if (name) set.names.emplace_back(fields[*name]);
  }
  places.give(set);
  return set;
}

/// Two columns without a header: metres, or latitude and longitude.
ImageSet read_pairs(const std::string& path) {
  DelimitedTable table(path);
  std::vector<Eigen::Vector2d> rows;
  std::vector<std::string_view> fields;
  bool degrees = true;
  while (table.next(fields)) {
    if (fields.size() != 2) table.file().fail(fmt::format("{} columns, and 2 before", fields.size()));
    rows.emplace_back(table.file().number(fields[0], "x"), table.file().number(fields[1], "y"));
    degrees &= std::abs(rows.back()[0]) <= 90 && std::abs(rows.back()[1]) <= 180;
  }
  std::vector<double> steps;
  for (std::size_t i = 1; i < rows.size(); ++i) steps.push_back((rows[i] - rows[i - 1]).norm());
  // Images a kilometre apart, were it degrees; a centimetre, were it metres.
  degrees &= !steps.empty() && median_of(steps) < 0.01;
  ImageSet set;
  PlaceList places(path);
  for (const Eigen::Vector2d& row : rows) {
    ImagePlace place;
    (degrees ? place.latitude : place.x) = row[0];
    (degrees ? place.longitude : place.y) = row[1];
    places.add(place, 0);
  }
  places.give(set);
  return set;
}

/// What the first line of a list looks like.
enum class FirstLine { kNames, kTwoNumbers, kOther };

FirstLine first_line_of(const std::string& path) {
  TextFile file(path);
  std::string_view line;
  if (!file.next_data(line)) throw FileError(path, "no images in it");
  std::vector<std::string_view> fields;
  for (const char separator : {';', ',', '\t', ' '})
    if (separator == ' ' || line.find(separator) != std::string_view::npos) {
      separator == ' ' ? split_blank(line, fields) : split_at(separator, line, fields);
      break;
    }
  const bool is_image = has_image_extension(std::string(line)) || line.find('@') != std::string_view::npos;
  if (is_image && !parse_double(fields.front())) return FirstLine::kNames;
  const bool numbers = std::all_of(fields.begin(), fields.end(),
                                   [](std::string_view field) { return parse_double(field); });
  return numbers && fields.size() == 2 ? FirstLine::kTwoNumbers : FirstLine::kOther;
}

ImageSet read_names(const std::string& path) {
  TextFile file(path);
  std::vector<std::string> names;
  for (std::string_view line; file.next(line);) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) continue;
    names.emplace_back(line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin));
  }
  return set_of_names(std::move(names), path);
}

void place_about(ImageSet& set, const EnuFrame& frame) {
  for (std::size_t i = 0; i < set.positions.size(); ++i)
    set.poses.poses[i].T_world_body->translation() = frame.to_enu(set.positions[i]);
}

}  // namespace

ImageSet read_image_set(const std::string& path) {
  ImageSet set;
  if (fs::is_directory(path)) {
    set = set_of_names(images_below(path), path);
  } else if (has_place_header(path)) {
    set = read_place_table(path);
  } else if (const FirstLine first = first_line_of(path); first == FirstLine::kNames) {
    set = read_names(path);
  } else if (first == FirstLine::kTwoNumbers) {
    set = read_pairs(path);
  } else {
    set.poses = read_trajectory(path, {}, Orientation::kOptional);
    set.form = set.poses.has_orientation ? "poses" : "positions [m]";
  }
  if (!set.positions.empty() && set.zone.empty()) place_about(set, EnuFrame(set.positions.front()));
  return set;
}

void put_in_one_frame(ImageSet& a, ImageSet& b) {
  for (const ImageSet* set : {&a, &b})
    require(set->poses.size() > 0, "the images of a set have no positions (" + set->form + ")");
  if (a.zone == b.zone && !a.zone.empty()) return;
  if (a.positions.empty() && b.positions.empty()) return;
  require(!a.positions.empty() && !b.positions.empty(),
          fmt::format("one set has {}, the other {}: distances between them are unknown", a.form,
                      b.form));
  const EnuFrame frame(a.positions.front());
  place_about(a, frame);
  place_about(b, frame);
}

}  // namespace placegraph
