#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/track/plane_track_files.h"

#include "apps/support/numbers_json.h"

namespace placegraph::apps {
namespace {

using nlohmann::ordered_json;

ordered_json motion_json(const PlaneTrack& track) {
  ordered_json json;
  json["outcome"] = to_string(track.normal_outcome.code);
  if (!track.normal_outcome) json["reason"] = track.normal_outcome.reason;
  if (!track.T_cur_ref) return json;
  json["R_cur_ref"] = numbers(track.T_cur_ref->rotation().matrix());
  json["t_cur_ref_per_distance"] = numbers(track.T_cur_ref->translation());
  json["normal_ref"] = numbers(track.normal_ref);
  json["normal_sigma_rad"] = track.normal_sigma_rad;
  return json;
}

}  // namespace

std::string track_lines(const std::vector<PlaneTrack>& tracks) {
  std::string text;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const PlaneTrack& track = tracks[i];
    text += fmt::format("{} {}", i, track.outcome ? "tracked" : "lost");
    for (std::size_t c = 0; c < 4; ++c)
      text += track.outcome
                  ? fmt::format(" {:.4f} {:.4f}", track.corners_px[c].x(), track.corners_px[c].y())
                  : " nan nan";
    text += track.outcome ? fmt::format(" {:.4f}\n", track.similarity) : " nan\n";
  }
  return text;
}

ordered_json track_json(const PlaneTrack& track, std::size_t frame) {
  ordered_json json;
  json["frame"] = frame;
  json["state"] = track.outcome ? "tracked" : "lost";
  if (!track.outcome) {
    json["reason"] = track.outcome.reason;
    return json;
  }
  json["source"] = plane_track_source_names()[static_cast<std::size_t>(track.source)];
  json["corners_px"] = ordered_json::array();
  for (const Eigen::Vector2d& corner : track.corners_px)
    json["corners_px"].push_back({corner.x(), corner.y()});
  json["H_frame_template"] = numbers(track.H_cur_ref);
  json["covariance_px2"] = numbers(track.covariance);
  json["similarity"] = track.similarity;
  json["likeness"] = track.robust_similarity;
  json["visible_share"] = track.visible_share;
  json["inlier_share"] = track.inlier_share;
  if (track.normal_outcome.code != Outcome::Code::kNotAttempted)
    json["motion"] = motion_json(track);
  return json;
}

std::optional<SE3> pose_of(const PlaneTrack& track) {
  if (!track.outcome || !track.T_cur_ref) return std::nullopt;
  return track.T_cur_ref->inverse();
}

Image track_drawing(const Image& image, const PlaneTrack& track, std::size_t frame) {
  Image drawing;
  cv::cvtColor(image, drawing, cv::COLOR_GRAY2BGR);
  const cv::Scalar colour = track.outcome ? cv::Scalar(80, 200, 0) : cv::Scalar(40, 40, 230);
  constexpr int kFraction = 4;  // bits
  std::vector<cv::Point> corners;
  for (const Eigen::Vector2d& px : track.corners_px) {
    const Eigen::Vector2d at = (px * (1 << kFraction)).cwiseMin(1e8).cwiseMax(-1e8);
    corners.emplace_back(static_cast<int>(std::lround(at.x())),
                         static_cast<int>(std::lround(at.y())));
  }
  if (!corners.empty()) {
    cv::polylines(drawing, corners, true, colour, 2, cv::LINE_AA, kFraction);
    cv::circle(drawing, corners[0], 4 << kFraction, colour, -1, cv::LINE_AA, kFraction);
  }
  const std::string text =
      track.outcome
          ? fmt::format("{}: {}, {:.3f}", frame,
                        plane_track_source_names()[static_cast<std::size_t>(track.source)],
                        track.similarity)
          : fmt::format("{}: lost, {}", frame, track.outcome.reason);
  cv::putText(drawing, text, {8, 20}, cv::FONT_HERSHEY_SIMPLEX, 0.5, colour, 1, cv::LINE_AA);
  return drawing;
}

}  // namespace placegraph::apps
