#pragma once
#include <placegraph/frontend/labels/scene_labels.h>
#include <placegraph/frontend/labels/superpixel_features.h>
#include <placegraph/frontend/labels/superpixels.h>
#include <placegraph/graph/scene/scene_model.h>

#include <vector>

namespace placegraph {

/// Superpixels and features of an image, computed once for several models.
struct SceneView {
  int rows = 0, cols = 0;   ///< size of the original image
  Superpixels superpixels;  ///< superpixels of the image at working size (about 480 x 360)
  ByteFeatures features;
};

/// Prepares a BGR or grey image of at least 32 x 32 pixels; throws ArgumentError for others.
///
/// The labels of a grey image are less certain.
SceneView view_scene(const Image& picture);

/// Image at working size: the same shape, even sides and about 480 x 360 pixels.
Image scene_picture(const Image& picture);

/// Probabilities of the classes, count x classes. Throws ArgumentError if the model's features
/// differ.
std::vector<float> classify_superpixels(const SceneModel& model, const SceneView& view,
                                        const LabellerOptions& options = {});

/// Raises shares to a power and normalizes them to sum 1, row by row of n.
void sharpen(std::vector<float>& shares, int n, float power);

/// The most probable class of each superpixel; unknown if its probability is less than
/// `unknown_below`.
SceneLabels most_probable(const std::vector<float>& probabilities, int classes,
                          const SceneView& view, double unknown_below = 0);

}  // namespace placegraph
