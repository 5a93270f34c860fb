#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/place_history.h>
#include <placegraph/pipeline/loops/keyframe_motion.h>

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// Sentinels before and after the ids of all keyframes.
inline constexpr KeyframeId kBeforeAll = KeyframeId::lowest();
inline constexpr KeyframeId kAfterAll = KeyframeId::highest();

/// The keyframes in order, each linked to an earlier one by a measured motion. A keyframe without a
/// link, or whose link is not odometry, begins a track segment. The lengths of a track segment have
/// a common scale, which is known (metres) or unknown.
///
/// Functions throw std::out_of_range for an unknown keyframe.
class KeyframeChain {
 public:
  struct Keyframe {
    std::optional<KeyframeLink> link;
    Matrix7d link_covariance = Matrix7d::Zero();  ///< in its right tangent [t, rotation, log scale]
    int track_segment = 0;
    SE3 T_track_keyframe;    ///< motion from the segment's first keyframe, along the links
    double path_length = 0;  ///< path length from the segment's first keyframe, along the links
  };

  KeyframeChain() = default;
  /// The chain of a saved map; `scale_known` has one entry per track segment. Throws ArgumentError
  /// for an unknown track segment, and as add() does.
  KeyframeChain(const std::vector<PlaceHistory::Keyframe>& keyframes,
                std::vector<bool> scale_known);

  /// Appends a keyframe; `scale_known` is used if it begins a track segment. Throws ArgumentError
  /// if the id is in use, for a link to an unknown or later keyframe, and for odometry between two
  /// track segments.
  void add(KeyframeId id, const std::optional<KeyframeLink>& link, bool scale_known = true);
  /// Replaces the motion to keyframe `id`. Throws ArgumentError if it has no link, as does
  /// inform_link().
  void update_link(KeyframeId id, const SE3& T_from_this);
  /// Corrects motions, each in its right tangent, of the links of these keyframes.
  void correct_links(const std::map<KeyframeId, Vector6d>& corrections);
  /// Replaces the information of that motion, in its right tangent, and the standard deviation of
  /// the change of scale along it.
  void inform_link(KeyframeId id, const Matrix6d& information, double sigma_log_scale);
  /// Multiplies all lengths of the track segment that begins with keyframe `first` by `factor`; its
  /// scale is known afterwards.
  void rescale(KeyframeId first, double factor);

  const std::map<KeyframeId, Keyframe>& keyframes() const { return keyframes_; }
  const Keyframe& at(KeyframeId id) const { return keyframes_.at(id); }
  bool contains(KeyframeId id) const { return keyframes_.count(id) != 0; }
  /// Whether the keyframe is linked by odometry, so that it does not begin a track segment.
  bool has_odometry(KeyframeId id) const;
  /// Motion along the links between two keyframes, which must be in one track segment.
  SE3 T_a_b(KeyframeId a, KeyframeId b) const;
  /// The same with the path length; nothing for keyframes of two track segments or unknown ones.
  std::optional<TrackedMotion> odometry(KeyframeId a, KeyframeId b) const;

  /// One entry per track segment.
  const std::vector<bool>& scale_known() const { return scale_known_; }
  bool scale_known(KeyframeId keyframe) const { return scale_known_[at(keyframe).track_segment]; }
  bool all_scales_known() const;

 private:
  void insert(KeyframeId id, const std::optional<KeyframeLink>& link, int track_segment);
  void chain_up(KeyframeId first);

  std::map<KeyframeId, Keyframe> keyframes_;
  std::vector<bool> scale_known_;  // one entry per track segment
};

}  // namespace placegraph
