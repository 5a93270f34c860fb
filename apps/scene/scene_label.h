#pragma once
#include "apps/scene/scene_pictures.h"

namespace placegraph::apps {

/// `placegraph scene label`: what each pixel of a street is, by a model of classes and one of
/// surfaces. Throws as label_pictures does, and
/// FileError where a model is missing or of the other kind.
ScenePictureResult scene_label(const ScenePictureArguments& arguments);

}  // namespace placegraph::apps
