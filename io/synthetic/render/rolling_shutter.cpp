#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/synthetic/render/rolling_shutter.h>

#include <algorithm>

namespace placegraph::synthetic {

Rendering render_rolling(const Scene& scene, const std::function<View(double)>& view_after,
                         double readout_s, float contrast, int threads) {
  constexpr int kRows = 4;
  const Camera camera = view_after(0).camera;
  Rendering out;
  out.grey.create(camera.height, camera.width, CV_32FC1);
  out.inverse_depth.create(camera.height, camera.width, CV_32FC1);
  out.mover.create(camera.height, camera.width, CV_16SC1);
  parallel_for((camera.height + kRows - 1) / kRows, threads, [&](int i) {
    const int top = i * kRows, end = std::min(camera.height, top + kRows);
    const double middle = 0.5 * (top + end - 1);
    View view = view_after(readout_s * (middle / (camera.height - 1) - 0.5));
    view.camera.height = end - top;
    view.camera.cy -= top;
    const Rendering rows = render(scene, view, contrast, false, 1);
    rows.grey.copyTo(out.grey.rowRange(top, end));
    rows.inverse_depth.copyTo(out.inverse_depth.rowRange(top, end));
    rows.mover.copyTo(out.mover.rowRange(top, end));
  });
  return out;
}

}  // namespace placegraph::synthetic
