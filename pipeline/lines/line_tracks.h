#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/frontend/lines/line_feature.h>
#include <placegraph/frontend/lines/line_initializer.h>
#include <placegraph/frontend/lines/line_tracker.h>
#include <placegraph/pipeline/cues/frame_view.h>

#include <vector>

// Queries about the tracked lines of the newest image, taken at T_odom_cam. Lines of the window are
// those that it contains under the id of the track.
namespace placegraph {

/// Minimum standard deviation across a line: lens, rolling shutter, blur. Chosen.
constexpr double kSigmaFloor_px = 0.15;

/// Segments and carriers of the tracks; the standard deviation of a carrier across the line is at
/// least `sigma_floor_px`.
LineView line_view(const std::vector<LineTrack>& tracks, double sigma_floor_px = kSigmaFloor_px);

/// Depths [m] at the middles of the tracks that are lines of the window, if these are in front of
/// the camera.
std::vector<double> depths_of_lines(const Camera& camera, const std::vector<LineTrack>& tracks,
                                    const SlidingWindow& window, const SE3& T_odom_cam);

/// Number of tracks that are lines of the window.
int count_lines(const std::vector<LineTrack>& tracks, const SlidingWindow& window);

/// All tracks, with residuals [px] where they are lines of the window, for drawing.
std::vector<FrameView::Line> view_of_lines(const Camera& camera,
                                           const std::vector<LineTrack>& tracks,
                                           const SlidingWindow& window, const SE3& T_odom_cam);

/// Features of the tracks in the image, in the camera's frame with their lines where the window
/// contains them; without descriptors.
std::vector<LineFeature> features_of_lines(const Camera& camera,
                                           const std::vector<LineTrack>& tracks,
                                           const SlidingWindow& window, const SE3& T_odom_cam);

}  // namespace placegraph
