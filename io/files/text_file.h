#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Checks a file that is to be read, before it is opened.
/// A pipe of the shell, as <(...), is accepted. Throws FileError for a folder, for a device and for
/// a named pipe, which would keep the program waiting or never end. Says nothing about a file that
/// is missing.
void require_input_file(const std::string& path);

/// Whether it is one of the ten digits.
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A text file that is read whole and parsed line by line.
/// It keeps the line number, so that errors of the parser can name `file:line`. A UTF-8 byte order
/// mark is not part of the text. Throws FileError if the file is missing, a folder, unreadable,
/// larger than 2 GiB or UTF-16. No count found inside the file ever sizes an allocation.
class TextFile {
 public:
  explicit TextFile(std::string path);

  /// The next line without its line end; false at the end of the file.
  bool next(std::string_view& line);
  /// The next line that is neither blank nor a comment. A `#` at its begin, or after a blank, a
  /// comma or a semicolon, begins a comment, which is removed.
  bool next_data(std::string_view& line);
  /// Returns to the begin.
  void rewind() { position_ = begin_, line_ = 0; }

  std::size_t size() const { return text_.size(); }   ///< of the text [bytes]
  std::size_t position() const { return position_; }  ///< begin of the next line [bytes]
  std::size_t lines_left() const;                     ///< from there on, at most
  int line() const { return line_; }  ///< number of the last line, from 1; 0 before the first
  const std::string& path() const { return path_; }
  /// Throws FileError "path:line: message" for the last line.
  [[noreturn]] void fail(const std::string& message) const;

  /// Number parsing with `file:line: what: ...` errors; whole field, C locale. `number` rejects nan
  /// and infinity.
  double number(std::string_view field, const char* what) const;
  double number_or_nan(std::string_view field, const char* what) const;
  std::int64_t integer(std::string_view field, const char* what) const;
  /// Decimal seconds, with or without exponent, as the nearest nanosecond: exact, not through
  /// double.
  std::int64_t seconds_as_ns(std::string_view field, const char* what) const;

 private:
  std::string path_, text_;
  std::size_t begin_ = 0, position_ = 0;
  int line_ = 0;
};

/// The line without a comment, which begins at a `#` after a blank, a comma or a semicolon.
/// A `#` inside a name does not begin one.
std::string_view without_comment(std::string_view line);
/// Splits at blanks and tabs into `fields`; empty fields are dropped.
void split_blank(std::string_view line, std::vector<std::string_view>& fields);
/// Splits at every separator; blanks around a field are dropped, empty fields kept.
void split_at(char separator, std::string_view line, std::vector<std::string_view>& fields);
/// Likewise at commas.
void split_comma(std::string_view line, std::vector<std::string_view>& fields);

/// The whole field as a number, nan and infinity included.
/// Nothing if it is not one or overflows.
std::optional<double> parse_double(std::string_view field);
/// The whole field as an integer; nothing if it is not one or overflows.
std::optional<std::int64_t> parse_integer(std::string_view field);
/// The nearest integer to a decimal number, with or without exponent, times 10^power.
/// It is exact, not through double. `exact` says whether nothing was rounded.
std::optional<std::int64_t> parse_decimal(std::string_view field, int power, bool* exact = nullptr);
/// Decimal seconds as the nearest nanosecond; nothing if the field is no number.
std::optional<std::int64_t> parse_seconds_as_ns(std::string_view field);

/// The text in quotes as error messages show it.
/// At most 40 characters, unprintable ones as '?'.
std::string in_quotes(std::string_view text);

/// Reads one time [s] per line, strictly increasing, at least one.
/// Throws FileError with the line.
std::vector<std::int64_t> read_times(const std::string& path);

}  // namespace placegraph
