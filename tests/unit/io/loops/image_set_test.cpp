#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/loops/image_set.h>

#include <cmath>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace image_set_test {

using ::testing::HasSubstr;

class ImageSets : public ::testing::Test {
 protected:
  ImageSet set(const std::string& text, const std::string& name = "images.txt") {
    return read_image_set(folder.write(name, text));
  }
  std::string refusal(const std::string& text) {
    const std::string path = folder.write("images.txt", text);
    return test::message_of([&] { (void)read_image_set(path); });
  }
  static double distance(const ImageSet& a, std::size_t i, const ImageSet& b, std::size_t j) {
    return (a.poses.poses[i].T_world_body->translation() -
            b.poses.poses[j].T_world_body->translation())
        .norm();
  }
  test::TemporaryFolder folder;
};

TEST_F(ImageSets, ReadsPositionsWithAndWithoutTimes) {
  const ImageSet timed = set("1700000000.0 465025 5428000 0\n1700000000.5 465024 5428003 0\n");
  EXPECT_EQ(timed.size(), 2u);
  EXPECT_FALSE(timed.poses.has_orientation);
  EXPECT_NEAR(distance(timed, 0, timed, 1), std::hypot(1, 3), 1e-9);
  const ImageSet plane = set("465025 5428000\n465024 5428003\n");
  EXPECT_NEAR(distance(plane, 0, plane, 1), std::hypot(1, 3), 1e-9);
  EXPECT_EQ(plane.form, "positions [m]");
}

// A degree of latitude at 48 N is 111.2 km long, one of longitude 74.6 km.
TEST_F(ImageSets, LatitudesAndLongitudesAreDegreesOfTheEllipsoid) {
  for (const char* text : {"48.000 11.000\n48.001 11.000\n48.001 11.001\n",
                           "lon,lat,image\n11.000,48.000,a.jpg\n11.000,48.001,b.jpg\n11.001,48.001,c.jpg\n"}) {
    const ImageSet images = set(text);
    EXPECT_NEAR(distance(images, 0, images, 1), 111.2, 0.1) << text;
    EXPECT_NEAR(distance(images, 1, images, 2), 74.6, 0.1) << text;
    EXPECT_EQ(images.form, "latitudes and longitudes");
  }
}

TEST_F(ImageSets, NamesHoldPositionsAndHeadings) {
  const std::string path =
      "db/@0551000.50@4180000.25@10@S@037.76663@-122.42103@pano@@90@@@@201607@@.jpg\n"
      "db/@0551003.50@4180004.25@10@S@037.76667@-122.42100@pano@@180@@@@201607@@.jpg\n";
  const ImageSet images = set(path);
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images.zone, "10 N");
  EXPECT_NEAR(distance(images, 0, images, 1), 5, 1e-9);
  ASSERT_TRUE(images.poses.has_orientation);
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(images.poses.poses[0].T_world_body->linear().transpose() *
                                               images.poses.poses[1].T_world_body->linear()));
  EXPECT_NEAR(turn.angle(), std::acos(-1.0) / 2, 1e-9);
  const ImageSet plain = set("@10@20@.jpg\n@13@24@.jpg\n");
  EXPECT_NEAR(distance(plain, 0, plain, 1), 5, 1e-9);
  EXPECT_FALSE(plain.poses.has_orientation);
  EXPECT_EQ(set("a.jpg\nb.jpg\n").poses.size(), 0u);
  EXPECT_THAT(refusal("a.jpg\n@13@24@.jpg\n"), HasSubstr("1 of 2 names"));
}

// Zones 32 and 33 meet at 12 degrees east: the same two places are 1.49 km apart in both.
TEST_F(ImageSets, DistancesAcrossZonesAreThoseOnTheGround) {
  ImageSet west = set("@ 723000 @ 5321000 @ 32 @ U @ @ @ .jpg\n", "west.txt");
  const GeodeticPosition there = west.positions.front();
  ImageSet other_zone = set("@ 277100 @ 5321000 @ 33 @ U @ @ @ .jpg\n", "east.txt");
  ImageSet degrees = set("latitude,longitude\n" + std::to_string(there.latitude_deg) + "," +
                             std::to_string(there.longitude_deg) + "\n",
                         "degrees.csv");
  put_in_one_frame(west, degrees);
  EXPECT_NEAR(distance(west, 0, degrees, 0), 0, 0.2);  // six decimals of a degree
  put_in_one_frame(west, other_zone);
  const EnuFrame frame(there);
  EXPECT_NEAR(distance(west, 0, other_zone, 0),
              frame.to_enu(other_zone.positions.front()).norm(), 1e-6);
  EXPECT_LT(distance(west, 0, other_zone, 0), 10'000);
}

TEST_F(ImageSets, SetsInDifferentCoordinatesAreRefused) {
  ImageSet metres = set("0 0\n10 0\n", "metres.txt"), degrees = set("48.000 11.000\n48.001 11.000\n");
  EXPECT_THAT(test::message_of<ArgumentError>([&] { put_in_one_frame(metres, degrees); }),
              HasSubstr("distances between them are unknown"));
  ImageSet names = set("a.jpg\nb.jpg\n", "names.txt");
  EXPECT_THAT(test::message_of<ArgumentError>([&] { put_in_one_frame(names, degrees); }),
              HasSubstr("no positions"));
  EXPECT_THAT(refusal("latitude,longitude\n98,11\n"), HasSubstr("images.txt:2: latitude: 98"));
  EXPECT_THAT(refusal(""), HasSubstr("images.txt"));
}

}  // namespace image_set_test
}  // namespace placegraph
