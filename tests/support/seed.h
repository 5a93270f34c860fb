#pragma once
#include <gtest/gtest.h>
#include <placegraph/graph/core/random.h>

#include <cstdlib>
#include <iostream>
#include <string>

namespace placegraph::test {

/// The random numbers of a test: from PLACEGRAPH_SEED, else `default_seed`. Prints the seed, so
/// that what failed can be run again.
inline Random seeded_random(std::uint64_t default_seed) {
  const char* text = std::getenv("PLACEGRAPH_SEED");
  const std::uint64_t seed = text ? std::strtoull(text, nullptr, 10) : default_seed;
  std::cout << "seed " << seed << "\n";
  return Random(seed);
}

}  // namespace placegraph::test
