#pragma once
#include <placegraph/frontend/align/plane_tracker.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Contents of the files that `placegraph track plane` writes.

/// One line per frame: number, tracked or lost, corners [px], similarity; nine nan if it is lost.
std::string track_lines(const std::vector<PlaneTrack>& tracks);
/// All results of a frame.
nlohmann::ordered_json track_json(const PlaneTrack& track, std::size_t frame);
/// T_ref_cur in units of the plane's distance; nothing if the track or its motion is unknown.
std::optional<SE3> pose_of(const PlaneTrack& track);
/// The frame with the template's outline, or the reason for the loss, CV_8UC3.
Image track_drawing(const Image& image, const PlaneTrack& track, std::size_t frame);

}  // namespace placegraph::apps
