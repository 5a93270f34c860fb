#pragma once
#include <random>
#include <string>

namespace placegraph::test {

/// The bytes with one to four of them changed, those before `first` excepted.
inline std::string damaged(std::string bytes, std::mt19937& random, std::size_t first = 0) {
  const unsigned count = 1 + random() % 4;
  for (unsigned i = 0; i < count; ++i)
    bytes[first + random() % (bytes.size() - first)] = static_cast<char>(random());
  return bytes;
}

}  // namespace placegraph::test
