#pragma once
#include <placegraph/pipeline/tracking/frame_tracker.h>

#include <functional>
#include <string>
#include <vector>

namespace placegraph::test {

/// A tracker that does what a test tells it, and notes what it is asked.
class ScriptedTracker : public FrameTracker {
 public:
  /// What a keyframe observes, given to the window of the map.
  std::function<void(const RectificationError&, LocalMap&)> observation;
  bool shows_a_keyframe = true;                    ///< whether a frame may become a keyframe
  Outcome begins = Outcome::ok();                  ///< of a first keyframe
  std::vector<double> depths = {5};                ///< in the newest keyframe
  std::vector<std::string> asked;                  ///< in order
  std::vector<double> scales;                      ///< that keyframes were finished with
  std::vector<RectificationError> rectifications;  ///< that keyframes were observed with
  std::vector<Image> masks;                        ///< of frames that became keyframes

  const char* stage() const override { return "script"; }
  void see_first(const Frame&) override { asked.emplace_back("see_first"); }
  TrackedFrame track(const Frame&, const LocalMap&, const MotionModel&) override { return {}; }
  std::optional<SE3> prepare_keyframe(const KeyframeImages& images, const SE3& T_odom_cam,
                                      const LocalMap&) override {
    asked.emplace_back("prepare");
    masks.push_back(images.frame.mask);
    return shows_a_keyframe ? std::optional(T_odom_cam) : std::nullopt;
  }
  void observe(const KeyframeImages&, const RectificationError& rectification,
               LocalMap& map) override {
    asked.emplace_back("observe");
    rectifications.push_back(rectification);
    if (observation) observation(rectification, map);
  }
  std::vector<double> prune(LocalMap&) override {
    asked.emplace_back("prune");
    return depths;
  }
  void settle(const LocalMap&) override { asked.emplace_back("settle"); }
  std::vector<PosedFrame> finish_keyframe(double scale, const LocalMap&) override {
    asked.emplace_back("finish");
    scales.push_back(scale);
    return {{FrameId(7), SE3()}};
  }
  Outcome enough_to_begin(const LocalMap&) const override { return begins; }
  void reset() override { asked.emplace_back("reset"); }
  bool corrects_rotations() const override { return false; }
  FrameView view(const LocalMap&, const SE3&) const override { return {}; }
};

}  // namespace placegraph::test
