#pragma once
#include <fmt/core.h>
#include <placegraph/graph/text/id_format.h>

#include <string>
#include <string_view>

namespace placegraph {

/// A table as CSV by RFC 4180, with lines that end in "\n": a field with a comma, a quotation mark
/// or a line break stands in quotation marks, and those in it are doubled.
class CsvText {
 public:
  /// Adds a field to the present row: a text, or a number or id as fmt::format("{}") writes it.
  template <class Field>
  CsvText& add(const Field& field) {
    return add_text(fmt::format("{}", field));
  }
  /// Ends the present row.
  void end_row() {
    text_ += '\n';
    begun_ = false;
  }
  /// Adds a whole row.
  template <class... Fields>
  void row(const Fields&... fields) {
    (add(fields), ...);
    end_row();
  }
  const std::string& text() const { return text_; }

 private:
  CsvText& add_text(std::string_view field) {
    if (begun_) text_ += ',';
    begun_ = true;
    const bool quoted = field.find_first_of(",\"\r\n") != std::string_view::npos;
    if (quoted) text_ += '"';
    for (const char c : field) text_.append(quoted && c == '"' ? 2 : 1, c);
    if (quoted) text_ += '"';
    return *this;
  }

  std::string text_;
  bool begun_ = false;  ///< whether the present row has a field
};

}  // namespace placegraph
