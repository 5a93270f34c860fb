#pragma once
#include <placegraph/frontend/flow/point_tracker.h>

namespace placegraph {

/// Tracks all points into `image`, for a step that is too wide for a search by intensities.
///
/// ORB features of the tracker's last image and of `image` (CV_8UC1, of equal size) are matched by
/// their descriptors. Each point is searched near its position displaced by the median of the
/// matches around it. Returns whether enough features match; otherwise the tracker is unchanged.
bool track_near_matches(PointTracker& tracker, const Image& image);

}  // namespace placegraph
