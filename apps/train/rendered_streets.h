#pragma once
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <string>
#include <vector>

namespace placegraph::apps {

/// A view of a rendered street with the class of every pixel (SyntheticWorld::scene_classes).
struct RenderedImage {
  std::string sequence;  ///< name of the world
  Image image, labels;
};

/// Renders `frames` views on the path through town-loop for each seed.
/// Even seeds have difficulty hard. Throws ArgumentError if a town has fewer views.
std::vector<RenderedImage> render_streets(const std::vector<std::uint64_t>& seeds, int frames,
                                          int threads);

}  // namespace placegraph::apps
