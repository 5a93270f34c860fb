#pragma once
#include <placegraph/graph/image/image.h>

namespace placegraph {

/// Light and sharpness of a grey image.
struct ImageStatistics {
  double mean = 0;     ///< [grey levels]
  double range = 0;    ///< between the 2nd and the 98th percentile [grey levels]
  double white = 0;    ///< share of pixels with the greatest grey level
  double uniform = 0;  ///< largest share of the pixels within three successive levels below 255
  /// Mean squared difference of grey levels two pixels apart, divided by that of eight pixels
  /// apart; the smaller ratio of rows and columns. White noise gives 1, an image that is smooth
  /// over eight pixels 1/16. 0 if all grey levels are equal.
  double detail = 0;
};

/// Measures every fifth row of a CV_8UC1 image of at least 16 x 16 pixels; zeros for smaller ones.
ImageStatistics image_statistics(const Image& image);

}  // namespace placegraph
