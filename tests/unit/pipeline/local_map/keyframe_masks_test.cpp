#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/local_map/keyframe_masks.h>

#include <opencv2/core.hpp>

namespace placegraph {
namespace keyframe_masks_test {

constexpr int kWidth = 160, kHeight = 120;

/// A forest of one tree that asks where a superpixel lies: above the middle it is sky, below it is
/// ground.
DecisionForest horizon(int dimension) {
  constexpr int kRowOfSuperpixel = kSuperpixelFeatures - 14 + 1;  // 0 at the top, 255 at the bottom
  DecisionForest forest;
  forest.classes = kSurfaceCount;
  forest.dimension = dimension;
  forest.roots = {0};
  forest.nodes = {
      {kRowOfSuperpixel, 127, 2}, {DecisionForest::kLeaf, 0, 0}, {DecisionForest::kLeaf, 0, 1}};
  forest.leaves = {255, 0, 0, 0, 0, 255, 0, 0};
  return forest;
}

std::shared_ptr<const SurfaceLabeller> labeller() {
  auto model = std::make_shared<SceneModel>();
  model->kind = SceneModel::Kind::kSurfaces;
  model->classes = {"sky", "ground", "vertical", "object"};
  model->surfaces = {Surface::kSky, Surface::kGround, Surface::kVertical, Surface::kObject};
  model->first = horizon(kSuperpixelFeatures);
  model->second = horizon(kSuperpixelFeatures + context_dimension(kSurfaceCount));
  model->relations.above.assign(16, 0);
  model->relations.beside.assign(16, 0);
  return std::make_shared<const SurfaceLabeller>(model, SceneMaskOptions());
}

Frame frame_of(std::int64_t id) {
  Frame frame;
  frame.id = FrameId(id);
  frame.image = Image(kHeight, kWidth, CV_8UC1);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      frame.image.at<std::uint8_t>(v, u) =
          static_cast<std::uint8_t>(120 + 7 * (u / 8 + v / 8) % 90);
  return frame;
}
/// The share of a mask's rows from..to that may be used.
double share(const Image& mask, int from, int to) {
  const Image rows = mask.rowRange(from, to);
  return static_cast<double>(cv::countNonZero(rows)) / static_cast<double>(rows.total());
}
constexpr int kMargin = 12;  // about the horizon, which superpixels cross

TEST(KeyframeMasks, WithoutAModelAFrameStaysAsItIs) {
  StageTimes times;
  KeyframeMasks masks(times);
  Frame frame = frame_of(KeyframeId(1).value());
  frame.mask = Image(kHeight, kWidth, CV_8UC1, cv::Scalar(255));
  const KeyframeImages images = masks.apply(frame);
  EXPECT_EQ(images.frame.mask.data, frame.mask.data);
  EXPECT_EQ(images.given_mask.data, frame.mask.data);
  EXPECT_EQ(images.labels, nullptr);
  EXPECT_FALSE(images.masked_by_labels());
  EXPECT_TRUE(images.ground().empty());
}

TEST(KeyframeMasks, TheSkyIsMaskedAndTheGroundIsSeparate) {
  StageTimes times;
  KeyframeMasks masks(times);
  masks.set_model(labeller(), true);
  const KeyframeImages images = masks.apply(frame_of(KeyframeId(1).value()));
  ASSERT_TRUE(images.labels);
  EXPECT_TRUE(images.masked_by_labels());
  EXPECT_TRUE(images.given_mask.empty());
  ASSERT_EQ(images.frame.mask.size(), cv::Size(kWidth, kHeight));
  EXPECT_EQ(share(images.frame.mask, 0, kHeight / 2 - kMargin), 0);
  EXPECT_EQ(share(images.frame.mask, kHeight / 2 + kMargin, kHeight), 1);
  EXPECT_EQ(share(images.ground(), 0, kHeight / 2 - kMargin), 0);
  EXPECT_EQ(share(images.ground(), kHeight / 2 + kMargin, kHeight), 1);
}

TEST(KeyframeMasks, BothMasksCountAndThatOfTheCallerDoesNotChange) {
  StageTimes times;
  KeyframeMasks masks(times);
  masks.set_model(labeller(), true);
  Frame frame = frame_of(KeyframeId(1).value());
  frame.mask = Image(kHeight, kWidth, CV_8UC1, cv::Scalar(255));
  frame.mask.rowRange(kHeight - 20, kHeight).setTo(0);  // the bonnet
  const Image before = frame.mask.clone();
  const KeyframeImages images = masks.apply(frame);
  EXPECT_EQ(share(images.frame.mask, 0, kHeight / 2 - kMargin), 0);
  EXPECT_EQ(share(images.frame.mask, kHeight / 2 + kMargin, kHeight - 20), 1);
  EXPECT_EQ(share(images.frame.mask, kHeight - 20, kHeight), 0);
  EXPECT_EQ(cv::countNonZero(before != frame.mask), 0);
  EXPECT_EQ(images.given_mask.data, frame.mask.data);
}

TEST(KeyframeMasks, LabelsMaskNothingWhereTheyAreNotTrusted) {
  for (const bool wanted : {true, false}) {
    StageTimes times;
    KeyframeMasks masks(times);
    masks.set_model(labeller(), wanted);
    masks.trust(!wanted);  // one of the two is missing
    const KeyframeImages images = masks.apply(frame_of(KeyframeId(1).value()));
    ASSERT_TRUE(images.labels);  // they still say what surroundings these are
    EXPECT_GT(images.labels->shares.below[static_cast<std::size_t>(Surface::kGround)], 0.8);
    EXPECT_GT(images.labels->shares.above[static_cast<std::size_t>(Surface::kSky)], 0.8);
    EXPECT_FALSE(images.masked_by_labels());
    EXPECT_TRUE(images.frame.mask.empty());
    EXPECT_TRUE(images.ground().empty());
  }
}

TEST(KeyframeMasks, AFrameIsLabelledOnce) {
  StageTimes times;
  KeyframeMasks masks(times);
  masks.set_model(labeller(), true);
  const auto first = masks.apply(frame_of(KeyframeId(1).value())).labels;
  EXPECT_EQ(masks.apply(frame_of(KeyframeId(1).value())).labels, first);
  const auto second = masks.apply(frame_of(KeyframeId(2).value())).labels;
  EXPECT_NE(second, first);
  EXPECT_EQ(second->frame, FrameId(2));
}

TEST(KeyframeMasks, AModelOfSurfacesIsNeeded) {
  EXPECT_THROW(SurfaceLabeller(nullptr, {}), ArgumentError);
  auto urban = std::make_shared<SceneModel>();
  urban->kind = SceneModel::Kind::kUrban;
  urban->classes = {"a", "b", "c", "d"};
  EXPECT_THROW(SurfaceLabeller(urban, {}), ArgumentError);
}

TEST(SceneEdges, OfAWideImageAreThoseOfAHalvedOneWithItsCamera) {
  Camera camera;
  camera.width = 1280, camera.height = 160;
  camera.fx = camera.fy = 700;
  camera.cx = 639.5, camera.cy = 79.5;
  Image image(camera.height, camera.width, CV_8UC1, cv::Scalar(60));
  image.colRange(500, camera.width).setTo(190);  // an edge at 499.5 px
  const auto [segments, halved] = edges_of(image, camera);
  EXPECT_EQ(halved.width, 640);
  EXPECT_EQ(halved.fx, 350);
  ASSERT_FALSE(segments.empty());
  for (const LineSegment& segment : segments) {
    // The ray of the edge is the same in both.
    const double x = (segment.middle().x() - halved.cx) / halved.fx;
    EXPECT_NEAR(x, (499.5 - camera.cx) / camera.fx, 0.1 / halved.fx);
  }
}

}  // namespace keyframe_masks_test
}  // namespace placegraph
