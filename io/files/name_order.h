#pragma once
#include <string>
#include <vector>

namespace placegraph {

/// Sorts names of frames into the order in which they were taken: by their text, numbers in it by
/// their value (`9.png` before `10.png`). If all names differ in one decimal number with more than
/// one length of fraction (`7.15.png`, `7.2.png`), it is read as a decimal or as seconds and
/// nanoseconds without leading zeros, depending on which gives the more even time steps.
void sort_by_name(std::vector<std::string>& paths);

}  // namespace placegraph
