#pragma once
#include <placegraph/graph/image/image.h>

namespace placegraph::apps {

/// Flow (CV_32FC2) in colour over the grey image it starts from: hue is its direction, strength its
/// size beside that of the largest tenth; grey where nothing is known. Flow of single points is
/// drawn as arrows. CV_8UC3.
Image draw_flow(const Image& grey, const Image& flow);

}  // namespace placegraph::apps
