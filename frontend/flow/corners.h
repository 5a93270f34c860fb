#pragma once
#include <placegraph/graph/image/image.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A corner of an image.
struct Corner {
  float strength = 0;  ///< least eigenvalue of the gradient matrix per pixel, grey levels / 255
  int u = 0, v = 0;    ///< [px]
};

/// Detects corners (Shi & Tomasi 1994), row by row from the top.
///
/// A corner is a pixel whose gradient matrix, summed over 5x5 pixels, has a least eigenvalue above
/// `min_strength` and at least that of all eight neighbours. Gradients are Sobel's, in grey levels
/// / 255 per pixel. Nothing is found within `border` (at least 4) pixels of the sides, where
/// `blocked` is not 0, or where `mask` is 0 (each CV_8UC1 of the image's size, or empty). Throws
/// ArgumentError unless `image` is CV_8UC1.
///
/// OpenCV's cornerMinEigenVal with a 3x3 dilation finds the same corners (rendered and recorded
/// images: at least 999 of 1000 within 1 px), but takes three times as long on one thread: 4.9 ms
/// against 1.5 at 1226x370, 2.9 ms against 1.0 at 640x480. It sums floats where this sums whole
/// numbers, so the strengths differ in their last bits. goodFeaturesToTrack takes 7.3 and 4.1 ms,
/// and its threshold is relative to the strongest corner of the image.
std::vector<Corner> find_corners(const Image& image, double min_strength, int border,
                                 const Image& blocked = {}, const Image& mask = {});

}  // namespace placegraph
