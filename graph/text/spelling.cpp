#include <placegraph/graph/text/spelling.h>

#include <algorithm>
#include <utility>

namespace placegraph {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row;
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row.assign(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = last[j - 1] + (a[i - 1] != b[j - 1]);
      row[j] = std::min({substituted, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = std::move(last);
    last = std::move(row);
  }
  return last[b.size()];
}

std::vector<std::string> similar_spellings(std::string_view word,
                                           const std::vector<std::string>& candidates) {
  // Largest distance of a suggestion, and number of them. Chosen.
  constexpr std::size_t kLargest = 3, kMost = 3;
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance <= kLargest && 2 * distance < candidate.size())
      near.emplace_back(distance, candidate);
  }
  std::ranges::stable_sort(near, {}, &std::pair<std::size_t, std::string>::first);
  std::vector<std::string> spellings;
  for (std::size_t i = 0; i < near.size() && i < kMost; ++i) spellings.push_back(near[i].second);
  return spellings;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  std::string text;
  for (const std::string& spelling : similar_spellings(word, candidates))
    text += (text.empty() ? "; did you mean " : " or ") + spelling;
  return text.empty() ? text : text + "?";
}

}  // namespace placegraph
