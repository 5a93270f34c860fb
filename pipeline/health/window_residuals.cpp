#include <fmt/format.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/pipeline/health/window_residuals.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

// A residual beyond is odd: 0.3 % of normal ones. Chosen.
constexpr double kSigmas = 3;

/// Share of `count` in `of`, which is taken to be at least a hundred.
double share(int count, int of) { return count / std::max(100.0, static_cast<double>(of)); }

}  // namespace

WindowResiduals window_residuals(const WindowState& state) {
  WindowResiduals residuals;
  for (const auto& [id, landmark] : state.landmarks)
    for (const WindowObservation* o : usable_observations(state, landmark)) {
      const Eigen::Vector3d p_cam = state.keyframes.at(o->keyframe).inverse() * landmark.p_map;
      ++residuals.pixels;
      if (reprojection_of(state.camera, *o).residual(p_cam).norm() > kSigmas)
        ++residuals.odd_pixels;
      if (!o->inverse_depth) continue;
      ++residuals.depths;
      if (std::abs(*o->inverse_depth - 1 / p_cam.z()) > kSigmas * o->sigma_inverse_depth)
        ++residuals.odd_depths;
    }
  return residuals;
}

ResidualCheck::ResidualCheck(const Calibration& calibration)
    : depth_camera_(calibration.depth.has_value()) {}

std::vector<DataNote> ResidualCheck::notes() const {
  std::vector<DataNote> notes;
  for (const std::optional<DataNote>& note : {note_of_pixels(), note_of_depths()})
    if (note) notes.push_back(*note);
  return notes;
}

std::optional<DataNote> ResidualCheck::note_of_pixels() const {
  // Share of odd pixels (docs/datasets.md). Chosen by the faults of group "fixed"
  // (tests/faults/README.md).
  constexpr double kMost = 0.05;
  const auto odd = [](const WindowResiduals& window) {
    return share(window.odd_pixels, window.pixels) > kMost;
  };
  const auto count = std::ranges::count_if(windows_, odd);
  if (count == 0) return std::nullopt;
  return DataNote{fmt::format("in {} of {} stretches over {:.0f} % of the points contradict the "
                              "motion by more than three standard deviations: errors are larger "
                              "than stated",
                              count, windows_.size(), 100 * kMost),
                  false, NoteCause::kDrift,
                  "look for what moves or covers the view there; --mask leaves it out"};
}

std::optional<DataNote> ResidualCheck::note_of_depths() const {
  // Shares of odd depths and of odd disparities (docs/datasets.md). Chosen by the faults of group
  // "fixed" (tests/faults/README.md).
  constexpr double kMostOfDepthCamera = 0.03, kMostOfSecondCamera = 0.06;
  int odd = 0, depths = 0;
  for (const WindowResiduals& window : windows_) {
    odd += window.odd_depths;
    depths += window.depths;
  }
  if (share(odd, depths) < (depth_camera_ ? kMostOfDepthCamera : kMostOfSecondCamera))
    return std::nullopt;
  const std::string text = fmt::format(
      "{:.0f} % of the points' {} contradict the motion by more than three standard "
      "deviations",
      100 * share(odd, depths), depth_camera_ ? "depths" : "disparities");
  if (depth_camera_)
    return DataNote{text + ": depth images of another time, mirrored, or not measured", true,
                    NoteCause::kDepthMismatch,
                    "compare the file names or stamps of images and depth images, and their "
                    "orientation"};
  return DataNote{text + ": right images of another time, or not rectified", true,
                  NoteCause::kRightImage,
                  "compare the file names or stamps of left and right images, and rectify them"};
}

}  // namespace placegraph
