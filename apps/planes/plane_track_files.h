#pragma once
#include <placegraph/frontend/internal/align/plane_tracker.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

/// What `placegraph track-plane` leaves behind, as the contents of files.

/// A line a frame: number, tracked or lost, corners [px], similarity; nine nan where it is lost.
std::string track_lines(const std::vector<PlaneTrack>& tracks);
/// Everything that is known of a frame.
nlohmann::ordered_json track_json(const PlaneTrack& track, std::size_t frame);
/// T_ref_cur in units of the plane's distance; lost where the track or its motion is unknown.
std::optional<SE3> pose_of(const PlaneTrack& track);
/// The frame with the template's outline, or why it is lost; PNG bytes.
std::string track_picture(const Image& image, const PlaneTrack& track, std::size_t frame);

}  // namespace placegraph::apps
