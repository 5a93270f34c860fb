#pragma once
#include <placegraph/io/internal/trajectories/pose_columns.h>

namespace placegraph {

/// A text file with a pose a line, whoever wrote it. A header that names at least x, y and z, as a
/// comment or as the first line, is obeyed. Without one the number of fields decides: KITTI (3x4 or
/// 4x4, with or without the number of the frame), TUM (an id before or behind is passed over),
/// EuRoC, positions alone with or without time; where several forms have that number, the first in
/// which all of the first 50 lines are poses. Blanks, tabs, commas or semicolons stand between the
/// fields; nanoseconds are told from seconds by their size, and between commas by being whole.
class PoseTable {
 public:
  /// Throws FileError with the line: no pose; a header that names what cannot be read or another
  /// number of columns than there are; lines of no known form, with the number of their fields and
  /// what each form makes of them.
  explicit PoseTable(const std::string& path);

  const PoseColumns& columns() const { return columns_; }
  const TextFile& file() const { return file_; }
  /// The next pose; false at the end. Throws FileError with the line.
  bool next(PoseLine& pose);

 private:
  bool next_line(std::string_view& line);
  void find_columns();
  /// Why the first lines are not of that form; empty if they are.
  std::string why_not(const PoseColumns& columns);

  TextFile file_;
  PoseColumns columns_;
  int first_line_ = 0;  ///< lines before it are no poses
  std::vector<std::string_view> fields_;
};

}  // namespace placegraph
