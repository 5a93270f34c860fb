#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace placegraph {

/// Insertions, deletions and substitutions of a byte, and swaps of neighbours, that change `a` to `b`.
/// The optimal string alignment distance: no byte is changed twice.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidates that are likely misspelled as `word`, the nearest first, at most three.
/// A candidate counts if its edit distance is at most 3 and less than half of its length.
std::vector<std::string> similar_spellings(std::string_view word,
                                           const std::vector<std::string>& candidates);

/// "; did you mean A or B?" for the similar spellings, or an empty text.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace placegraph
