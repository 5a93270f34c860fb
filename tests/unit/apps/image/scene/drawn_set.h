#pragma once
#include <string>

#include "apps/train/train_scene.h"
#include "tests/support/scenes/scene_images.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::test {

/// A labelled set of drawn streets in the folder set/: three of the drive `one` and two of the
/// drive `two` to learn from, and one_4 to judge by.
inline void write_drawn_set(const TemporaryFolder& folder) {
  std::uint64_t seed = 0;
  for (const std::string name : {"one_1", "one_2", "one_3", "two_1", "two_2", "one_4"}) {
    const DrawnStreet street = draw_street(++seed);
    const std::string part = name == "one_4" ? "set/val/" : "set/train/";
    write_image(folder, part + "images/" + name + ".png", street.bgr);
    write_image(folder, part + "labels/" + name + ".png", street.labels);
  }
  folder.write("set/CLASSES.txt",
               "0 Sky sky\n1 Road ground\n2 Wall vertical\n3 Car object\n11 void -\n");
}

/// Small forests, which are enough for drawn streets.
inline apps::TrainSceneArguments drawn_set_training(const TemporaryFolder& folder,
                                                    const std::string& out) {
  apps::TrainSceneArguments arguments;
  arguments.data = folder / "set";
  arguments.out = folder / out;
  arguments.options.threads = 1;
  SceneTrainingOptions& training = arguments.options.training;
  training.variants = 1;
  training.forest.trees = 3;
  training.forest.min_leaf = 4;
  training.forest.share_rows = 0.8;
  return arguments;
}

/// The set and two models that were learned from it, surfaces.pgscene and urban.pgscene: made once
/// for all tests of a suite.
struct DrawnModels {
  TemporaryFolder folder;
  DrawnModels() {
    write_drawn_set(folder);
    apps::train_scene(drawn_set_training(folder, "surfaces.pgscene"), SceneModel::Kind::kSurfaces);
    apps::train_scene(drawn_set_training(folder, "urban.pgscene"), SceneModel::Kind::kUrban);
  }
};

/// Share of the pixels of two label images that are the same.
inline double agreement(const Image& a, const Image& b) {
  return static_cast<double>(cv::countNonZero(a == b)) / static_cast<double>(a.total());
}

}  // namespace placegraph::test
