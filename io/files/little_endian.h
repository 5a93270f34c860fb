#pragma once
#include <bit>
#include <cstring>
#include <string>
#include <type_traits>

namespace placegraph {

static_assert(std::endian::native == std::endian::little, "binary exports are little-endian");

/// Appends the bytes of a number, little-endian.
template <class Number>
  requires std::is_arithmetic_v<Number>
void append_number(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

}  // namespace placegraph
