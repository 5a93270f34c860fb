#pragma once
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <string>
#include <vector>

namespace placegraph::apps {

/// A view of a rendered street with the class of every pixel (SyntheticWorld::scene_classes).
struct RenderedPicture {
  std::string sequence;  ///< the world it is of
  Image image, labels;
};

/// `frames` views along the way through town-loop of each seed, those of even seeds of difficulty
/// hard. Throws ArgumentError if a town has fewer views.
std::vector<RenderedPicture> render_streets(const std::vector<std::uint64_t>& seeds, int frames,
                                            int threads);

}  // namespace placegraph::apps
