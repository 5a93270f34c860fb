#pragma once
#include <placegraph/frontend/internal/labels/superpixel_features.h>
#include <placegraph/frontend/internal/labels/superpixels.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/scene/scene_model.h>

#include <vector>

namespace placegraph {

/// A picture made ready for every model: looked at once, judged by several.
struct SceneView {
  int rows = 0, cols = 0;   ///< of the picture as given
  Superpixels superpixels;  ///< of the picture at the size of work (about 480 x 360)
  ByteFeatures features;
};

/// Of a BGR or grey picture of any size from 32 x 32 pixels on; throws ArgumentError for others. A
/// grey one says less.
SceneView view_scene(const Image& picture);

/// The size of work for a picture: its shape, even sides and about 480 x 360 pixels.
Image scene_picture(const Image& picture);

/// Probabilities of the classes, count x classes. Throws ArgumentError if the model is of other
/// features than these.
std::vector<float> classify_superpixels(const SceneModel& model, const SceneView& view,
                                        const LabellerOptions& options = {});

/// Raises shares to a power and makes them sum to 1 again, row by row of n.
void sharpen(std::vector<float>& shares, int n, float power);

/// Labels of every pixel, at the size of the picture as given.
struct SceneLabels {
  Image labels;      ///< CV_8UC1: class, or the number of classes where it is unknown
  Image confidence;  ///< CV_32FC1: probability that the label is right
};

/// The most probable class of each superpixel; unknown where its probability is under
/// `unknown_below`.
SceneLabels most_probable(const std::vector<float>& probabilities, int classes,
                          const SceneView& view, double unknown_below = 0);

}  // namespace placegraph
