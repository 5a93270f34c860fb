#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/scene/scene_model.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Options of a decision forest.
struct ForestOptions {
  int trees = 50;              ///< number of trees
  int max_depth = 18;          ///< largest number of splits above a leaf
  int min_leaf = 15;           ///< minimum number of rows of a leaf
  int tries = 40;              ///< number of features tried for a split
  double share_blocks = 0.66;  ///< share of the blocks that a tree uses
  double share_rows = 0.2;     ///< share of the rows of its blocks that a tree uses
  std::uint64_t seed = 1;      ///< seed of the random draws
  void check() const;
};
void visit(OptionVisitor& field, ForestOptions& options);

/// Options of train_scene_model.
struct SceneTrainingOptions {
  ForestOptions forest;  ///< options of both forests
  /// Number of variants of each image: itself, and simulations of other conditions.
  int variants = 3;
  double class_power = 0.5;  ///< exponent of the weight share^-power of rare classes
  int block = 15;            ///< number of consecutive images of a drive that count as similar
  void check() const;
};
void visit(OptionVisitor& field, SceneTrainingOptions& options);

/// An image of a training set.
struct SceneTrainingImage {
  std::string sequence;  ///< name of the drive; consecutive images of one drive are similar
  /// Reads the image (BGR or grey, CV_8U) and the class of every pixel (CV_8UC1, void from the
  /// number of classes on). Called from several threads, once per variant.
  std::function<std::pair<Image, Image>()> read;
};

/// Receivers of the progress of a training; empty ones are not called.
struct SceneTrainingProgress {
  std::function<void(std::size_t done)> described;      ///< images in all variants described so far
  std::function<void(const std::string& doing)> doing;  ///< the step that begins
};

/// Trains a model of the given classes.
///
/// `kind`, `classes`, `surfaces` and `origin` are taken from `model`. Every image is divided into
/// superpixels once per variant. `base`: model whose trees are kept beside the new ones; its
/// classes, with the same names, come first in `model`. The result has the same bits for any number
/// of threads. Throws ArgumentError if there are no training data, and what `read` throws.
SceneModel train_scene_model(SceneModel model, const std::vector<SceneTrainingImage>& images,
                             const SceneTrainingOptions& options, int threads,
                             const SceneTrainingProgress& progress = {},
                             const SceneModel* base = nullptr);

}  // namespace placegraph
