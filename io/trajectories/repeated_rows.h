#pragma once
#include <placegraph/graph/geometry/repeated_stamps.h>

namespace placegraph {

/// The warning of repeated_stamps_warning about the lines of a file.
/// Throws FileError if more lines are left out than kept: then no line is bad, but all times have
/// lost digits.
std::string repeated_rows_warning(const std::string& path, const std::vector<StampedPose>& kept,
                                  const std::vector<RepeatedStamp>& left_out);

}  // namespace placegraph
