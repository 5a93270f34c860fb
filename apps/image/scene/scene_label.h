#pragma once
#include "apps/image/scene/scene_images.h"

namespace placegraph::apps {

/// Classifies the pixels of street images by two installed models: `image labels`.
/// One is the model of classes, one the model of surfaces. With the installed models, pixels of
/// images that show no street are unknown. Throws as label_images does, and
/// FileError if a model is missing or of the other kind.
SceneImageResult scene_label(const SceneImageArguments& arguments);

}  // namespace placegraph::apps
