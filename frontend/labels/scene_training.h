#pragma once
#include <placegraph/frontend/labels/forest_training.h>
#include <placegraph/frontend/labels/scene_labeller.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/scene/scene_model.h>

#include <functional>
#include <string>
#include <vector>

namespace placegraph {

struct SceneTrainingOptions {
  ForestOptions forest;      ///< of both rounds
  int variants = 3;          ///< of each picture: itself, and as another day might show it
  double class_power = 0.5;  ///< rare classes weigh as share^-power
  int block = 15;            ///< pictures of a drive one after the other that are alike
  void check() const;
};
void visit(OptionVisitor& field, SceneTrainingOptions& options);

/// A picture to learn from, cut up: its features, and which classes the pixels of each superpixel
/// have.
struct SceneExample {
  Superpixels superpixels;  ///< without the index
  ByteFeatures features;
  std::vector<int> pixels;  ///< count x classes; void ones in none
  int block = 0;            ///< examples of one are alike
};

/// Labels at the size of a picture, by their nearest pixels.
Image fit_labels(const Image& labels, const Image& picture);

/// `labels` CV_8UC1 of the picture's size, void from `classes` on. Throws ArgumentError if the
/// sizes do not agree.
SceneExample make_example(const Image& picture, const Image& labels, int classes, int block);

/// Learns a model of the classes in it (`kind`, `classes`, `surfaces` and `origin` are taken from
/// `model`); `base`: one whose trees are kept beside the new ones, classes of the same names
/// first in `model`. The same bits for any number of threads. `say` hears what is being done.
/// Throws ArgumentError if there is nothing to learn from.
SceneModel train_scene_model(SceneModel model, std::vector<SceneExample> examples,
                             const SceneTrainingOptions& options, int threads,
                             const std::function<void(const std::string&)>& say,
                             const SceneModel* base = nullptr);

}  // namespace placegraph
