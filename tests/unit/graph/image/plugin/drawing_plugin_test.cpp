#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/drawing_plugin.h>

#include <algorithm>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace drawing_plugin_test {

using test::message_of;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kSquare =
    "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"40\" height=\"30\" viewBox=\"0 0 40 30\">"
    "<rect x=\"10\" y=\"10\" width=\"10\" height=\"10\" fill=\"#102030\"/></svg>";

TEST(DrawingPlugin, DrawsOnWhiteInTheSizeOfTheViewBox) {
  const DrawingPlugin& plugin = drawing_plugin("a test");
  const DrawingPixels pixels = plugin.rasterize(kSquare, 1);
  ASSERT_EQ(pixels.width, 40);
  ASSERT_EQ(pixels.height, 30);
  const auto at = [&](int u, int v) {
    const auto first = pixels.bgra.begin() + 4 * (40 * v + u);
    return std::vector<int>(first, first + 4);
  };
  EXPECT_EQ(at(0, 0), (std::vector<int>{255, 255, 255, 255}));
  EXPECT_EQ(at(15, 15), (std::vector<int>{0x30, 0x20, 0x10, 255}));
  EXPECT_EQ(plugin.rasterize(kSquare, 2.5).width, 100);
}

TEST(DrawingPlugin, AScaledPictureHasItsAreaTimesTheSquareOfTheScale) {
  for (const double scale : {0.5, 1.0, 3.0}) {
    const DrawingPixels pixels = drawing_plugin("a test").rasterize(kSquare, scale);
    double covered = 0;  // shares of pixels, the red of the square is 16
    for (std::size_t i = 2; i < pixels.bgra.size(); i += 4) {
      covered += (255 - pixels.bgra[i]) / (255.0 - 16);
      ASSERT_EQ(pixels.bgra[i + 1], 255);
    }
    EXPECT_EQ(pixels.bgra.size(), static_cast<std::size_t>(4 * pixels.width * pixels.height));
    // A pixel that is covered in part is rounded to one of 255 greys: at most 40 of them.
    EXPECT_NEAR(covered, 100 * scale * scale, 40 / 255.0);
  }
}

TEST(DrawingPlugin, MixesWhatIsTransparentWithTheGround) {
  std::string half = kSquare;
  half.insert(half.find("fill=") + 14, " fill-opacity=\"0.5\"");
  const DrawingPixels pixels = drawing_plugin("a test").rasterize(half, 1);
  const std::size_t middle = 4 * (40 * 15 + 15);
  EXPECT_NEAR(pixels.bgra.at(middle + 2), (255 + 16) / 2, 1);
  EXPECT_NEAR(pixels.bgra.at(middle), (255 + 48) / 2, 1);
}

TEST(DrawingPlugin, WritesLettersOfAFont) {
  const std::string text =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200\" height=\"40\" viewBox=\"0 0 200 40\" "
      "font-family=\"DejaVu Sans\"><text x=\"5\" y=\"30\" font-size=\"24\">WWWWW</text></svg>";
  const DrawingPixels pixels = drawing_plugin("a test").rasterize(text, 1);
  int last = 0;
  for (int v = 0; v < pixels.height; ++v)
    for (int u = 0; u < pixels.width; ++u)
      if (pixels.bgra[static_cast<std::size_t>(4 * (pixels.width * v + u))] < 128)
        last = std::max(last, u);
  EXPECT_NEAR(last, 5 + 5 * 0.989 * 24, 4);  // as wide as text_width() of eval says
}

TEST(DrawingPlugin, MakesTheSamePageOfTheSamePicture) {
  const DrawingPlugin& plugin = drawing_plugin("a test");
  const std::string pdf = plugin.pdf(kSquare);
  EXPECT_THAT(pdf, StartsWith("%PDF"));
  EXPECT_THAT(pdf, AllOf(HasSubstr("%%EOF"), HasSubstr("[ 0 0 30 22.5 ]")));
  EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
  EXPECT_EQ(pdf, plugin.pdf(kSquare));
}

TEST(DrawingPlugin, GivesNothingForWhatIsNoPicture) {
  const DrawingPlugin& plugin = drawing_plugin("a test");
  for (const char* text : {"", "no svg", "<svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>"}) {
    EXPECT_TRUE(plugin.rasterize(text, 1).bgra.empty()) << text;
    EXPECT_TRUE(plugin.pdf(text).empty()) << text;
  }
  EXPECT_TRUE(plugin.rasterize(kSquare, 0).bgra.empty());
  EXPECT_TRUE(plugin.rasterize(kSquare, 1e6).bgra.empty());
}

TEST(DrawingPlugin, AMissingModuleIsReportedInOneLine) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of([&] { load_drawing_plugin({folder / "a"}, "plot.png"); }),
              AllOf(StartsWith("plot.png: needs the module libplacegraph_drawing_plugin.so"),
                    HasSubstr("librsvg2-2 and fonts-dejavu-core"), Not(HasSubstr("\n"))));
  folder.write(kDrawingPluginFile, "no shared library");
  EXPECT_THAT(message_of([&] { load_drawing_plugin({folder / "."}, "plot.png"); }),
              HasSubstr("cannot be loaded ("));
}

}  // namespace drawing_plugin_test
}  // namespace placegraph
