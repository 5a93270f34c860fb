#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/file_bytes.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/pipeline/recognizers/onnx_describer.h>
#include <placegraph/pipeline/recognizers/onnx_model.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// The numbers of "0.485,0.456,0.406": one, or one a channel.
std::vector<double> numbers_of(const std::string& key, std::string_view text, int channels) {
  std::vector<std::string_view> fields;
  split_comma(text, fields);
  std::vector<double> numbers;
  for (const std::string_view field : fields) {
    const auto number = parse_double(field);
    require(number && std::isfinite(*number),
            fmt::format("recognizer onnx: {}={}: numbers are needed", key, text));
    numbers.push_back(*number);
  }
  require(numbers.size() == 1 || numbers.size() == static_cast<std::size_t>(channels),
          fmt::format("recognizer onnx: {}={}: one number is needed, or {}", key, text, channels));
  return numbers;
}

/// Layout and size of the model's input.
NetworkInput input_of(const OnnxInput& model, const std::string& path) {
  const auto& shape = model.shape;
  const auto is_colour = [&](std::size_t i) { return shape[i] == 1 || shape[i] == 3; };
  const bool picture = shape.size() == 4 && shape[0] <= 1 && (is_colour(1) || is_colour(3));
  if (!picture)
    throw FileError(path, fmt::format("its input {} of shape {} is no picture: 1 x 3 x height x "
                                      "width, with 1 or 3 channels, before or behind the sizes",
                                      model.name, fmt::join(shape, " x ")));
  NetworkInput input;
  input.channels_last = !is_colour(1);
  input.channels = static_cast<int>(shape[input.channels_last ? 3 : 1]);
  input.height = static_cast<int>(shape[input.channels_last ? 1 : 2]);
  input.width = static_cast<int>(shape[input.channels_last ? 2 : 3]);
  return input;
}

/// Takes the size "WxH" where the model has none.
void set_size(std::string_view text, NetworkInput& input) {
  const auto x = text.find('x');
  const auto width = parse_integer(text.substr(0, x));
  const auto height = x == text.npos ? std::nullopt : parse_integer(text.substr(x + 1));
  constexpr int kMost = 1 << 14;
  require(width && height && *width > 0 && *height > 0 && *width <= kMost && *height <= kMost,
          fmt::format("recognizer onnx: size={}: WIDTHxHEIGHT [px] is needed", text));
  require(
      (input.width == 0 || input.width == *width) && (input.height == 0 || input.height == *height),
      fmt::format("recognizer onnx: size={}: the model's input has {} x {} pixels", text,
                  input.width, input.height));
  input.width = static_cast<int>(*width);
  input.height = static_cast<int>(*height);
}

}  // namespace

Image network_input(const Image& image, const NetworkInput& input) {
  cv::Mat converted, pixels;  // of their own, as the image must not change
  if (input.channels == 1 && image.channels() == 3) {
    cv::cvtColor(image, converted, cv::COLOR_BGR2GRAY);
  } else if (input.channels == 3 && image.channels() == 1) {
    cv::cvtColor(image, converted, cv::COLOR_GRAY2BGR);
  } else if (input.channels == 3 && !input.bgr) {
    cv::cvtColor(image, converted, cv::COLOR_BGR2RGB);
  } else {
    converted = image;
  }
  const bool smaller = input.width <= image.cols && input.height <= image.rows;
  cv::resize(converted, pixels, {input.width, input.height}, 0, 0,
             smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
  const int channels_first[] = {1, input.channels, input.height, input.width};
  const int channels_last[] = {1, input.height, input.width, input.channels};
  Image blob(4, input.channels_last ? channels_last : channels_first, CV_32F);
  auto* values = blob.ptr<float>();
  const auto area = static_cast<std::size_t>(input.width) * static_cast<std::size_t>(input.height);
  const auto channels = static_cast<std::size_t>(input.channels);
  for (std::size_t c = 0; c < channels; ++c) {
    const double mean = input.mean[std::min(c, input.mean.size() - 1)],
                 scale = input.scale[std::min(c, input.scale.size() - 1)];
    for (std::size_t i = 0; i < area; ++i) {
      const std::size_t y = i / static_cast<std::size_t>(input.width),
                        x = i % static_cast<std::size_t>(input.width);
      const double value = pixels.ptr(static_cast<int>(y))[x * channels + c];
      values[input.channels_last ? i * channels + c : c * area + i] =
          static_cast<float>((value - mean) * scale);
    }
  }
  return blob;
}

OnnxDescriber::OnnxDescriber(const std::string& spec) : path_(spec.substr(0, spec.find('?'))) {
  const std::string bytes = read_bytes(path_);
  input_ = input_of(read_onnx_input(bytes, path_), path_);
  std::vector<std::string_view> settings;
  if (path_.size() < spec.size())
    split_at('&', std::string_view(spec).substr(path_.size() + 1), settings);
  for (const std::string_view setting : settings) {
    const auto equals = std::min(setting.find('='), setting.size());
    const std::string key(setting.substr(0, equals));
    const std::string_view value = setting.substr(std::min(equals + 1, setting.size()));
    if (key == "size") {
      set_size(value, input_);
    } else if (key == "mean" || key == "scale") {
      (key == "mean" ? input_.mean : input_.scale) = numbers_of(key, value, input_.channels);
    } else if (key == "order") {
      require(value == "rgb" || value == "bgr",
              fmt::format("recognizer onnx: order={}: rgb or bgr", value));
      input_.bgr = value == "bgr";
    } else {
      require(key == "output", fmt::format("recognizer onnx: {} is none of size, mean, scale, "
                                           "order, output",
                                           in_quotes(setting)));
      output_ = value;
    }
  }
  require(
      input_.width > 0 && input_.height > 0,
      fmt::format("recognizer onnx:{}: the model takes any size: add ?size=WIDTHxHEIGHT", path_));
  std::string problem;
  network_ = network_plugin(path_).load_onnx(bytes, problem);
  if (!network_)
    throw FileError(path_, fmt::format("OpenCV {} cannot load it: {}", CV_VERSION, problem));
}

std::vector<float> OnnxDescriber::describe(const Image& image, FrameId frame) {
  std::string problem;
  std::vector<float> values = network_->run(network_input(image, input_), output_, problem);
  if (values.empty())
    throw FileError(path_, fmt::format("image {}: OpenCV {} cannot compute it: {}", frame.value(),
                                       CV_VERSION, problem));
  return values;
}

}  // namespace placegraph
