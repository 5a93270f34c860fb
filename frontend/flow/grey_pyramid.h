#pragma once
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// Pyramid of a grey image in float, smoothed by a pixel.
///
/// Pixel (u, v) of level i is pixel 2^i (u, v) of the image. There are fewer levels than requested
/// if a side would fall below 8 pixels. Throws ArgumentError unless `grey` is CV_8UC1 and not
/// empty.
std::vector<Image> grey_pyramid(const Image& grey, int levels);

/// Value of an image between its pixels, and its derivatives.
struct GreySample {
  double value = 0, du = 0, dv = 0;
};

/// Bicubic interpolation (Catmull-Rom: Keys 1981, a = -1/2) of a CV_32FC1 image.
///
/// The derivatives are the exact ones of the interpolant. Precondition:
/// inside_bicubic(image, u, v).
GreySample sample_bicubic(const Image& image, double u, double v);
double value_bicubic(const Image& image, double u, double v);

inline bool inside_bicubic(const Image& image, double u, double v) {
  return u >= 1 && v >= 1 && u < image.cols - 2 && v < image.rows - 2;
}

}  // namespace placegraph
