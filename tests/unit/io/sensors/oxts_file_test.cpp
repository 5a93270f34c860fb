#include <placegraph/io/sensors/oxts_file.h>

#include <cmath>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace oxts_file_test {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

/// A reading: roll 0, heading north (yaw 90 deg), 10 m/s forward, 1 left, 0.5 up, 0.2 m accuracy.
std::string reading(const std::string& latitude = "49.5", const std::string& accuracy = "0.2") {
  return latitude +
         " 8.25 116.5 0 0 1.5707963267948966 10 1 10 1 0.5 0 0 9.8 0 0 9.8 0 0 0 0 0 0 " +
         accuracy + " 0.01 4 8 -1 -1 -1\n";
}

std::string reading_fails_with(const std::string& readings, const std::string& times) {
  const TemporaryFolder folder;
  folder.write("oxts.txt", readings);
  folder.write("times_oxts.txt", times);
  return message_of([&] { read_oxts(folder / "oxts.txt"); });
}

void write_drive(const TemporaryFolder& folder) {
  folder.write("oxts/data/0000000000.txt", reading());
  folder.write("oxts/data/0000000001.txt", reading("49.6"));
  folder.write("oxts/timestamps.txt",
               "2011-09-26 13:02:25.594360375\n2011-09-26 13:02:25.694360375\n");
}

TEST(KittiRaw, ReadsPositionAccuracyVelocityAndAttitude) {
  const TemporaryFolder folder;
  folder.write("oxts.txt", reading() + reading("49.6"));
  folder.write("times_oxts.txt", "0.0\n0.099998\n");
  for (const std::string& path : {folder / "oxts.txt", folder.path()}) {
    const auto fixes = read_oxts(path);
    ASSERT_EQ(fixes.size(), 2u);
    EXPECT_EQ(fixes[0].stamp_ns, 0);
    EXPECT_EQ(fixes[1].stamp_ns, 99998000);
    EXPECT_EQ(fixes[0].position.latitude_deg, 49.5);
    EXPECT_EQ(fixes[1].position.latitude_deg, 49.6);
    EXPECT_EQ(fixes[0].position.longitude_deg, 8.25);
    EXPECT_EQ(fixes[0].position.height_m, 116.5);
    EXPECT_EQ(fixes[0].accuracy_m, 0.2);
    // Forward is north, left is west.
    EXPECT_TRUE(fixes[0].velocity_enu->isApprox(Eigen::Vector3d(-1, 10, 0.5), 1e-12));
    EXPECT_TRUE(
        (*fixes[0].R_enu_body * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY()));
  }
}

TEST(KittiRaw, ReadsADriveWithItsDates) {
  const TemporaryFolder folder;
  write_drive(folder);
  for (const std::string& path : {folder.path(), folder / "oxts"}) {
    const auto fixes = read_oxts(path);
    ASSERT_EQ(fixes.size(), 2u);
    // 2011-09-26 00:00 UTC is 1316995200 s after 1970.
    EXPECT_EQ(fixes[0].stamp_ns,
              1316995200'000000000 + (13 * 3600 + 2 * 60 + 25) * 1000000000LL + 594360375);
    EXPECT_EQ(fixes[1].stamp_ns - fixes[0].stamp_ns, 100000000);
    EXPECT_EQ(fixes[1].position.latitude_deg, 49.6);
  }
}

TEST(KittiRaw, NamesTheLineOfABrokenReading) {
  EXPECT_THAT(reading_fails_with(reading() + "49 8 116\n", "0\n1\n"),
              HasSubstr("oxts.txt:2: expected the 30 numbers of an OXTS reading, found 3"));
  EXPECT_THAT(reading_fails_with(reading("nan"), "0\n"), HasSubstr("oxts.txt:1: number 1: 'nan'"));
  EXPECT_THAT(reading_fails_with(reading("north"), "0\n"),
              HasSubstr("oxts.txt:1: number 1: 'north'"));
  EXPECT_THAT(reading_fails_with(reading("95"), "0\n"), HasSubstr("oxts.txt:1: latitude"));
  EXPECT_THAT(reading_fails_with(reading("49", "-1"), "0\n"),
              HasSubstr("oxts.txt:1: pos_accuracy"));
}

TEST(KittiRaw, NamesTheLineOfABrokenTime) {
  EXPECT_THAT(reading_fails_with(reading() + reading(), "0\n0\n"),
              HasSubstr("times_oxts.txt:2: time '0' does not increase"));
  EXPECT_THAT(reading_fails_with(reading(), "2011-09-31 13:02:25\n"),
              HasSubstr("times_oxts.txt:1: '2011-09-31 13:02:25' is not a date"));
  EXPECT_THAT(reading_fails_with(reading(), "later\n"),
              HasSubstr("times_oxts.txt:1: time: 'later'"));
  EXPECT_THAT(reading_fails_with(reading(), ""), HasSubstr("times_oxts.txt: holds no times"));
}

TEST(KittiRaw, RefusesCountsThatDiffer) {
  EXPECT_THAT(reading_fails_with(reading(), "0\n1\n"),
              HasSubstr("oxts.txt: holds 1 readings, but times_oxts.txt holds 2 times"));
  const TemporaryFolder folder;
  write_drive(folder);
  folder.write("oxts/data/0000000002.txt", reading());
  EXPECT_THAT(message_of([&] { read_oxts(folder.path()); }), HasSubstr("data: holds 3 readings"));
}

TEST(KittiRaw, RefusesADriveWithAHoleOrAFileOfAnotherForm) {
  const TemporaryFolder folder;
  write_drive(folder);
  folder.write("oxts/data/0000000001.txt", "");
  EXPECT_THAT(message_of([&] { read_oxts(folder.path()); }),
              HasSubstr("0000000001.txt: holds no reading"));
  folder.write("oxts/data/0000000001.txt", reading() + reading());
  EXPECT_THAT(message_of([&] { read_oxts(folder.path()); }),
              HasSubstr("0000000001.txt:2: holds more than one reading"));
  std::filesystem::rename(folder / "oxts/data/0000000001.txt", folder / "oxts/data/0000000007.txt");
  EXPECT_THAT(message_of([&] { read_oxts(folder.path()); }),
              HasSubstr("0000000001.txt: cannot be opened"));
}

TEST(KittiRaw, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of([&] { read_oxts(folder.path()); }),
              HasSubstr("holds neither oxts/data nor oxts.txt"));
  EXPECT_THAT(message_of([&] { read_oxts(folder / "oxts.txt"); }),
              HasSubstr("oxts.txt: cannot be opened"));
  folder.write("oxts.txt", reading());
  EXPECT_THAT(message_of([&] { read_oxts(folder / "oxts.txt"); }),
              HasSubstr("times_oxts.txt: cannot be opened"));
}

}  // namespace oxts_file_test
}  // namespace placegraph
