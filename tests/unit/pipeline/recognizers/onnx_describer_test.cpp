#include <fmt/format.h>
#include <gmock/gmock.h>
#include <placegraph/frontend/places/cues/gradient_layout.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/recognizers/onnx_describer.h>
#include <placegraph/pipeline/recognizers/onnx_model.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "tests/support/message_of.h"
#include "tests/support/paths.h"
#include "tests/unit/pipeline/recognizers/scripted_program.h"

namespace placegraph {
namespace onnx_describer_test {

using test::message_of;
using test::noise;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// The file of a network of tests/support/onnx_models.py.
std::string model(const std::string& kind) {
  static const test::TemporaryFolder folder;
  const std::string path = folder / kind + ".onnx";
  const std::string command =
      fmt::format("python3 {}/tests/support/onnx_models.py {} {}", test::source_dir(), kind, path);
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return path;
}

std::vector<float> describe(const std::string& spec, const Image& image) {
  return OnnxDescriber(spec).describe(image, FrameId(0));
}

std::vector<double> unit(const std::vector<float>& values) {
  double squares = 0;
  for (const float value : values) squares += static_cast<double>(value) * value;
  std::vector<double> result;
  for (const float value : values) result.push_back(value / std::sqrt(squares));
  return result;
}

TEST(OnnxDescriber, ComputesTheHistogramsOfGradientsAsTheCueDoes) {
  OnnxDescriber network(model("gradients") + "?scale=1");
  for (int seed = 0; seed < 20; ++seed) {
    // Noise, ever more blurred: from steep gradients to hardly any.
    Image image = noise(96, 72, CV_8UC1, static_cast<std::uint64_t>(seed));
    if (seed > 0) cv::GaussianBlur(image, image, {0, 0}, 0.5 * seed);
    const std::vector<double> theirs = unit(network.describe(image, FrameId(seed))),
                              ours = unit(gradient_layout(image));
    ASSERT_EQ(theirs.size(), ours.size());
    for (std::size_t i = 0; i < ours.size(); ++i)
      ASSERT_NEAR(theirs[i], ours[i], 1e-5) << "image " << seed << ", value " << i;
  }
}

TEST(OnnxDescriber, TakesSizeAndChannelsOfTheModelAndSubtractsTheMeanOfEachChannel) {
  const Image image = noise(24, 16, CV_8UC3, 3);
  const cv::Scalar bgr = cv::mean(image);
  const std::vector<float> values =
      describe(model("mean") + "?mean=10,20,30&scale=0.5,0.25,2", image);
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(cv::mean(image), bgr) << "the image has changed";
  const double scale[] = {0.5, 0.25, 2}, mean[] = {10, 20, 30};
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(values[static_cast<std::size_t>(c)], scale[c] * (bgr[2 - c] - mean[c]), 1e-3);
  const std::vector<float> turned = describe(model("mean") + "?order=bgr", image);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(turned[static_cast<std::size_t>(c)], bgr[c] / 255, 1e-5);
  // An image of another size is resized: areas keep their mean.
  Image large;
  cv::resize(image, large, {}, 3, 3, cv::INTER_NEAREST);
  const std::vector<float> same = describe(model("mean"), large),
                           whole = describe(model("mean"), image);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(same[static_cast<std::size_t>(c)], whole[static_cast<std::size_t>(c)], 1e-5);
  const std::vector<float> grey = describe(model("mean"), noise(24, 16, CV_8UC1, 4));
  EXPECT_EQ(grey[0], grey[1]);
  EXPECT_EQ(grey[0], grey[2]);
}

TEST(OnnxDescriber, TakesTheLayoutWhoseChannelsAreLast) {
  const Image image = noise(3, 2, CV_8UC3, 5);
  const std::vector<float> values = describe(model("last") + "?scale=1", image);
  ASSERT_EQ(values.size(), 18u);
  for (int i = 0; i < 18; ++i)
    EXPECT_EQ(values[static_cast<std::size_t>(i)], image.ptr(i / 9)[i % 9 / 3 * 3 + 2 - i % 3])
        << i;
}

TEST(OnnxDescriber, AModelOfAnySizeNeedsOne) {
  EXPECT_THAT(message_of<ArgumentError>([] { describe(model("any"), noise(9, 9, CV_8UC3, 1)); }),
              HasSubstr("any.onnx: the model takes any size: add ?size=WIDTHxHEIGHT"));
  const Image image = noise(40, 30, CV_8UC3, 1);
  const std::vector<float> values = describe(model("any") + "?size=40x30", image);
  EXPECT_NEAR(values.at(0), cv::mean(image)[2] / 255, 1e-5);
}

TEST(OnnxDescriber, APartThatOpenCvDoesNotKnowIsNamedInOneLine) {
  const std::string path = model("unknown");
  testing::internal::CaptureStderr();
  const std::string message = message_of([&] { OnnxDescriber describer(path); });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(message, AllOf(StartsWith(path + ": OpenCV "), HasSubstr("cannot load it: "),
                             HasSubstr("Frobnicate"), HasSubstr("n1"), Not(HasSubstr("\n")),
                             Not(HasSubstr("layer_internals"))));
}

TEST(OnnxDescriber, WhatIsNoModelOfPicturesIsRefused) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(message_of([] { OnnxDescriber describer(model("list")); }),
              HasSubstr("list.onnx: its input image of shape 1 x 16 is no picture"));
  EXPECT_THAT(message_of([&] { OnnxDescriber describer(folder / "none.onnx"); }),
              HasSubstr("none.onnx: cannot be read"));
  EXPECT_THAT(message_of([&] { OnnxDescriber describer(folder.write("text.onnx", "a text")); }),
              HasSubstr("text.onnx: byte "));
  EXPECT_THAT(message_of([&] { OnnxDescriber describer(folder.write("empty.onnx", "")); }),
              HasSubstr("empty.onnx: is no ONNX model with an input"));
  const std::string mean = model("mean");
  for (const auto& [settings, message] : std::vector<std::pair<std::string, std::string>>{
           {"?size=20x16", "size=20x16: the model's input has 24 x 16 pixels"},
           {"?size=20", "size=20: WIDTHxHEIGHT [px] is needed"},
           {"?size=-1x3", "WIDTHxHEIGHT [px] is needed"},
           {"?mean=1,2", "mean=1,2: one number is needed, or 3"},
           {"?scale=a", "scale=a: numbers are needed"},
           {"?scale=nan", "scale=nan: numbers are needed"},
           {"?order=grb", "order=grb: rgb or bgr"},
           {"?colour=1", "'colour=1' is none of size, mean, scale, order, output"}})
    EXPECT_THAT(message_of<ArgumentError>([&] { OnnxDescriber describer(mean + settings); }),
                HasSubstr(message));
  OnnxDescriber describer(mean + "?output=no_such_layer");
  EXPECT_THAT(message_of([&] { describer.describe(noise(9, 9, CV_8UC3, 1), FrameId(4)); }),
              AllOf(HasSubstr("mean.onnx: image 4: OpenCV "), Not(HasSubstr("\n"))));
}

TEST(OnnxModel, EveryBeginningOfAModelIsReadOrRefused) {
  const std::string bytes = test::read_file(model("mean"));
  const OnnxInput input = read_onnx_input(bytes, "m.onnx");
  EXPECT_EQ(input.name, "image");
  EXPECT_THAT(input.shape, ElementsAre(1, 3, 16, 24));
  EXPECT_THAT(read_onnx_input(test::read_file(model("any")), "a").shape, ElementsAre(0, 3, 0, 0));
  int refused = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) try {
      EXPECT_EQ(read_onnx_input(bytes.substr(0, size), "m.onnx").name, "image");
    } catch (const FileError&) {
      ++refused;
    }
  EXPECT_GT(refused, static_cast<int>(bytes.size()) / 2);
  // Any other byte in any place makes another model, or none.
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0xff);
    try {
      EXPECT_LE(read_onnx_input(damaged, "m.onnx").shape.size(), bytes.size());
    } catch (const FileError& error) {
      EXPECT_THAT(error.what(), StartsWith("m.onnx: "));
    }
  }
}

}  // namespace onnx_describer_test
}  // namespace placegraph
