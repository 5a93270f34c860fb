#pragma once
#include <placegraph/graph/image/image.h>

#include <string>

namespace placegraph::apps {

/// Draws flow (CV_32FC2) in colour over the grey first image, with a wheel of its colours below.
/// The hue is its direction, the saturation its size relative to that of the largest tenth; grey is
/// unknown. Flow of single points is drawn as arrows. CV_8UC3. `wanted` names the purpose. Throws
/// FileError if the module that draws the legend is missing.
Image draw_flow(const Image& grey, const Image& flow, const std::string& wanted);

}  // namespace placegraph::apps
