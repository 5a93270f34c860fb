#pragma once
#include <placegraph/graph/core/ids.h>

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace [[gnu::visibility("default")]] placegraph {

/// A table as CSV by RFC 4180, with lines that end in "\n".
/// A field with a comma, a quotation mark or a line break stands in quotation marks, and those in
/// it are doubled.
class CsvText {
 public:
  /// Adds a field to the present row.
  CsvText& add(std::string_view field);
  CsvText& add(const char* field) { return add(std::string_view(field)); }
  /// The same for a number: with as many digits as it takes to read it back.
  CsvText& add(double field);
  /// The same for a number of 32 bits, which takes fewer digits.
  CsvText& add(float field);
  /// The same for an integer.
  template <std::integral Integer>
    requires(!std::same_as<Integer, bool> && !std::same_as<Integer, char>)
  CsvText& add(Integer field) {
    return add(std::string_view(std::to_string(field)));
  }
  /// The same for a truth value: true or false.
  CsvText& add(bool field) { return add(std::string_view(field ? "true" : "false")); }
  /// The same for the number of an id.
  template <class Tag>
  CsvText& add(Id<Tag> field) {
    return add(field.value());
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
  /// The rows that were ended, and what the present row has.
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool begun_ = false;  ///< whether the present row has a field
};

}  // namespace placegraph
