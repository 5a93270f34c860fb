#pragma once
#include <placegraph/frontend/places/place_recognizer.h>

#include <algorithm>
#include <vector>

namespace placegraph {

/// Keeps the `count` best of a list, sorted by score, best first; ties are sorted by view.
inline void keep_best(std::vector<PlaceSimilarity>& list, int count) {
  const auto kept = std::min(list.size(), static_cast<std::size_t>(std::max(count, 0)));
  const auto better = [](const PlaceSimilarity& a, const PlaceSimilarity& b) {
    return a.score != b.score ? a.score > b.score : a.view < b.view;
  };
  std::partial_sort(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(kept), list.end(),
                    better);
  list.resize(kept);
}

}  // namespace placegraph
