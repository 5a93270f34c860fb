#include "apps/viewer/run_pages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/jpeg_codec.h>
#include <placegraph/io/exports/base64.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/pipeline/report/served_page.h>
#include <placegraph/pipeline/report/tables/column.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace run_pages_test {

using nlohmann::json;
using report::column;
using ::testing::HasSubstr;

/// A recording of three images and a map of it that lacks many of the landmarks that were seen.
class RunPagesTest : public ::testing::Test {
 protected:
  RunPagesTest() {
    test::write_numbered(dir, "seq", 3);
    dir.write("seq/calibration.yaml", "width: 8\nheight: 6\nfx: 10\nfy: 11\ncx: 4\ncy: 3\n");
    Random random(2);
    stored = test::random_map(random, 2);
    stored.origin.sequence = dir / "seq";
    stored.origin.lens_k1 = 0;
    stored.map.landmarks.resize(700);
    std::erase_if(stored.map.landmarks,
                  [](const PointLandmark& landmark) { return landmark.id.value() % 3 == 0; });
    dir.write("town/result.json", R"({"notes": ["the run was fast"]})");
    write_map(dir / "town/map.db", stored);
    write_map(dir / "other.db", stored);
  }
  test::TemporaryFolder dir;
  StoredMap stored;
};

TEST_F(RunPagesTest, ReportsAllRunsUnderTheirNames) {
  RunPages pages({dir / "town", dir / "other.db"}, "placegraph 7");
  EXPECT_EQ(pages.count(), 2U);
  EXPECT_EQ(pages.title(), "town, other");
  EXPECT_EQ(pages.first_path(), dir / "town/map.db");
  const HttpResponse response = pages.respond("report.json");
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.type, "application/json");
  const json report = json::parse(response.body);
  ASSERT_EQ(report["runs"].size(), 2U);
  EXPECT_EQ(report["runs"][0]["name"], "town");
  EXPECT_EQ(report["runs"][1]["name"], "other");
  EXPECT_THAT(response.body, HasSubstr("placegraph 7"));
}

TEST_F(RunPagesTest, AnObservationHasTheRowOfItsLandmark) {
  RunPages pages({dir / "other.db", dir / "town"}, "");
  for (const Keyframe& keyframe : stored.map.keyframes) {
    std::vector<float> expected;
    for (const LandmarkObservation& seen : keyframe.observations) {
      float row = -1;  // of a landmark that is not in the map
      for (std::size_t i = 0; i < stored.map.landmarks.size(); ++i)
        if (stored.map.landmarks[i].id == seen.landmark) row = static_cast<float>(i);
      expected.insert(expected.end(), {seen.px.x(), seen.px.y(), row});
    }
    for (const char* run : {"0", "1"}) {
      const HttpResponse response =
          pages.respond("runs/" + std::string(run) + "/frames/" +
                        std::to_string(keyframe.frame.value()) + "/observations.json");
      ASSERT_EQ(response.status, 200) << response.body;
      EXPECT_EQ(json::parse(response.body)["points"], column(expected, 3));
    }
  }
}

TEST_F(RunPagesTest, ImagesAreThoseOfTheRecording) {
  RunPages pages({dir / "town"}, "");
  for (int i : {2, 0, 1}) {
    const HttpResponse response =
        pages.respond("runs/0/frames/" + std::to_string(i) + "/image.jpg");
    EXPECT_EQ(response.status, 200);
    EXPECT_EQ(response.type, "image/jpeg");
    EXPECT_EQ(response.body, jpeg_of_page(test::tiny_grey(8, 6, i)));
  }
  EXPECT_EQ(pages.respond("runs/0/frames/3/image.jpg").body,
            "no frame 3 in " + (dir / "seq") + "\n");
  EXPECT_EQ(pages.respond("runs/0/frames/3/image.jpg").status, 404);
  std::filesystem::remove_all(dir / "seq");
  RunPages gone({dir / "town"}, "");  // the map can be shown all the same
  EXPECT_EQ(gone.respond("runs/0/frames/0/image.jpg").status, 404);
}

TEST_F(RunPagesTest, OtherPathsAreNotThere) {
  RunPages pages({dir / "town"}, "");
  for (const char* path : {"",
                           "report",
                           "report.json/",
                           "runs",
                           "runs/0",
                           "runs/0/frames/1",
                           "runs/0/frames/1/",
                           "runs/1/frames/1/image.jpg",
                           "runs/-1/frames/1/image.jpg",
                           "runs/0/frames/x/image.jpg",
                           "runs/0/frames/1x/image.jpg",
                           "runs/0/frames//image.jpg",
                           "runs/0/frames/-1/image.jpg",
                           "runs/0/frames/99999999999999999999/image.jpg",
                           "runs/0/frame/1/image.jpg",
                           "run/0/frames/1/image.jpg",
                           "/runs/0/frames/1/image.jpg",
                           "runs/0/frames/1/image.png",
                           "runs/0/frames/1/observations.json/",
                           "runs/0/frames/0/observations.json"})
    EXPECT_EQ(pages.respond(path).status, 404) << path;  // frame 0 is no keyframe
}

// Something is there, but cannot be shown: the program says what is wrong with it.
TEST_F(RunPagesTest, WhatIsDamagedIsNoMissingPage) {
  dir.write("town/result.json", "{");
  dir.write("seq/000001.png", "no image");
  RunPages pages({dir / "town"}, "");
  const HttpResponse report = pages.respond("report.json");
  EXPECT_EQ(report.status, 500);
  EXPECT_THAT(report.body, HasSubstr("result.json: is not valid JSON"));
  const HttpResponse image = pages.respond("runs/0/frames/1/image.jpg");
  EXPECT_EQ(image.status, 500);
  EXPECT_THAT(image.body, HasSubstr("000001.png"));
  EXPECT_EQ(pages.respond("runs/0/frames/0/image.jpg").status, 200);
  dir.write("seq/calibration.yaml", "width: 8\n");
  EXPECT_EQ(RunPages({dir / "town"}, "").respond("runs/0/frames/0/image.jpg").status, 500);
}

TEST_F(RunPagesTest, WhatLiesBesideAMapDoesNotBelongToAnEditedOne) {
  RunPages pages({dir / "town"}, "");
  const auto shown = [&] { return json::parse(pages.respond("report.json").body)["runs"][0]; };
  const json before = shown();
  EXPECT_EQ(before["notes"], json::array({"the run was fast"}));
  EXPECT_EQ(pages.first()->map.loops.size(), 2U);
  StoredMap edited = stored;
  edited.map.loops.clear();
  pages.show(std::make_shared<const StoredMap>(edited), true);
  EXPECT_TRUE(pages.first()->map.loops.empty());
  const json after = shown();
  EXPECT_EQ(after["notes"], json::array());
  EXPECT_EQ(after["name"], "town");
  EXPECT_EQ(after["folder"], before["folder"]);
  pages.show(std::make_shared<const StoredMap>(read_map(dir / "town/map.db")), false);
  EXPECT_EQ(shown(), before);
}

TEST_F(RunPagesTest, AMapThatCannotBeReadIsNamed) {
  EXPECT_THAT(test::message_of([&] {
                RunPages({dir / "town", dir / "none"}, "");
              }),
              HasSubstr("none: there is no such file"));
}

TEST(JsonResponse, IsValidWhateverTheBytesOfItsTexts) {
  const HttpResponse response = json_response({{"name", "a\xff\"b"}}, 409);
  EXPECT_EQ(response.status, 409);
  EXPECT_EQ(json::parse(response.body)["name"], "a\xef\xbf\xbd\"b");
}

TEST(JpegUrl, HoldsTheFileInBase64) {
  const Image image = test::tiny_grey(16, 12, 3);
  EXPECT_EQ(jpeg_url(image), "data:image/jpeg;base64," + to_base64(encode_jpeg(image, 90)));
  EXPECT_THAT(jpeg_url(image), HasSubstr(",/9j/"));  // ff d8 ff, as every JPEG file begins
}

}  // namespace run_pages_test
}  // namespace placegraph::apps
