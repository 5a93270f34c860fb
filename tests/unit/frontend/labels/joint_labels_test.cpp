#include <gtest/gtest.h>
#include <placegraph/frontend/labels/joint_labels.h>
#include <placegraph/frontend/labels/training/model_growth.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

namespace placegraph {
namespace joint_labels_test {

/// A forest of one tree: `low` where the first feature is at most 100, else `high`.
DecisionForest stump(int dimension, const std::vector<std::uint8_t>& low,
                     const std::vector<std::uint8_t>& high) {
  DecisionForest forest;
  forest.classes = static_cast<int>(low.size());
  forest.dimension = dimension;
  forest.roots = {0};
  forest.nodes = {{0, 100, 2}, {DecisionForest::kLeaf, 0, 0}, {DecisionForest::kLeaf, 0, 1}};
  forest.leaves = low;
  forest.leaves.insert(forest.leaves.end(), high.begin(), high.end());
  return forest;
}

SceneModel model_of(SceneModel::Kind kind, const std::vector<std::string>& classes,
                    const std::vector<Surface>& surfaces, const std::vector<std::uint8_t>& low,
                    const std::vector<std::uint8_t>& high) {
  const int n = static_cast<int>(classes.size());
  SceneModel model;
  model.kind = kind, model.classes = classes, model.surfaces = surfaces;
  model.first = stump(kSuperpixelFeatures, low, high);
  model.second = stump(kSuperpixelFeatures + context_dimension(n), low, high);
  model.relations = {std::vector<float>(classes.size() * classes.size(), 0),
                     std::vector<float>(classes.size() * classes.size(), 0)};
  return model;
}

SceneModel urban_model() {
  return model_of(SceneModel::Kind::kUrban, {"Sky", "Road", "Pavement", "Building"},
                  {Surface::kSky, Surface::kGround, Surface::kGround, Surface::kVertical},
                  {51, 102, 51, 51}, {0, 51, 153, 51});
}

SceneModel surface_model() {
  return model_of(SceneModel::Kind::kSurfaces, {"sky", "ground", "vertical", "object"},
                  {Surface::kSky, Surface::kGround, Surface::kVertical, Surface::kObject},
                  {51, 51, 102, 51}, {0, 204, 51, 0});
}

/// Two superpixels, whose first features are 0 and 200.
SceneView two_halves() {
  Image index(4, 8, CV_32SC1, cv::Scalar(0));
  index.colRange(4, 8).setTo(1);
  SceneView view{8, 16, superpixels_of_index(index, 2), {2, kSuperpixelFeatures, {}}};
  view.features.values.assign(2 * kSuperpixelFeatures, 0);
  view.features.row(1)[0] = 200;
  return view;
}

TEST(LabelUrban, PoolsTheSurfacesAndKeepsTheRatiosWithinThem) {
  const JointLabels labels = label_jointly(urban_model(), surface_model(), two_halves());
  // Urban, first superpixel: sky 1/5, ground 3/5, vertical 1/5; surfaces: 1/5, 1/5, 2/5 and 1/5 of
  // an object, which is no class.
  const double sky = std::sqrt(1.0), ground = std::sqrt(3.0), vertical = std::sqrt(2.0);
  const double sum = sky + ground + vertical;
  EXPECT_NEAR(labels.surfaces[0], sky / sum, 1e-5);
  EXPECT_NEAR(labels.surfaces[1], ground / sum, 1e-5);
  EXPECT_NEAR(labels.surfaces[2], vertical / sum, 1e-5);
  EXPECT_NEAR(labels.surfaces[3], 0, 1e-5);
  EXPECT_NEAR(labels.classes[1], ground / sum * 2 / 3, 1e-5);
  EXPECT_NEAR(labels.classes[2], ground / sum / 3, 1e-5);
  EXPECT_NEAR(labels.classes[3], vertical / sum, 1e-5);
  for (std::size_t i = 0; i < 2; ++i) {
    float all = 0;
    for (std::size_t c = 0; c < 4; ++c) all += labels.classes[4 * i + c];
    EXPECT_NEAR(all, 1, 1e-5);
    EXPECT_NEAR(labels.classes[4 * i + 1] + labels.classes[4 * i + 2], labels.surfaces[4 * i + 1],
                1e-5);
  }
  EXPECT_THROW((void)label_jointly(surface_model(), surface_model(), two_halves()), ArgumentError);
  EXPECT_THROW((void)label_jointly(urban_model(), urban_model(), two_halves()), ArgumentError);
}

TEST(JoinEvidence, MultipliesByTheLikelihoodOfEachClass) {
  const SceneModel urban = urban_model();
  const SceneView view = two_halves();
  const JointLabels alone = label_jointly(urban, surface_model(), view);
  Random random(1);
  std::vector<float> logs(8);
  for (float& value : logs) value = static_cast<float>(random.normal());
  const JointLabels joined = join_evidence(urban, alone, view, logs);
  for (std::size_t i = 0; i < 2; ++i) {
    double sum = 0;
    std::array<double, 4> expected;
    for (std::size_t c = 0; c < 4; ++c)
      sum += expected[c] = std::max<double>(alone.classes[4 * i + c], 1e-4) *
                           std::exp(static_cast<double>(logs[4 * i + c]));
    // The field does not let a share be less than a thousandth.
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_NEAR(joined.classes[4 * i + c], expected[c] / sum, 2e-3) << i << ' ' << c;
    EXPECT_NEAR(joined.surfaces[4 * i + 1], joined.classes[4 * i + 1] + joined.classes[4 * i + 2],
                1e-6);
  }
  for (std::size_t c = 0; c < 4; ++c) logs[c] += 80;  // of one superpixel: it tells nothing
  const JointLabels same = join_evidence(urban, alone, view, logs);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(same.classes[k], joined.classes[k], 1e-4);
  logs.pop_back();
  EXPECT_THROW((void)join_evidence(urban, alone, view, logs), ArgumentError);
}

TEST(MostProbable, LabelsPixelsAtTheSizeOfTheImage) {
  const SceneLabels surfaces = most_probable(classify_superpixels(surface_model(), two_halves()),
                                             kSurfaceCount, two_halves(), 0.5);
  ASSERT_EQ(surfaces.labels.size(), cv::Size(16, 8));
  for (int v = 0; v < 8; ++v)
    for (int u = 0; u < 16; ++u) {
      // On the left the best share is 2 / 5, less than a half.
      EXPECT_EQ(surfaces.labels.at<std::uint8_t>(v, u), u < 8 ? kSurfaceCount : 1);
      EXPECT_NEAR(surfaces.confidence.at<float>(v, u), u < 8 ? 0.4 : 0.8, 2e-3);
    }
  SceneView other = two_halves();
  other.features = {2, 5, std::vector<std::uint8_t>(10)};
  EXPECT_THROW((void)classify_superpixels(surface_model(), other), ArgumentError);
}

TEST(Sharpen, RaisesRatiosToThePower) {
  std::vector<float> shares = {0.2f, 0.8f, 0.5f, 0.5f};
  sharpen(shares, 2, 2);
  EXPECT_NEAR(shares[1] / shares[0], 16, 1e-3);
  EXPECT_NEAR(shares[0] + shares[1], 1, 1e-6);
  EXPECT_NEAR(shares[2], 0.5, 1e-6);
  sharpen(shares, 2, 0.5f);
  EXPECT_NEAR(shares[1], 0.8, 1e-5);
}

TEST(ScenePicture, HasEvenSidesOfTheSameShapeAndThreeChannels) {
  for (const auto& [width, height] : {std::pair{640, 480}, {1241, 376}, {90, 121}}) {
    const Image picture = scene_picture(Image(height, width, CV_8UC1, cv::Scalar(70)));
    EXPECT_EQ(picture.type(), CV_8UC3);
    EXPECT_EQ(picture.cols % 2 + picture.rows % 2, 0);
    EXPECT_NEAR(static_cast<double>(picture.cols) / picture.rows,
                static_cast<double>(width) / height, 0.02 * width / height);
    EXPECT_NEAR(picture.total() / (480.0 * 360), 1, 0.01);
    EXPECT_EQ(picture.at<cv::Vec3b>(5, 5), cv::Vec3b(70, 70, 70));
  }
  EXPECT_THROW((void)scene_picture(Image(31, 200, CV_8UC1)), ArgumentError);
  EXPECT_THROW((void)scene_picture(Image(90, 90, CV_32FC1)), ArgumentError);
}

TEST(KeepTrees, PredictsTheMeanOfTheOldTreesAndTheNew) {
  const SceneModel base = surface_model();
  // The new model knows a fifth class; its second forest splits at the context of class 4.
  SceneModel model = model_of(
      SceneModel::Kind::kSurfaces, {"sky", "ground", "vertical", "object", "water"},
      {Surface::kSky, Surface::kGround, Surface::kVertical, Surface::kObject, Surface::kGround},
      {0, 0, 0, 0, 255}, {51, 51, 51, 51, 51});
  SceneModel old = base;
  old.second.nodes[0] = {kSuperpixelFeatures + 4 + 3, 9, 2};  // class 3 above, of four classes
  const SceneModel fresh = model;
  keep_trees(old, model);
  EXPECT_FALSE(model.first.problem());
  EXPECT_FALSE(model.second.problem());
  std::vector<std::uint8_t> row(static_cast<std::size_t>(model.second.dimension), 0);
  for (const int first : {0, 200})
    for (const int above : {0, 50}) {
      row[0] = static_cast<std::uint8_t>(first);
      row[kSuperpixelFeatures + 5 + 3] = static_cast<std::uint8_t>(above);  // the same, of five
      std::array<float, 5> both, with_new;
      std::array<std::uint8_t, 4> old_leaf;
      fresh.second.predict(row.data(), with_new.data());
      std::copy_n(old.second.leaves.begin() + (above > 9 ? 4 : 0), 4, old_leaf.begin());
      model.second.predict(row.data(), both.data());
      for (std::size_t c = 0; c < 5; ++c)
        EXPECT_NEAR(both[c], 0.5 * (c < 4 ? old_leaf[c] / 255.0 : 0) + 0.5 * with_new[c], 1e-5);
    }
  SceneModel reordered = fresh;
  std::swap(reordered.classes[0], reordered.classes[1]);
  EXPECT_THROW(keep_trees(old, reordered), ArgumentError);
  SceneModel smaller = old;
  EXPECT_THROW(keep_trees(fresh, smaller), ArgumentError);
  old.first.dimension = 7;
  SceneModel other = fresh;
  EXPECT_THROW(keep_trees(old, other), ArgumentError);
}

}  // namespace joint_labels_test
}  // namespace placegraph
