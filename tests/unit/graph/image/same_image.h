#pragma once
#include <gtest/gtest.h>
#include <placegraph/graph/image/image.h>

#include <cstring>

namespace placegraph::test {

/// Whether two images have the same type, size and bits, or are both empty.
inline testing::AssertionResult same_image(const Image& a, const Image& b) {
  if (a.empty() && b.empty()) return testing::AssertionSuccess();
  if (a.empty() != b.empty())
    return testing::AssertionFailure() << (a.empty() ? "the first" : "the second") << " is empty";
  if (a.type() != b.type() || a.size() != b.size())
    return testing::AssertionFailure()
           << "type " << a.type() << " and " << b.type() << ", " << a.size() << " and " << b.size();
  for (int v = 0; v < a.rows; ++v)
    if (std::memcmp(a.ptr(v), b.ptr(v), a.elemSize() * static_cast<std::size_t>(a.cols)) != 0)
      return testing::AssertionFailure() << "row " << v << " differs";
  return testing::AssertionSuccess();
}

}  // namespace placegraph::test
