#pragma once
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <initializer_list>
#include <vector>

namespace placegraph::test {

/// Ids of one kind by their numbers: ids<KeyframeId>({2, 3, 5}).
template <class Id>
std::vector<Id> ids(std::initializer_list<std::int64_t> numbers) {
  std::vector<Id> result;
  for (const std::int64_t number : numbers) result.emplace_back(number);
  return result;
}

}  // namespace placegraph::test
