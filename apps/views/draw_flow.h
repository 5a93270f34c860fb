#pragma once
#include <placegraph/graph/image/image.h>

namespace placegraph::apps {

/// Draws flow (CV_32FC2) in colour over the grey first image.
/// The hue is its direction, the saturation its size relative to that of the largest tenth; grey is
/// unknown. Flow of single points is drawn as arrows. CV_8UC3.
Image draw_flow(const Image& grey, const Image& flow);

}  // namespace placegraph::apps
