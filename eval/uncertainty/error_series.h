#pragma once
#include <placegraph/eval/trajectory/kitti_segments.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The error of what lies between two frames, in the unit of its figure.
struct StretchError {
  int first_frame = 0, last_frame = 0;  ///< first_frame <= last_frame
  double error = 0;                     ///< finite
};

/// Errors over stretches of one kind along a drive, by ascending first frame.
/// They may overlap, and frames may lack.
struct ErrorSeries {
  std::string stretch;               ///< the kind: "800 m", "1 s"; used in reasons
  std::vector<StretchError> errors;  ///< at least one

  /// Throws ArgumentError unless there are errors, finite and by ascending first frame.
  void check() const;
};

/// The errors in translation [%] of KITTI's segments, a series per length, by length.
std::vector<ErrorSeries> translation_series(const std::vector<SegmentError>& segments);
/// The errors in rotation [deg/100 m] of KITTI's segments, likewise.
std::vector<ErrorSeries> rotation_series(const std::vector<SegmentError>& segments);

}  // namespace placegraph
