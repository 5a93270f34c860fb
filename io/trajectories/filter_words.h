#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace placegraph {

/// A number with the letters behind it: "0.5m", "10hz", "3".
struct Quantity {
  double value = 0;
  std::string unit;  ///< lower case; empty: none
};

/// A number and its unit; nothing for another text.
std::optional<Quantity> parse_quantity(std::string_view word);

/// The words of one step of a filter, taken from left to right.
/// Blanks separate words; within '...' or "..." they belong to the word. What is missing, left over
/// or wrong is an ArgumentError.
class FilterWords {
 public:
  explicit FilterWords(std::string_view step);

  bool has_next() const { return next_ < words_.size(); }
  /// The next word without taking it; empty at the end.
  std::string_view peek() const { return has_next() ? words_[next_] : std::string_view(); }
  /// Takes the next word, which is `what`.
  const std::string& take(const char* what);
  /// Takes the next word if it is this one.
  bool take_if(std::string_view word);
  /// Takes the next word as a number without a unit.
  double number(const char* what);
  /// Takes a length of time [s] as whole nanoseconds.
  std::int64_t seconds_ns(const char* what);
  /// Requires that no word is left.
  void end() const;

 private:
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

/// The steps of a chain, as separated by semicolons outside of quotes; blank ones are left out.
std::vector<std::string> split_chain(std::string_view chain);

}  // namespace placegraph
