#pragma once
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// An image in float, smoothed by a pixel, and its halvings: pixel (u, v) of level i is pixel 2^i
/// (u, v) of the image. Throws ArgumentError unless `grey` is CV_8UC1 and not empty. There are
/// fewer levels than asked for where a side would fall below 8 pixels.
std::vector<Image> grey_pyramid(const Image& grey, int levels);

/// Value of an image between its pixels, and its derivatives.
struct GreySample {
  double value = 0, du = 0, dv = 0;
};

/// Bicubic interpolation (Catmull-Rom: Keys 1981, a = -1/2) of a CV_32FC1 image with the exact
/// derivatives of the interpolant. Precondition: inside_bicubic(image, u, v).
GreySample sample_bicubic(const Image& image, double u, double v);
double value_bicubic(const Image& image, double u, double v);

inline bool inside_bicubic(const Image& image, double u, double v) {
  return u >= 1 && v >= 1 && u < image.cols - 2 && v < image.rows - 2;
}

}  // namespace placegraph
