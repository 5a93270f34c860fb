#include "apps/train/training_images.h"

#include <placegraph/io/files/image_file.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>

#include "apps/train/rendered_streets.h"

namespace placegraph::apps {
Image colour_of(const std::string& path) {
  const GreyAndColour read = read_image(path);
  return read.colour.empty() ? read.grey : read.colour;
}

std::vector<SceneTrainingImage> training_images(const LabelledSet& set,
                                                const std::vector<LabelledImage>& images,
                                                const SceneModel& model,
                                                const TrainingImageOptions& a) {
  const bool surfaces = model.kind == SceneModel::Kind::kSurfaces;
  // By value below: a training takes the model before it reads the images.
  const std::vector<std::string> names = model.classes;
  std::vector<SceneTrainingImage> training_set;
  for (const LabelledImage& image : images)
    training_set.push_back({image.sequence, [&set, names, image, surfaces] {
                              return std::pair(
                                  colour_of(image.image),
                                  read_class_image(image.labels, set.classes, names, surfaces));
                            }});
  for (const RenderedImage& image : render_streets(a.rendered, a.rendered_frames, a.threads))
    training_set.push_back({image.sequence, [names, image, surfaces] {
                              return std::pair(
                                  image.image,
                                  class_image(image.labels, image.sequence,
                                              SyntheticWorld::scene_classes(), names, surfaces));
                            }});
  return training_set;
}

}  // namespace placegraph::apps
