#pragma once
#include <placegraph/io/trajectories/pose_columns.h>

#include <string_view>

namespace placegraph {

/// The columns that a header line names. Names are those of TUM, EuRoC, ROS, pandas and similar
/// sources: `timestamp [ns]`, `tx`, `p_RS_R_x [m]`, `field.pose.orientation.w`, `r11`.
struct PoseHeader {
  enum class Kind {
    kNone,     ///< names no columns: a remark
    kColumns,  ///< names columns, in `columns`; separator and more are not set
    kRefused,  ///< names columns that cannot be read, for the given `reason`
  };
  Kind kind = Kind::kNone;
  PoseColumns columns;
  std::string reason;
};

/// Reads a line, with or without `#` or `%` before it, as a header of a table whose lines have
/// `fields` fields.
PoseHeader parse_pose_header(std::string_view line, std::size_t fields);

}  // namespace placegraph
