#pragma once
#include <placegraph/frontend/labels/label_options.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/scene/scene_model.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Labels of every pixel, at the size of the original image.
struct SceneLabels {
  Image labels;      ///< CV_8UC1: class, or the number of classes where it is unknown
  Image confidence;  ///< CV_32FC1: probability that the label is correct
};

/// Labels the pixels of an image with the most probable classes of a model.
///
/// `picture`: BGR or grey, CV_8U, of at least 32 x 32 pixels; the labels of a grey image are less
/// certain. A pixel is unknown if its class has a lower probability than `unknown_below`. Throws
/// ArgumentError for another image or a model with other features.
SceneLabels label_scene(const SceneModel& model, const Image& picture, double unknown_below = 0,
                        const LabellerOptions& options = {});

}  // namespace placegraph
