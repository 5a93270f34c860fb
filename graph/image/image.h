#pragma once
#include <opencv2/core/mat.hpp>

namespace [[gnu::visibility("default")]] placegraph {

/// An image, reference-counted: copies share pixels.
/// Grey images are CV_8UC1, depth images CV_32FC1 in metres (0 where nothing was measured), masks
/// CV_8UC1 (0 = ignore). Pixel centres are at integer coordinates, (0, 0) is the centre of the top
/// left pixel; u points right, v down. This is the only type of OpenCV in a public header.
using Image = cv::Mat;

}  // namespace placegraph
