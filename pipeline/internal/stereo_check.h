#pragma once
#include <placegraph/frontend/internal/features/row_offsets.h>
#include <placegraph/io/datasets/dataset.h>

namespace placegraph {

/// How well the rows of two eyes correspond, by features of one pair in twenty, four at most,
/// spread over a sequence that can be run as stereo. Unreadable images are passed over: whoever
/// runs it says so.
RowOffsets check_rows(const Dataset& dataset);

/// What is odd about it, with what to try; nothing for a rectified pair, and where there are too
/// few matches to tell. All of it doubts the scale.
///  - swapped eyes: most matches lie farther right in the right eye's image;
///  - rows that do not match: by more than three quarters of a pixel (root mean square), or by a
///    zoom that would bend disparities by more than one and a half pixels;
///  - matches that agree on no rows at all.
std::optional<DataNote> odd_rows(const RowOffsets& offsets, const Camera& camera);

}  // namespace placegraph
