#pragma once
#include "apps/scene/scene_pictures.h"

namespace placegraph::apps {

/// Classifies the pixels of street images by two installed models: `image labels`.
/// One is the model of classes, one the model of surfaces. Throws as label_pictures does, and
/// FileError if a model is missing or of the other kind.
ScenePictureResult scene_label(const ScenePictureArguments& arguments);

}  // namespace placegraph::apps
