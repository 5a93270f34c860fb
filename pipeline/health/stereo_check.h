#pragma once
#include <placegraph/frontend/features/row_offsets.h>
#include <placegraph/io/datasets/dataset.h>

namespace placegraph {

/// Measures how well the rows of a stereo pair correspond, with features of one pair in twenty, at
/// most four, spread over a sequence that can be run as stereo. Unreadable images are skipped; the
/// run itself reports them.
RowOffsets check_rows(const Dataset& dataset);

/// Reports errors of the rectification and possible remedies; nothing for a rectified pair, and if
/// there are too few matches. All of these errors make the scale doubtful:
///  - swapped cameras: most matches are farther right in the image of the right camera;
///  - rows that do not match: by more than three quarters of a pixel (root mean square), or by a
///    zoom that would bend disparities by more than one and a half pixels;
///  - matches that do not agree on any rows.
std::optional<DataNote> odd_rows(const RowOffsets& offsets, const Camera& camera);

}  // namespace placegraph
