#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Makes one vector of an image: a global descriptor for place recognition.
///
/// Two images resemble each other as much as the inner product of their descriptors is large.
/// make_recognizer (pipeline/recognizers/image_recognizer.h) makes a PlaceRetrieval of it. An
/// object serves one caller at a time.
class ImageDescriber {
 public:
  virtual ~ImageDescriber() = default;

  /// Returns the descriptor of the image of a frame; all have the length of the first.
  ///
  /// `image` is grey or BGR, 8 bits, and valid during the call alone. `frame` is the number of the
  /// image in its folder, or of the frame in its sequence. What cannot be described is an
  /// exception.
  virtual std::vector<float> describe(const Image& image, FrameId frame) = 0;
};

}  // namespace placegraph
