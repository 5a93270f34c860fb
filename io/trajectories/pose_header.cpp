#include <fmt/format.h>
#include <placegraph/io/trajectories/pose_header.h>

#include <algorithm>
#include <cctype>

namespace placegraph {
namespace {

/// The content of a column, derived from its name.
struct Role {
  enum Kind { kUnknown, kIgnored, kStamp, kNumber, kPosition, kQuaternion, kAngle, kMatrix };
  Kind kind = kUnknown;
  int index = 0;  ///< index in x y z or in w x y z, or 10 row + column of a matrix
  StampUnit unit = StampUnit::kSeconds;
  bool has_unit = false;
  std::string of = {};  ///< of a stamp: its name without the unit
};

bool one_of(std::string_view text, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

/// Converts a name to lower case with a single `_` for other characters, none at the ends.
std::string plain_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name;
}

/// Removes "[unit]" or "(unit)" from a name and returns it.
std::string take_unit(std::string& name) {
  const std::size_t open = name.find_first_of("[(");
  if (open == name.npos) return {};
  const std::size_t close = name.find_first_of("])", open);
  const std::string unit = name.substr(open + 1, close == name.npos ? close : close - open - 1);
  name.erase(open, close == name.npos ? close : close - open + 1);
  return plain_name(unit);
}

std::optional<StampUnit> unit_of(std::string_view word) {
  if (one_of(word, {"s", "sec", "secs", "second", "seconds"})) return StampUnit::kSeconds;
  if (one_of(word, {"ms", "msec", "millis", "millisecond", "milliseconds"}))
    return StampUnit::kMilliseconds;
  if (one_of(word, {"us", "usec", "micros", "microsecond", "microseconds"}))
    return StampUnit::kMicroseconds;
  if (one_of(word, {"ns", "nsec", "nsecs", "nanos", "nanosec", "nanosecs", "nanosecond",
                    "nanoseconds"}))
    return StampUnit::kNanoseconds;
  return std::nullopt;
}

/// The part before the last `_`, and the part after it.
std::pair<std::string_view, std::string_view> split_last(std::string_view name) {
  const std::size_t at = name.rfind('_');
  if (at == name.npos) return {"", name};
  return {name.substr(0, at), name.substr(at + 1)};
}

bool holds_any(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return text.find(word) != text.npos; });
}

std::optional<Role> stamp_role(std::string_view name, const std::string& bracket) {
  Role role;
  const auto [head, tail] = split_last(name);
  std::string_view stem = name;
  if (const auto unit = unit_of(tail)) {
    role.unit = *unit;
    role.has_unit = true;
    stem = head;
  }
  if (const auto unit = unit_of(bracket)) {
    role.unit = *unit;
    role.has_unit = true;
  }
  const std::string_view last = split_last(stem).second;
  if (!one_of(last, {"t", "ts", "time", "times", "timestamp", "timestamps", "stamp", "", "utc"}))
    return std::nullopt;
  // "t_x" does not reach this line, "t" alone is the time; "" is a bare unit such as "seconds".
  if (last.empty() && !role.has_unit) return std::nullopt;
  role.kind = Role::kStamp;
  role.of = stem;
  return role;
}

Role role_of(std::string_view written) {
  std::string text(written);
  const std::string bracket = take_unit(text);
  const std::string name = plain_name(text);
  if (name.empty()) return {};
  if (const auto stamp = stamp_role(name, bracket)) return *stamp;
  if (one_of(name, {"frame", "frames", "index", "idx", "number", "seq", "frame_number",
                    "frame_index", "image", "image_index", "field_header_seq", "header_seq"}))
    return {Role::kNumber};
  if (one_of(name, {"roll", "pitch", "yaw", "heading", "rx", "ry", "rz", "phi", "psi", "theta"}) ||
      holds_any(name, {"roll", "pitch", "yaw", "euler", "rotvec"}))
    return {Role::kAngle};
  const std::size_t digits = name.find_last_not_of("0123456789");
  if (digits != name.npos && digits + 3 == name.size() &&
      one_of(name.substr(0, digits + 1), {"r", "r_", "t", "t_", "m", "m_", "p", "p_"}))
    return {Role::kMatrix, 10 * (name[digits + 1] - '0') + (name[digits + 2] - '0')};
  // The axis is the last letter, before a unit such as "_m".
  auto [head, tail] = split_last(name);
  if (one_of(tail, {"m", "metre", "metres", "meter", "meters"}) && !head.empty())
    std::tie(head, tail) = split_last(head);
  const char axis = tail.back();
  if (std::string_view("wxyz").find(axis) == std::string_view::npos)
    return one_of(name, {"id", "frame_id", "child_frame_id", "header_frame_id", "node", "vertex",
                         "field_header_frame_id", "name", "file", "state", "status", "error"})
               ? Role{Role::kIgnored}
               : Role{};
  // The name without the axis: "p_rs_r" of p_RS_R_x, "q" of qx, "orientation".
  const std::string of =
      std::string(head) + (head.empty() ? "" : "_") + std::string(tail.substr(0, tail.size() - 1));
  const std::string_view stem =
      of.ends_with('_') ? std::string_view(of).substr(0, of.size() - 1) : std::string_view(of);
  if (stem.starts_with("q") || holds_any(stem, {"quat", "orient", "rot"}))
    return {Role::kQuaternion, axis == 'w' ? 0 : 1 + (axis - 'x')};
  if (holds_any(stem, {"vel", "acc", "gyr", "omega", "bias", "cov", "sigma", "std", "var", "lin",
                       "ang", "mag", "imu"}) ||
      stem.starts_with("v") || stem.starts_with("b_") || stem.starts_with("a_") ||
      stem.starts_with("w_") || one_of(stem, {"a", "w", "b", "s", "bg", "ba"}))
    return {Role::kIgnored};
  if (stem.empty() || one_of(stem, {"t", "p", "pos", "c", "x"}) || stem.starts_with("t_") ||
      stem.starts_with("p_") || holds_any(stem, {"pos", "trans", "loc", "cent", "point"})) {
    if (axis == 'w') return stem.empty() ? Role{Role::kQuaternion, 0} : Role{};
    return {Role::kPosition, axis - 'x'};
  }
  return {};
}

/// The names of a header, separated by commas or semicolons if it has any, else by blanks.
std::vector<std::string> names_of(std::string_view line) {
  while (!line.empty() && (line.front() == '#' || line.front() == '%' || line.front() == ' ' ||
                           line.front() == '\t'))
    line.remove_prefix(1);
  const std::size_t separator = line.find_first_of(",;");
  std::vector<std::string_view> fields;
  if (separator != line.npos)
    split_at(line[separator], line, fields);
  else
    split_blank(line, fields);
  std::vector<std::string> names;
  for (const std::string_view field : fields) {
    // "timestamp [s] tx [m]": a separate unit belongs to the name before it.
    if (!names.empty() && separator == line.npos && field.find_first_of("[(") == 0)
      names.back() += std::string(field);
    else
      names.emplace_back(field);
  }
  while (!names.empty() && names.back().empty()) names.pop_back();
  return names;
}

/// Columns by the roles of their names; of duplicate names the first is used.
struct NamedColumns {
  std::optional<std::size_t> stamp, number;
  Role stamp_role;
  std::array<std::optional<std::size_t>, 3> position;
  std::array<std::optional<std::size_t>, 4> quaternion;
  std::vector<std::pair<int, std::size_t>> matrix;  ///< 10 row + column
  std::optional<std::size_t> angle, nanoseconds;
  std::size_t known = 0;

  explicit NamedColumns(const std::vector<std::string>& names) {
    std::vector<std::pair<Role, std::size_t>> timed;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const Role role = role_of(names[k]);
      known += role.kind != Role::kUnknown;
      const auto first = [k](std::optional<std::size_t>& column) {
        if (!column) column = k;
      };
      if (role.kind == Role::kStamp && !stamp) stamp_role = role;
      if (role.kind == Role::kStamp) first(stamp);
      if (role.kind == Role::kNumber) first(number);
      if (role.kind == Role::kPosition) first(position[static_cast<std::size_t>(role.index)]);
      if (role.kind == Role::kQuaternion) first(quaternion[static_cast<std::size_t>(role.index)]);
      if (role.kind == Role::kAngle) first(angle);
      if (role.kind == Role::kMatrix) matrix.emplace_back(role.index, k);
      if (role.kind == Role::kStamp && role.has_unit) timed.emplace_back(role, k);
    }
    take_two_columns(timed);
  }
  /// Seconds and nanoseconds of one name are one time, and more exact than another column.
  void take_two_columns(const std::vector<std::pair<Role, std::size_t>>& timed) {
    for (const auto& [seconds, s] : timed)
      for (const auto& [rest, ns] : timed)
        if (!nanoseconds && seconds.of == rest.of && seconds.unit == StampUnit::kSeconds &&
            rest.unit == StampUnit::kNanoseconds) {
          stamp_role = seconds;
          stamp = s;
          nanoseconds = ns;
        }
  }
  bool has_position() const { return position[0] && position[1] && position[2]; }
  int quaternion_parts() const {
    return static_cast<int>(std::count_if(quaternion.begin(), quaternion.end(),
                                          [](const auto& part) { return part.has_value(); }));
  }
  /// Columns of the 3x4 matrix, counted from 0 or from 1; its last column may be named x, y, z.
  std::optional<std::array<std::size_t, 12>> rows() const {
    int lowest = 99;
    for (const auto& [entry, k] : matrix) lowest = std::min({lowest, entry / 10, entry % 10});
    std::array<std::size_t, 12> columns{};
    std::array<bool, 12> has{};
    for (const auto& [entry, k] : matrix) {
      const int row = entry / 10 - lowest, column = entry % 10 - lowest;
      if (row > 3 || column > 3) return std::nullopt;
      if (row == 3) continue;
      columns[static_cast<std::size_t>(4 * row + column)] = k;
      has[static_cast<std::size_t>(4 * row + column)] = true;
    }
    for (std::size_t row = 0; row < 3; ++row)
      if (!has[4 * row + 3] && position[row])
        columns[4 * row + 3] = *position[row], has[4 * row + 3] = true;
    if (!std::all_of(has.begin(), has.end(), [](bool b) { return b; })) return std::nullopt;
    return columns;
  }
};

PoseHeader refused(std::string reason) {
  PoseHeader header;
  header.kind = PoseHeader::Kind::kRefused;
  header.reason = std::move(reason);
  return header;
}

}  // namespace

PoseHeader parse_pose_header(std::string_view line, std::size_t fields) {
  const std::vector<std::string> names = names_of(line);
  const NamedColumns named(names);
  const bool whole_pose = named.rows().has_value() || named.has_position();
  if (!whole_pose) return {};
  // A remark may contain x, y and z among other words; a header contains only names of columns.
  const bool only_names = named.known == names.size();
  if (!only_names && names.size() != fields) {
    if (named.quaternion_parts() == 4 || named.stamp)
      return refused(
          fmt::format("the header names {} columns, but the lines have {}", names.size(), fields));
    return {};
  }
  if (names.size() > fields)
    return refused(
        fmt::format("the header names {} columns, but the lines have {}", names.size(), fields));
  PoseHeader header;
  PoseColumns& columns = header.columns;
  if (const auto rows = named.rows()) {
    columns.matrix = *rows;
  } else {
    for (std::size_t i = 0; i < 3; ++i) columns.position[i] = *named.position[i];
    if (named.quaternion_parts() == 4) {
      columns.quaternion.emplace();
      for (std::size_t i = 0; i < 4; ++i) (*columns.quaternion)[i] = *named.quaternion[i];
    } else if (named.quaternion_parts() > 0) {
      return refused(fmt::format("the header names {} of the four parts of a quaternion",
                                 named.quaternion_parts()));
    } else if (named.angle) {
      return refused("the header names an angle, " + in_quotes(names[*named.angle]) +
                     ": orientations are read as quaternions or matrices");
    } else if (!named.matrix.empty()) {
      return refused("the header names some entries of a matrix, but not all of its 3x4");
    }
  }
  if (named.stamp) {
    columns.stamp = *named.stamp;
    columns.unit = named.stamp_role.has_unit ? named.stamp_role.unit : StampUnit::kUnknown;
    columns.nanoseconds = named.nanoseconds;
  } else if (named.number) {
    columns.stamp = *named.number;
    columns.unit = StampUnit::kFrameNumber;
  }
  header.kind = PoseHeader::Kind::kColumns;
  return header;
}

}  // namespace placegraph
