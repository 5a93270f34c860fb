#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/trajectories/pose_columns.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

using Fields = std::vector<std::string_view>;

constexpr double kQuaternionTolerance = 1e-2;
constexpr double kRotationTolerance = 1e-2;

void check_rotation(const TextFile& file, const Eigen::Matrix3d& R) {
  const double deviation = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (deviation > kRotationTolerance || R.determinant() < 0) {
    file.fail(
        fmt::format("the 3x3 part is not a rotation (R^T R differs from 1 by {:.3g}, "
                    "determinant {:.3g})",
                    deviation, R.determinant()));
  }
}

std::int64_t whole_number(const TextFile& file, std::string_view field, const char* what) {
  bool exact = false;
  const std::optional<std::int64_t> number = parse_decimal(field, 0, &exact);
  if (!number || !exact)
    file.fail(std::string(what) + ": " + in_quotes(field) + " is not a whole number of 64 bits");
  return *number;
}

std::int64_t scaled_time(const TextFile& file, std::string_view field, int power,
                         const char* what) {
  const std::optional<std::int64_t> stamp_ns = parse_decimal(field, power);
  if (!stamp_ns) file.fail(std::string(what) + ": " + in_quotes(field) + " is not a time");
  return *stamp_ns;
}

std::int64_t parse_stamp(const TextFile& file, std::string_view field, StampUnit unit) {
  switch (unit) {
    case StampUnit::kFrameNumber:
      return whole_number(file, field, "number of the frame");
    case StampUnit::kMilliseconds:
      return scaled_time(file, field, 6, "time [ms]");
    case StampUnit::kMicroseconds:
      return scaled_time(file, field, 3, "time [us]");
    case StampUnit::kNanoseconds:
      return whole_number(file, field, "time [ns]");
    case StampUnit::kSeconds:
    case StampUnit::kUnknown:
      break;
  }
  return file.seconds_as_ns(field, "time");
}

const char* name_of(StampUnit unit) {
  switch (unit) {
    case StampUnit::kFrameNumber:
      return "frame";
    case StampUnit::kMilliseconds:
      return "t_ms";
    case StampUnit::kMicroseconds:
      return "t_us";
    case StampUnit::kNanoseconds:
      return "t_ns";
    case StampUnit::kSeconds:
    case StampUnit::kUnknown:
      break;
  }
  return "t";
}

/// Whole seconds in one column and the nanoseconds after them in another.
std::int64_t parse_two_columns(const TextFile& file, std::string_view seconds,
                               std::string_view nanoseconds) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const std::int64_t s = whole_number(file, seconds, "whole seconds of the time");
  const std::int64_t ns = whole_number(file, nanoseconds, "nanoseconds of the time");
  if (ns < 0 || ns >= kSecond_ns)
    file.fail("nanoseconds of the time: " + in_quotes(nanoseconds) + " is not from 0 to 999999999");
  if (std::abs(s) >= std::numeric_limits<std::int64_t>::max() / kSecond_ns)
    file.fail("whole seconds of the time: " + in_quotes(seconds) + " is beyond 64 bits of ns");
  return s * kSecond_ns + ns;
}

PoseLine parse_matrix(const TextFile& file, const Fields& fields, const PoseColumns& columns) {
  PoseLine line;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  int nans = 0;
  for (int i = 0; i < 12; ++i) {
    const std::size_t column = (*columns.matrix)[static_cast<std::size_t>(i)];
    const double value = file.number_or_nan(fields[column], "pose");
    T.matrix()(i / 4, i % 4) = value;
    nans += std::isnan(value);
  }
  line.oriented = true;
  if (nans == 12) return line;
  if (nans > 0) file.fail(fmt::format("{} of 12 numbers are nan: a lost frame has twelve", nans));
  check_rotation(file, T.linear());
  if (columns.last_row)
    for (std::size_t i = 0; i < 4; ++i)
      if (file.number(fields[(*columns.last_row)[i]], "last row") != (i == 3 ? 1.0 : 0.0))
        file.fail("the last row of the 4x4 matrix is not 0 0 0 1");
  line.T_world_body = T;
  return line;
}

PoseLine parse_position(const TextFile& file, const Fields& fields, const PoseColumns& columns) {
  PoseLine line;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  int nans = 0;
  for (int i = 0; i < 3; ++i) {
    const std::string_view field = fields[columns.position[static_cast<std::size_t>(i)]];
    T.translation()(i) = file.number_or_nan(field, "pose");
    nans += std::isnan(T.translation()(i));
  }
  double q[4] = {0, 0, 0, 0};
  bool nowhere = true;  // all four numbers of the quaternion are nan
  if (columns.quaternion)
    for (std::size_t i = 0; i < 4; ++i) {
      q[i] = file.number_or_nan(fields[(*columns.quaternion)[i]], "pose");
      nowhere &= std::isnan(q[i]);
    }
  if (nans == 3 && nowhere) return line;
  if (nans > 0) file.fail("pose: 'nan' is not finite");
  line.T_world_body = T;
  const bool zeros = q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0;
  if (!columns.quaternion || nowhere || zeros) return line;
  const Eigen::Quaterniond quaternion(q[0], q[1], q[2], q[3]);
  if (std::isnan(quaternion.norm())) file.fail("pose: 'nan' is not finite");
  if (!(std::abs(quaternion.norm() - 1) <= kQuaternionTolerance))
    file.fail(fmt::format("the quaternion has length {:.6g}, not 1", quaternion.norm()));
  line.T_world_body->linear() = quaternion.normalized().toRotationMatrix();
  line.oriented = true;
  return line;
}

}  // namespace

std::string PoseColumns::text() const {
  std::vector<std::string> names(fields, "-");
  if (stamp) names[*stamp] = name_of(unit);
  if (nanoseconds) names[*nanoseconds] = "ns";
  constexpr const char *axes[] = {"x", "y", "z"}, *parts[] = {"qw", "qx", "qy", "qz"};
  if (matrix)
    for (std::size_t i = 0; i < 12; ++i) names[(*matrix)[i]] = fmt::format("m{}{}", i / 4, i % 4);
  else
    for (std::size_t i = 0; i < 3; ++i) names[position[i]] = axes[i];
  if (quaternion)
    for (std::size_t i = 0; i < 4; ++i) names[(*quaternion)[i]] = parts[i];
  if (last_row)
    for (std::size_t i = 0; i < 4; ++i) names[(*last_row)[i]] = i == 3 ? "1" : "0";
  return fmt::format("{}{}", fmt::join(names, " "), more ? " ..." : "");
}

PoseLine PoseColumns::parse(const TextFile& file, const Fields& line) const {
  if (line.size() != fields && !(more && line.size() > fields))
    file.fail(fmt::format("expected {} fields ({}), found {}", fields, text(), line.size()));
  PoseLine pose = matrix ? parse_matrix(file, line, *this) : parse_position(file, line, *this);
  if (nanoseconds)
    pose.stamp = parse_two_columns(file, line[*stamp], line[*nanoseconds]);
  else if (stamp)
    pose.stamp = parse_stamp(file, line[*stamp], unit);
  return pose;
}

void split_fields(char separator, std::string_view line, std::vector<std::string_view>& fields) {
  if (separator == ' ')
    split_blank(line, fields);
  else
    split_at(separator, line, fields);
}

}  // namespace placegraph
