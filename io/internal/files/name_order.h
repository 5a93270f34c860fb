#pragma once
#include <string>
#include <vector>

namespace placegraph {

/// Sorts names of frames into the order in which they were taken: by their text, numbers in it by
/// their size (`9.png` before `10.png`). Where all names differ in one decimal number with more
/// than one length of fraction (`7.15.png`, `7.2.png`), it is read as decimal or as seconds and
/// nanoseconds without leading zeros, whichever leaves the more even distances in time.
void sort_by_name(std::vector<std::string>& paths);

}  // namespace placegraph
