#pragma once
#include <placegraph/eval/loops/same_view.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/route.h>
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/pipeline/loops/loop_closer.h>

#include <algorithm>
#include <set>

namespace placegraph::test {

/// The line of the sequence that every place's anchor was seen at.
inline std::map<PlaceId, FrameId> frames_of_places(const Map& map) {
  std::map<PlaceId, FrameId> frames;
  for (const Place& place : map.place_graph.places)
    frames[place.id] = map.find_keyframe(place.anchor_keyframe)->frame;
  return frames;
}

/// What a robot sees where it comes by a place once more.
struct ViewOnThePath {
  std::int64_t frame = 0;     ///< its position in the sequence
  bool another_pass = false;  ///< else a neighbour of the frame that the map keeps
};

/// What became of it.
struct Recognition {
  enum class Result { kRight, kRefused, kWrong } result = Result::kRefused;
  double position_error_m = 0, angle_error_deg = 0;  ///< of the pose, where right
};

/// Replays what was seen at places, by frames of the sequence that the map does not keep.
class ReturnPath {
 public:
  static constexpr SameView kSame{};
  static constexpr std::int64_t kOtherPass = 40;  // frames apart at least

  /// Frames of another pass are taken from `other_from` on: the number of frames in the map, or 0.
  ReturnPath(const Map& map, const LoopCloser& memory, const Dataset& dataset, Sensor sensor,
             std::int64_t other_from)
      : map_(map),
        memory_(memory),
        dataset_(dataset),
        truth_(*dataset.ground_truth()),
        sensor_(sensor),
        other_from_(other_from) {
    for (const Keyframe& keyframe : map.keyframes) kept_.insert(keyframe.frame.value());
  }

  /// The frame of another pass that is nearest to where the place was seen; without one, the
  /// nearest neighbour that is not kept.
  ViewOnThePath view_at(std::int64_t place_frame) const {
    ViewOnThePath best{place_frame, false};
    double distance = kSame.radius_m;
    for (std::int64_t i = other_from_; i < size(); ++i) {
      const auto [path, angle] = apart(place_frame, i);
      if (std::abs(i - place_frame) < kOtherPass || kept_.count(i) || path > distance ||
          angle > kSame.heading_deg)
        continue;
      distance = path;
      best = {i, true};
    }
    for (std::int64_t off = 1; !best.another_pass && off < kOtherPass; ++off)
      for (const std::int64_t i : {place_frame + off, place_frame - off})
        if (i >= 0 && i < size() && !kept_.count(i)) return {i, false};
    return best;
  }

  /// Right if the frame is recognized at a keyframe that it truly was near to.
  Recognition recognize(const ViewOnThePath& view) const {
    Recognition recognition;
    const Frame frame = dataset_.frame(static_cast<std::size_t>(view.frame), sensor_);
    const auto found = memory_.relocalize(frame, 0);
    if (!found) return recognition;
    const Keyframe& keyframe = *map_.find_keyframe(found->match);
    const auto [path, angle] = apart(keyframe.frame.value(), view.frame);
    const bool right = path <= kSame.radius_m && angle <= kSame.heading_deg;
    recognition.result = right ? Recognition::Result::kRight : Recognition::Result::kWrong;
    const SE3 error = (T_world(keyframe.frame.value()).inverse() * T_world(view.frame)).inverse() *
                      found->T_match_query;
    recognition.position_error_m = error.translation().norm();
    recognition.angle_error_deg = rad_to_deg(error.rotation().log().norm());
    return recognition;
  }

 private:
  std::int64_t size() const { return static_cast<std::int64_t>(dataset_.size()); }
  SE3 T_world(std::int64_t frame) const {
    return SE3(*truth_.poses.at(static_cast<std::size_t>(frame)).T_world_body);
  }
  std::pair<double, double> apart(std::int64_t a, std::int64_t b) const {
    const SE3 T_a_b = T_world(a).inverse() * T_world(b);
    return {T_a_b.translation().norm(), rad_to_deg(T_a_b.rotation().log().norm())};
  }

  const Map& map_;
  const LoopCloser& memory_;
  const Dataset& dataset_;
  const Trajectory truth_;
  Sensor sensor_;
  std::int64_t other_from_;
  std::set<std::int64_t> kept_;
};

}  // namespace placegraph::test
