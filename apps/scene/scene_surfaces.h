#pragma once
#include "apps/scene/scene_pictures.h"

namespace placegraph::apps {

/// `placegraph scene surfaces`: sky 0, ground 1, vertical 2 or object 3, each pixel of a picture.
/// Throws as label_pictures does, and FileError where a model is missing or of the other kind.
ScenePictureResult scene_surfaces(const ScenePictureArguments& arguments);

}  // namespace placegraph::apps
