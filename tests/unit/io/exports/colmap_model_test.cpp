#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_model.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "tests/support/message_of.h"

namespace placegraph {
namespace colmap_model_test {

using testing::HasSubstr;

/// Reads numbers one after the other.
class Numbers {
 public:
  explicit Numbers(std::string bytes) : bytes_(std::move(bytes)) {}
  template <class Number>
  Number next() {
    Number number{};
    EXPECT_LE(at_ + sizeof number, bytes_.size());
    std::memcpy(&number, bytes_.data() + at_, sizeof number);
    at_ += sizeof number;
    return number;
  }
  std::string name() {
    const std::string text(bytes_.c_str() + at_);
    at_ += text.size() + 1;
    return text;
  }
  bool ended() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

/// A camera at x = 1 that is rotated by a quarter about z, and one at the origin.
ColmapModel two_views() {
  ColmapModel model;
  model.camera = {640, 480, 500, 501, 319.5, 239.5, Distortion::kNone, {}};
  const SO3 quarter = SO3::exp(Eigen::Vector3d(0, 0, std::numbers::pi / 2));
  model.images = {{1, "left/0.png", SE3(), {{{0, 0}, 1}, {{10, 20.25}, 0}}},
                  {4, "left/3.png", SE3(quarter, {1, 0, 0}), {{{30, 40}, 1}}}};
  model.points = {{7, {1, 2, 3}, {9, 8, 7}, 0.25}, {11, {4, 5, 6}, {0, 255, 1}, 0.5}};
  return model;
}

TEST(ColmapModel, IsWrittenAsText) {
  const ColmapFiles files = to_colmap(two_views(), NumberForm::kText);
  EXPECT_THAT(files.cameras, testing::EndsWith("\n1 PINHOLE 640 480 500 501 320 240\n"));
  EXPECT_THAT(files.images, HasSubstr("\n1 1 0 0 0 0 0 0 1 left/0.png\n0.5 0.5 11 10.5 20.75 7\n"));
  EXPECT_THAT(files.images, HasSubstr(" 1 left/3.png\n30.5 40.5 11\n"));
  EXPECT_THAT(files.points, HasSubstr("\n7 1 2 3 9 8 7 0.25 1 1\n"));
  EXPECT_THAT(files.points, testing::EndsWith("\n11 4 5 6 0 255 1 0.5 1 0 4 0\n"));
}

TEST(ColmapModel, IsWrittenAsBytes) {
  const ColmapFiles files = to_colmap(two_views(), NumberForm::kBinary);
  Numbers cameras(files.cameras);
  EXPECT_EQ(cameras.next<std::uint64_t>(), 1u);
  EXPECT_EQ(cameras.next<std::uint32_t>(), 1u);
  EXPECT_EQ(cameras.next<std::int32_t>(), 1);
  EXPECT_EQ(cameras.next<std::uint64_t>(), 640u);
  EXPECT_EQ(cameras.next<std::uint64_t>(), 480u);
  for (const double value : {500., 501., 320., 240.}) EXPECT_EQ(cameras.next<double>(), value);
  EXPECT_TRUE(cameras.ended());

  Numbers images(files.images);
  EXPECT_EQ(images.next<std::uint64_t>(), 2u);
  EXPECT_EQ(images.next<std::uint32_t>(), 1u);
  for (const double value : {1., 0., 0., 0., 0., 0., 0.}) EXPECT_EQ(images.next<double>(), value);
  EXPECT_EQ(images.next<std::uint32_t>(), 1u);
  EXPECT_EQ(images.name(), "left/0.png");
  EXPECT_EQ(images.next<std::uint64_t>(), 2u);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(images.next<double>(), 0.5);
  EXPECT_EQ(images.next<std::uint64_t>(), 11u);
  EXPECT_EQ(images.next<double>(), 10.5);
  EXPECT_EQ(images.next<double>(), 20.75);
  EXPECT_EQ(images.next<std::uint64_t>(), 7u);
  EXPECT_EQ(images.next<std::uint32_t>(), 4u);
  // World to camera: rotated back by a quarter, and the origin is at (0, 1, 0) in the camera.
  const double half = std::sqrt(0.5);
  for (const double value : {half, 0., 0., -half, 0., 1., 0.})
    EXPECT_NEAR(images.next<double>(), value, 1e-15);

  Numbers points(files.points);
  EXPECT_EQ(points.next<std::uint64_t>(), 2u);
  EXPECT_EQ(points.next<std::uint64_t>(), 7u);
  for (const double value : {1., 2., 3.}) EXPECT_EQ(points.next<double>(), value);
  for (const int value : {9, 8, 7}) EXPECT_EQ(points.next<std::uint8_t>(), value);
  EXPECT_EQ(points.next<double>(), 0.25);
  EXPECT_EQ(points.next<std::uint64_t>(), 1u);
  EXPECT_EQ(points.next<std::uint32_t>(), 1u);
  EXPECT_EQ(points.next<std::uint32_t>(), 1u);
}

TEST(ColmapModel, RefusesWhatItCannotHold) {
  const auto message = [](const ColmapModel& model, NumberForm form = NumberForm::kBinary) {
    return test::message_of<ArgumentError>([&] { (void)to_colmap(model, form); });
  };
  ColmapModel model = two_views();
  model.images[1].id = 1;
  EXPECT_THAT(message(model), HasSubstr("the image id 1 is not positive or not unique"));
  model = two_views();
  model.points[0].id = 0;
  EXPECT_THAT(message(model), HasSubstr("the point id 0 is not positive or not unique"));
  model = two_views();
  model.images[0].observations[0].point = 2;
  EXPECT_THAT(message(model), HasSubstr("image 1 has an observation of a missing point"));
  model = two_views();
  model.camera.distortion = Distortion::kRadialTangential;
  model.camera.coefficients = {0, 0, 0, 0, 0.1};
  EXPECT_THAT(message(model), HasSubstr("the camera has a distortion that OPENCV has not, k3"));
  model = two_views();
  model.images[0].name = "my images/0.png";
  EXPECT_THAT(message(model, NumberForm::kText), HasSubstr("my images/0.png"));
  EXPECT_THAT(to_colmap(model, NumberForm::kBinary).images, HasSubstr("my images/0.png"));
}

}  // namespace colmap_model_test
}  // namespace placegraph
