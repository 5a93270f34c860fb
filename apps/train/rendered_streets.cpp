#include "apps/train/rendered_streets.h"

#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>

#include "apps/support/progress.h"

namespace placegraph::apps {

std::vector<RenderedImage> render_streets(const std::vector<std::uint64_t>& seeds, int frames,
                                          int threads) {
  std::vector<RenderedImage> images;
  Progress progress("rendering", static_cast<std::int64_t>(seeds.size()), "streets");
  for (const std::uint64_t seed : seeds) {
    SyntheticOptions options;
    options.world = "town-loop";
    options.seed = seed;
    if (seed % 2 == 0) options.difficulty = synthetic::Difficulty::kHard;
    const SyntheticWorld world(options);
    const std::size_t begin = images.size(), count = static_cast<std::size_t>(frames);
    require(count <= world.size(), "--rendered-frames: a town has " + std::to_string(world.size()) +
                                       " views, not " + std::to_string(count));
    images.resize(begin + count);
    parallel_for(frames, threads, [&](int i) {
      const auto k = static_cast<std::size_t>(i);
      SyntheticFrame seen = world.render(world.size() * k / count, {.labels = true});
      images[begin + k] = {options.world + " " + std::to_string(seed), seen.frame.image,
                           seen.labels};
    });
    progress.update(static_cast<std::int64_t>(images.size() / count));
  }
  return images;
}

}  // namespace placegraph::apps
