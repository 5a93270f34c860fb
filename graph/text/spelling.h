#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// How many changes of a byte make `b` of `a`.
/// These are insertions, deletions, substitutions, and swaps of neighbours: the optimal string
/// alignment distance: no byte is changed twice.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidates that are likely misspelled as `word`, the nearest first, at most three.
/// A candidate counts if its edit distance is at most 3 and less than half of its length.
std::vector<std::string> similar_spellings(std::string_view word,
                                           const std::vector<std::string>& candidates);

/// "; did you mean A or B?" for the similar spellings, or an empty text.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace placegraph
