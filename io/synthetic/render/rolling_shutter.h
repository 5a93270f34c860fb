#pragma once
#include <placegraph/io/synthetic/render/renderer.h>

#include <functional>

namespace placegraph::synthetic {

/// What a camera with a rolling shutter sees, before any sensor model and without labels. The first
/// row is exposed half of `readout_s` before the image's time, the last one as long after it;
/// `view_after` is the camera's view at a time after that of the image [s]. Four rows at a time are
/// rendered at the time of their middle, which is within a tenth of a pixel for rows of 60 us and
/// motions of 1000 px/s.
Rendering render_rolling(const Scene& scene, const std::function<View(double)>& view_after,
                         double readout_s, float contrast, int threads);

}  // namespace placegraph::synthetic
