#pragma once
#include <placegraph/frontend/labels/scene_labeller.h>
#include <placegraph/graph/core/image.h>

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// What `scene label` and `scene surfaces` have in common: pictures in, label images out.
struct ScenePictureArguments {
  std::string input, out, model, surfaces_model;
  double unknown_below = 0;
  int threads = 1;
  bool relations = false, confidence = false, draw = false, force = false, json = false;
};

void add_scene_picture_options(CLI::App& command, ScenePictureArguments& arguments);

/// Labels every picture of the folder or the one picture by `label`, writes OUT/NAME.png of class
/// numbers, and on demand NAME.confidence.png and NAME.drawn.png; prints how much of them is what.
/// Throws FileError where two pictures would have one name.
void label_pictures(const ScenePictureArguments& arguments, const std::vector<std::string>& classes,
                    const std::function<SceneLabels(const SceneView&)>& label);

/// Writes a PNG file as a whole or not at all; throws FileError.
void write_png(const std::string& path, const Image& image);

/// A colour for each class, the picture under it, and black where it is unknown.
Image draw_labels(const Image& bgr, const Image& labels, int classes);

}  // namespace placegraph::apps
