// Models of scenes, learned from drawn streets.
#include <gtest/gtest.h>
#include <placegraph/frontend/labels/joint_labels.h>
#include <placegraph/frontend/labels/street_labels.h>
#include <placegraph/frontend/labels/training/scene_training.h>
#include <placegraph/graph/core/error.h>

#include <opencv2/core.hpp>

#include "tests/support/scenes/scene_images.h"

namespace placegraph {
namespace scene_training_test {

TEST(SceneView, TakesAnySizeAndGreyPicturesAndRefusesTinyOnes) {
  for (const cv::Size size : {cv::Size(240, 180), {641, 479}, {97, 333}}) {
    const SceneView view = view_scene(test::draw_street(3, size).bgr);
    EXPECT_EQ(view.rows, size.height);
    EXPECT_EQ(view.features.count, view.superpixels.count);
    EXPECT_EQ(view.features.dimension, kSuperpixelFeatures);
  }
  // A grey picture is one of three equal channels.
  const Image grey = test::draw_street(4).bgr;
  Image one, three;
  cv::extractChannel(grey, one, 1);
  cv::merge(std::vector<Image>(3, one), three);
  EXPECT_EQ(cv::norm(view_scene(one).superpixels.index, view_scene(three).superpixels.index), 0);
  EXPECT_EQ(view_scene(one).features.values, view_scene(three).features.values);
  EXPECT_THROW((void)view_scene(Image(20, 400, CV_8UC3)), ArgumentError);
  EXPECT_THROW((void)view_scene(Image()), ArgumentError);
}

SceneModel street_model(SceneModel::Kind kind, int threads, const SceneModel* base = nullptr) {
  SceneModel model;
  model.kind = kind;
  model.classes = {"sky", "ground", "vertical", "object"};
  model.surfaces = {Surface::kSky, Surface::kGround, Surface::kVertical, Surface::kObject};
  std::vector<SceneTrainingImage> images;
  for (int i = 0; i < 6; ++i)
    images.push_back({"street " + std::to_string(i), [i] {
                        const test::DrawnStreet street =
                            test::draw_street(static_cast<std::uint64_t>(100 + i));
                        return std::pair(street.bgr, street.labels);
                      }});
  SceneTrainingOptions options;
  options.forest.min_leaf = 4;
  options.forest.share_rows = 0.8;
  options.forest.trees = 6;
  options.forest.tries = 60;
  options.variants = 1;
  return train_scene_model(model, images, options, threads, {}, base);
}

double share_right(const Image& labels, const Image& truth) {
  return 1 - cv::countNonZero(labels != truth) / static_cast<double>(truth.total());
}

TEST(SceneTraining, AModelOfDrawnStreetsLabelsOneItHasNotSeen) {
  const SceneModel model = street_model(SceneModel::Kind::kSurfaces, 1);
  ASSERT_FALSE(model.problem());
  const test::DrawnStreet street = test::draw_street(7);
  const SceneView view = view_scene(street.bgr);
  EXPECT_GT(share_right(label_scene(model, street.bgr).labels, street.labels), 0.93);
  // Nothing is surer than 1.1: all of it is unknown.
  EXPECT_EQ(cv::countNonZero(label_scene(model, street.bgr, 1.1).labels != kSurfaceCount), 0);

  SceneModel urban = model;
  urban.kind = SceneModel::Kind::kUrban;
  const JointLabels joint = label_jointly(urban, model, view);
  const SceneLabels classes = most_probable(joint.classes, 4, view);
  EXPECT_GT(share_right(classes.labels, street.labels), 0.93);
  EXPECT_THROW((void)label_jointly(model, urban, view), ArgumentError);
  const StreetLabels scene = label_street_scene(urban, model, street.bgr);
  EXPECT_EQ(cv::countNonZero(scene.classes.labels != classes.labels), 0);
  EXPECT_THROW((void)label_street_scene(model, urban, street.bgr), ArgumentError);
}

TEST(SceneTraining, GivesTheSameModelForAnyNumberOfThreads) {
  const SceneModel one = street_model(SceneModel::Kind::kUrban, 1),
                   two = street_model(SceneModel::Kind::kUrban, 2);
  EXPECT_EQ(one.second.leaves, two.second.leaves);
  EXPECT_EQ(one.smoothness, two.smoothness);
  EXPECT_EQ(one.sharpness, two.sharpness);
}

TEST(SceneTraining, KeepsTheTreesOfAModelThatLearnsMore) {
  const SceneModel old = street_model(SceneModel::Kind::kUrban, 1);
  const SceneModel grown = street_model(SceneModel::Kind::kUrban, 1, &old);
  EXPECT_EQ(grown.first.roots.size(), 2 * old.first.roots.size());
  EXPECT_FALSE(grown.problem());
}

}  // namespace scene_training_test
}  // namespace placegraph
