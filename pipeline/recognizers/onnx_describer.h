#pragma once
#include <placegraph/frontend/places/descriptors/image_describer.h>
#include <placegraph/graph/image/network_plugin.h>

#include <memory>
#include <string>
#include <vector>

namespace placegraph {

/// How an image becomes the input of a network: (value - mean) * scale, channel by channel.
struct NetworkInput {
  int width = 0, height = 0;
  int channels = 3;            ///< 3: colour, 1: grey
  bool channels_last = false;  ///< whether the layout is N x height x width x channels
  bool bgr = false;            ///< whether blue is the first channel, not red
  std::vector<double> mean{0}, scale{1.0 / 255};  ///< one number, or one a channel
};

/// Computes the descriptors of images by the network of an ONNX file, with OpenCV's dnn.
class OnnxDescriber : public ImageDescriber {
 public:
  /// `spec`: FILE[?size=WxH&mean=...&scale=...&order=bgr&output=NAME] of docs/recognizers.md.
  ///
  /// Throws FileError for a file that is no model, one whose input is no picture, or one with a
  /// layer that this version of OpenCV does not know, which is named; ArgumentError for an unknown
  /// key or value, or if neither the model nor `spec` states the size.
  explicit OnnxDescriber(const std::string& spec);

  /// All values of the output in one row. Throws FileError if the network cannot be computed.
  std::vector<float> describe(const Image& image, FrameId frame) override;

 private:
  std::string path_, output_;
  NetworkInput input_;
  std::unique_ptr<ImageNetwork> network_;
};

/// The input of a network for an image that is grey or BGR, 8 bits: CV_32F of four dimensions.
///
/// The image is resized without regard to its shape: by areas where it is reduced, else linearly.
Image network_input(const Image& image, const NetworkInput& input);

}  // namespace placegraph
