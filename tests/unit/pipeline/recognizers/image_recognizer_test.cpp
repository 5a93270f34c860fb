#include <gmock/gmock.h>
#include <placegraph/frontend/places/descriptors/image_describer.h>
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/npy_array.h>
#include <placegraph/pipeline/recognizers/descriptor_file.h>
#include <placegraph/pipeline/recognizers/image_recognizer.h>

#include <filesystem>
#include <limits>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace image_recognizer_test {

using test::message_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(DescriptorFile, ARowIsTheDescriptorOfAnImage) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("d.npy", to_npy({{3, 2}, {1, 2, 3, 4, 5, 6}}));
  DescriptorFile file(path);
  EXPECT_THAT(file.describe({}, FrameId(2)), ElementsAre(5, 6));
  EXPECT_THAT(file.describe({}, FrameId(0)), ElementsAre(1, 2));
  EXPECT_EQ(message_of([&] { file.describe({}, FrameId(3)); }),
            path + ": has 3 rows, and none for image 3");
}

TEST(DescriptorFile, WhatIsNoMatrixOfNumbersIsRefused) {
  const test::TemporaryFolder folder;
  const auto refusal = [&](const std::string& bytes) {
    const std::string path = folder.write("d.npy", bytes);
    return message_of([&] { DescriptorFile file(path); });
  };
  EXPECT_THAT(refusal(to_npy({{3}, {1, 2, 3}})), HasSubstr("d.npy: descriptors are a matrix"));
  EXPECT_THAT(refusal(to_npy({{0, 2}, {}})), HasSubstr("d.npy: descriptors are a matrix"));
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), 1e300})
    EXPECT_THAT(refusal(to_npy({{3, 2}, {1, 2, 3, 4, wrong, 6}})),
                HasSubstr("d.npy: row 2 (from 0): a value is not finite"));
  EXPECT_THAT(refusal("no numpy"), HasSubstr("d.npy: "));
  EXPECT_THAT(message_of([&] { DescriptorFile file(folder / "none.npy"); }),
              HasSubstr("none.npy: cannot be read"));
}

TEST(OpenDescriber, KnowsThreeKindsAndNamesWhatIsNone) {
  for (const char* name : {"", "exec", "exec:", "shell:ls", "netvlad", "descriptors:", ":x"})
    EXPECT_THAT(message_of<ArgumentError>([&] { open_describer(name); }),
                HasSubstr("is none of exec:COMMAND, onnx:FILE, descriptors:FILE.npy"))
        << name;
  EXPECT_THAT(message_of([&] { open_describer("onnx:no/file.onnx?size=3x4"); }),
              StartsWith("no/file.onnx: "));
}

TEST(OpenDescriber, StartsNoProgramBeforeTheFirstImage) {
  const test::TemporaryFolder folder;
  const std::string marker = folder / "marker";
  { const auto describer = open_describer("exec:touch " + marker); }
  EXPECT_FALSE(std::filesystem::exists(marker));
}

TEST(MakeRecognizer, NamesACueThatIsNone) {
  const test::TemporaryFolder folder;
  const auto file = open_describer("descriptors:" + folder.write("d.npy", to_npy({{1, 1}, {1}})));
  DescriberOptions options;
  options.beside = "tiny,smell";
  EXPECT_THAT(message_of<ArgumentError>([&] { make_recognizer(file, options, {}); }),
              HasSubstr("'smell' is none of tiny, colour, gradients, gabor, corners"));
  options.beside.clear();
  options.timeout_s = 0;
  EXPECT_THAT(message_of<ArgumentError>([&] { make_recognizer(file, options, {}); }),
              HasSubstr("timeout_s"));
}

TEST(RequireNoRecognizer, RefusesOptionsThatNameOne) {
  DescriberOptions options;
  options.timeout_s = 7;
  EXPECT_NO_THROW(require_no_recognizer(options, "a.yaml"));
  options.recognizer = "exec:rm x";
  EXPECT_THAT(
      message_of<ArgumentError>([&] { require_no_recognizer(options, "a.yaml"); }),
      AllOf(StartsWith("a.yaml: describer.recognizer 'exec:rm x': "), HasSubstr("--recognizer")));
  options.recognizer.clear();
  options.beside = "tiny";
  EXPECT_EQ(message_of<ArgumentError>([&] { require_no_recognizer(options, "--set"); }),
            "--set: describer.beside 'tiny': give it as --appearance");
}

TEST(RequireRecognizerAgain, NamesTheRecognizerOfAMapInOneLine) {
  DescriberOptions begun;
  EXPECT_NO_THROW(require_recognizer_again(begun, "map.db", false));
  begun.recognizer = "exec:describe \x1b[2J\n--fast";
  EXPECT_NO_THROW(require_recognizer_again(begun, "map.db", true));
  EXPECT_EQ(message_of([&] { require_recognizer_again(begun, "map.db", false); }),
            "map.db: its loops were found by the recognizer 'exec:describe ?[2J?--fast', which "
            "must be given again (--recognizer)");
  begun.recognizer.assign(10000, 'x');
  EXPECT_LT(message_of([&] { require_recognizer_again(begun, "map.db", false); }).size(), 400u);
}

}  // namespace image_recognizer_test
}  // namespace placegraph
