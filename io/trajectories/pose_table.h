#pragma once
#include <placegraph/io/trajectories/pose_columns.h>

namespace placegraph {

/// A text file with one pose per line, from any source. A header that names at least x, y and z, as
/// a comment or as the first line, is used. Without a header the number of fields decides: KITTI
/// (3x4 or 4x4, with or without the number of the frame), TUM (an id before or after the pose is
/// skipped), EuRoC, positions alone with or without time; if several formats have that number, the
/// first format that fits all of the first 50 lines. Fields are separated by blanks, tabs, commas
/// or semicolons; nanoseconds are distinguished from seconds by their size, and in files with
/// commas also by being whole numbers.
class PoseTable {
 public:
  /// Throws FileError with the line: no pose; a header that names unreadable columns or another
  /// number of columns than the lines have; lines of unknown format, with the number of their
  /// fields and the reason why each format does not fit.
  explicit PoseTable(const std::string& path) : PoseTable(TextFile(path)) {}
  /// The same from a file that is open, read from its begin.
  explicit PoseTable(TextFile file);

  const PoseColumns& columns() const { return columns_; }
  const TextFile& file() const { return file_; }
  /// The next pose; false at the end. Throws FileError with the line.
  bool next(PoseLine& pose);

 private:
  bool next_line(std::string_view& line);
  void find_columns();
  /// The reason why the first lines are not in that format; empty if they are.
  std::string why_not(const PoseColumns& columns);

  TextFile file_;
  PoseColumns columns_;
  int first_line_ = 0;  ///< number of the first line with a pose
  std::vector<std::string_view> fields_;
};

}  // namespace placegraph
