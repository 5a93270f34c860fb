#pragma once
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>

#include "tests/faults/recording.h"

namespace placegraph::faults {

/// Functions of which faults are made. None changes its arguments: images are copied before they
/// are drawn on.

/// Random numbers of a frame. OpenCV's generator makes an arithmetic progression of successive
/// seeds: these are mixed.
cv::RNG random_of(std::uint32_t seed, std::size_t index);

/// All frames.
Span whole(const Recording& recording);
/// The frames from one fraction of the sequence to another, at least one.
Span part(const Recording& recording, double from, double to);
/// As many frames in the middle.
Span middle(const Recording& recording, std::size_t count);

/// A new image from that of a frame; it must not change its argument.
using ImageChange = std::function<Image(const Image& image, std::size_t index)>;

/// Replaces the images of the left and right camera in a stretch.
Recording with_images(const Recording& recording, Span span, const ImageChange& change);
/// Replaces the images of the right camera in a stretch.
Recording with_right(const Recording& recording, Span span, const ImageChange& change);
/// Replaces the depth images (CV_32FC1 [m]) in a stretch.
Recording with_depth(const Recording& recording, Span span, const ImageChange& change);

/// The frames with these numbers, each with its own stamp and truth; numbers must ascend.
Recording with_kept(const Recording& recording, const std::vector<std::size_t>& numbers);
/// The frames with these numbers in this order, with their truth; the stamps are those of the
/// recording, continued by its median distance where there are more frames.
Recording with_order(const Recording& recording, const std::vector<std::size_t>& numbers);

/// The median distance of the stamps [ns]; 0.1 s if there is one frame.
std::int64_t median_distance_ns(const Recording& recording);

/// An image moved by (du, dv) [px]; the border is repeated.
Image shifted(const Image& image, double du, double dv, int interpolation);
/// The image of a camera with other intrinsics and orientation at the same place.
/// `H_source_result` maps homogeneous pixels of the result to those of the source.
Image warped(const Image& image, const Eigen::Matrix3d& H_source_result, int interpolation);

}  // namespace placegraph::faults
