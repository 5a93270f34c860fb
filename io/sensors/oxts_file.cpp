#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/sensors/oxts_file.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

/// The used fields of a reading, by position.
enum Field { kLat, kLon, kAlt, kRoll, kPitch, kYaw, kForward = 8, kLeft, kUp, kAccuracy = 23 };
constexpr std::size_t kFields = 30;

/// Parses the reading on the last line.
GpsFix parse_reading(const TextFile& file, std::string_view line) {
  std::vector<std::string_view> fields;
  split_blank(line, fields);
  if (fields.size() != kFields)
    file.fail(fmt::format("expected the {} numbers of an OXTS reading, found {}", kFields,
                          fields.size()));
  double v[kFields];
  for (std::size_t i = 0; i < kFields; ++i)
    v[i] = file.number(fields[i], fmt::format("number {}", i + 1).c_str());
  GpsFix fix;
  fix.position = {v[kLat], v[kLon], v[kAlt]};
  try {
    fix.position.check();
  } catch (const ArgumentError& error) {
    file.fail(error.what());
  }
  fix.accuracy_m = v[kAccuracy];
  if (fix.accuracy_m < 0) file.fail(fmt::format("pos_accuracy is {}, negative", fix.accuracy_m));
  fix.R_enu_body =
      SO3::exp({0, 0, v[kYaw]}) * SO3::exp({0, v[kPitch], 0}) * SO3::exp({v[kRoll], 0, 0});
  fix.velocity_enu = *fix.R_enu_body * Eigen::Vector3d(v[kForward], v[kLeft], v[kUp]);
  return fix;
}

/// Parses "YYYY-MM-DD" and "hh:mm:ss.f" into nanoseconds since 1970; nothing for any other text.
std::optional<std::int64_t> parse_date(std::string_view day, std::string_view time) {
  const auto integer = [](std::string_view text, std::size_t at, std::size_t count) {
    const auto value = parse_integer(text.substr(at, count));
    return value && *value >= 0 ? static_cast<int>(*value) : -1;
  };
  if (day.size() != 10 || day[4] != '-' || day[7] != '-' || time.size() < 8 || time[2] != ':' ||
      time[5] != ':')
    return std::nullopt;
  const int y = integer(day, 0, 4), mo = integer(day, 5, 2), d = integer(day, 8, 2);
  const int h = integer(time, 0, 2), mi = integer(time, 3, 2);
  const auto seconds_ns = parse_seconds_as_ns(time.substr(6));
  const std::chrono::year_month_day date{std::chrono::year(y),
                                         std::chrono::month(static_cast<unsigned>(mo)),
                                         std::chrono::day(static_cast<unsigned>(d))};
  if (y < 1970 || y > 2200 || mo < 1 || d < 1 || !date.ok() || h < 0 || h > 23 || mi < 0 ||
      mi > 59 || !seconds_ns || *seconds_ns < 0 || *seconds_ns >= 61'000'000'000)
    return std::nullopt;
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  return ((days * 24 + h) * 60 + mi) * 60'000'000'000 + *seconds_ns;
}

void require_same_count(const std::string& path, std::size_t readings, const std::string& times,
                        std::size_t stamps) {
  if (readings != stamps)
    throw FileError(path, fmt::format("holds {} readings, but {} holds {} times", readings,
                                      fs::path(times).filename().string(), stamps));
}

/// Reads one reading per line.
std::vector<GpsFix> read_lines(const std::string& path, const std::string& times_path) {
  TextFile file(path);
  std::vector<GpsFix> fixes;
  std::string_view line;
  while (file.next_data(line)) fixes.push_back(parse_reading(file, line));
  const std::vector<std::int64_t> stamps_ns = read_kitti_times(times_path);
  require_same_count(path, fixes.size(), times_path, stamps_ns.size());
  for (std::size_t i = 0; i < fixes.size(); ++i) fixes[i].stamp_ns = stamps_ns[i];
  return fixes;
}

/// Reads one reading per file.
std::vector<GpsFix> read_files(const fs::path& oxts) {
  const std::string times_path = (oxts / "timestamps.txt").string();
  const fs::path data = oxts / "data";
  const std::vector<std::int64_t> stamps_ns = read_kitti_times(times_path);
  const auto files = static_cast<std::size_t>(
      std::count_if(fs::directory_iterator(data), fs::directory_iterator(),
                    [](const auto& entry) { return entry.path().extension() == ".txt"; }));
  require_same_count(data.string(), files, times_path, stamps_ns.size());
  std::vector<GpsFix> fixes;
  for (std::size_t i = 0; i < stamps_ns.size(); ++i) {
    TextFile file((data / fmt::format("{:010d}.txt", i)).string());
    std::string_view line;
    if (!file.next_data(line)) throw FileError(file.path(), "holds no reading");
    fixes.push_back(parse_reading(file, line));
    fixes.back().stamp_ns = stamps_ns[i];
    if (file.next_data(line)) file.fail("holds more than one reading");
  }
  return fixes;
}

}  // namespace

std::vector<GpsFix> read_oxts(const std::string& path) {
  const fs::path given = fs::path(path);
  if (!fs::is_directory(given)) {
    const fs::path times = given.parent_path() / ("times_" + given.filename().string());
    return read_lines(path, times.string());
  }
  for (const fs::path& oxts : {given / "oxts", given})
    if (fs::is_directory(oxts / "data")) return read_files(oxts);
  if (fs::exists(given / "oxts.txt"))
    return read_lines((given / "oxts.txt").string(), (given / "times_oxts.txt").string());
  throw FileError(path, "holds neither oxts/data nor oxts.txt");
}

std::vector<std::int64_t> read_kitti_times(const std::string& path) {
  TextFile file(path);
  std::vector<std::int64_t> stamps_ns;
  std::vector<std::string_view> fields;
  std::string_view line;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (stamps_ns.empty() && fields.size() != 2) break;
    const auto date = fields.size() == 2 ? parse_date(fields[0], fields[1]) : std::nullopt;
    if (!date) file.fail(in_quotes(line) + " is not a date yyyy-mm-dd hh:mm:ss.f");
    if (!stamps_ns.empty() && *date <= stamps_ns.back())
      file.fail("time " + in_quotes(line) + " does not increase");
    stamps_ns.push_back(*date);
  }
  return stamps_ns.empty() ? read_times(path) : stamps_ns;
}

}  // namespace placegraph
