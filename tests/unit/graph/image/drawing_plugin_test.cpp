#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/internal/image/drawing_plugin.h>

#include <algorithm>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace {

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

}  // namespace
}  // namespace placegraph
