#pragma once
#include "apps/image/scene/scene_images.h"

namespace placegraph::apps {

/// Labels the pixels of images as sky 0, ground 1, vertical 2 or object 3: `image surfaces`.
SceneImageResult scene_surfaces(const SceneImageArguments& arguments);

}  // namespace placegraph::apps
