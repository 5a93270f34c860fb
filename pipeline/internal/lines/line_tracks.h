#pragma once
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/frontend/internal/lines/line_feature.h>
#include <placegraph/frontend/internal/lines/line_initializer.h>
#include <placegraph/frontend/internal/lines/line_tracker.h>
#include <placegraph/pipeline/cues/frame_view.h>

#include <vector>

// What is asked of the lines that are followed in the newest image, taken at T_odom_cam. Lines of
// the window are those that it holds by the id of the track.
namespace placegraph {

/// Segments and carriers of the tracks; no carrier is known better than `sigma_floor_px` across.
LineView line_view(const std::vector<LineTrack>& tracks, double sigma_floor_px);

/// Depths [m] at the middles of the tracks that are lines of the window, as far as these lie before
/// the camera.
std::vector<double> depths_of_lines(const Camera& camera, const std::vector<LineTrack>& tracks,
                                    const SlidingWindow& window, const SE3& T_odom_cam);

/// Number of tracks that are lines of the window.
int count_lines(const std::vector<LineTrack>& tracks, const SlidingWindow& window);

/// The tracks with their residuals [px], where they are lines of the window: to be drawn.
std::vector<FrameView::Line> view_of_lines(const Camera& camera,
                                           const std::vector<LineTrack>& tracks,
                                           const SlidingWindow& window, const SE3& T_odom_cam);

/// Features of the tracks that lie in the image, in the camera's frame with their lines where the
/// window has them; without descriptors.
std::vector<LineFeature> features_of_lines(const Camera& camera,
                                           const std::vector<LineTrack>& tracks,
                                           const SlidingWindow& window, const SE3& T_odom_cam);

}  // namespace placegraph
