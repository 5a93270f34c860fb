#pragma once
#include <placegraph/io/files/text_file.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace placegraph {

/// Numbers of images are below this.
inline constexpr std::int64_t kMaxImages = 1'000'000'000;

/// A text file with one row per line, whose separator and header are found.
///
/// Fields are separated by commas, semicolons or tabs if the first row has one, else by blanks. A
/// header is a first line without numbers; names are in lower case and without quotes. A first column
/// without a name (the row numbers of pandas) is left out.
class DelimitedTable {
 public:
  /// Whether a field, in lower case, is the name of a column.
  using IsName = bool (*)(const std::string& field);

  /// With `is_name`, a first line is a header only if it has such a field, and so is a comment before
  /// it. Throws FileError as TextFile.
  explicit DelimitedTable(const std::string& path, IsName is_name = nullptr);

  /// Names of the columns; empty without a header.
  const std::vector<std::string>& header() const { return header_; }
  /// The next row without blank lines and comments; false at the end. Throws FileError if the row
  /// has another number of fields than the header.
  bool next(std::vector<std::string_view>& fields);
  char separator() const { return separator_; }  ///< ',', ';', tab or ' '
  const TextFile& file() const { return file_; }

 private:
  void split(std::string_view line, std::vector<std::string_view>& fields) const;
  void find_header(IsName is_name);
  bool take_header(const std::vector<std::string_view>& fields, IsName is_name);

  TextFile file_;
  std::vector<std::string> header_;
  bool numbered_rows_ = false;
  int header_line_ = 0;
  char separator_ = ' ';
};

/// A number that is an integer, as numpy writes it, too: "6.0e+01". Nothing if it is not one.
std::optional<std::int64_t> parse_whole(std::string_view field);

}  // namespace placegraph
