#pragma once
#include <placegraph/io/files/text_file.h>

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace placegraph {

enum class StampUnit {
  kUnknown,
  kFrameNumber,  ///< no time: the number of the frame
  kSeconds,
  kMilliseconds,
  kMicroseconds,
  kNanoseconds,
};

/// One line of a table of poses.
struct PoseLine {
  std::int64_t stamp = 0;  ///< [ns], or the number of the frame; 0 where the table has no stamps
  std::optional<Eigen::Isometry3d> T_world_body;  ///< empty if all its numbers are nan (lost)
  bool oriented = false;  ///< false: position alone, or a quaternion of four zeros or four nan
};

/// Assignment of the columns of a table of poses. Columns count from 0.
struct PoseColumns {
  char separator = ' ';              ///< ' ' (blanks and tabs), ',' or ';'
  std::size_t fields = 0;            ///< number of fields in a line
  bool more = false;                 ///< lines may have more fields, which are skipped
  std::optional<std::size_t> stamp;  ///< none: lines are frames 0, 1, 2, ...
  StampUnit unit = StampUnit::kUnknown;
  std::optional<std::size_t> nanoseconds;  ///< added to a stamp of whole seconds
  /// Columns of the 3x4 matrix T_world_body, row by row.
  std::optional<std::array<std::size_t, 12>> matrix;
  std::array<std::size_t, 3> position{};                 ///< x y z [m], where there is no matrix
  std::optional<std::array<std::size_t, 4>> quaternion;  ///< w x y z
  /// Columns of the last row of a 4x4 matrix, which must be 0 0 0 1.
  std::optional<std::array<std::size_t, 4>> last_row;

  bool has_times() const { return stamp && unit != StampUnit::kFrameNumber; }
  /// Content of every column, e.g. "t x y z qx qy qz qw", for messages.
  std::string text() const;
  /// Parses a line from its fields. Throws FileError with the current line of `file`: another
  /// number of fields, not a number, not a rotation (1e-2), not a stamp in this unit.
  PoseLine parse(const TextFile& file, const std::vector<std::string_view>& fields) const;
};

/// Splits a line at the separator of a table; see PoseColumns.
void split_fields(char separator, std::string_view line, std::vector<std::string_view>& fields);

}  // namespace placegraph
