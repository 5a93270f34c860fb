#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/flow/anchored_patch.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace placegraph {

/// One image point tracked over time; its landmark has the same id.
struct PointTrack {
  LandmarkId id;
  Eigen::Vector2f px = Eigen::Vector2f::Zero();
  Eigen::Vector2f px_previous = Eigen::Vector2f::Zero();
  int age = 0;  ///< frames since detection
  /// Covariance of px [px^2] relative to the start of the track; set by `anchor` and `detect`.
  Eigen::Matrix2f covariance = Eigen::Matrix2f::Identity();
  Eigen::Matrix2f template_covariance = Eigen::Matrix2f::Zero();  ///< that of the anchor patch
  std::shared_ptr<const AnchoredPatch> anchor;  ///< patch at the point where it was last taken
  Eigen::Matrix2f A =
      Eigen::Matrix2f::Identity();  ///< warp of the anchor patch in the image, see Place
};

/// Tracks corners (Shi & Tomasi 1994) by pyramidal Lucas-Kanade (Bouguet 2000).
///
/// With a forward-backward check (Kalal et al. 2010); at keyframes tracks are corrected by their
/// anchor patches. New corners are detected so that they cover the image evenly. Ids are unique.
class PointTracker {
 public:
  explicit PointTracker(const PointTrackerOptions& options);

  /// Range of the search about the predicted point.
  ///
  /// kWide: over all levels of the pyramid. kNear: over the finest two at less than half the cost,
  /// some ten pixels wide; farther off, such a search may end at a similar patch.
  enum class Search { kWide, kNear };
  /// Tracks all points into `image` (CV_8UC1, the size of the last); lost tracks are dropped.
  ///
  /// `predicted_px` has a starting point for each present track, or is empty.
  void track(const Image& image, const std::vector<Eigen::Vector2f>& predicted_px = {},
             Search search = Search::kWide);
  /// Detects new corners in the last image where tracks are missing.
  ///
  /// `mask`: no corners where it is 0 (may be empty).
  void detect(const Image& mask = {});
  /// Corrects the drift of every track by its anchor patch in the last image.
  ///
  /// Moves the track to the position of its anchor (AnchoredPatch) and sets its covariance. If the
  /// anchor is not found, or is too warped to be compared, a new one is taken: the error of the
  /// track up to then remains.
  void anchor();
  /// Drops the tracks whose flag is false (one flag per track, in order).
  void keep(const std::vector<bool>& flags);
  /// Removes tracks and images; the numbering of ids continues.
  void reset();

  const std::vector<PointTrack>& tracks() const { return tracks_; }
  const Image& image() const { return image_; }

 private:
  std::vector<std::optional<Eigen::Vector2f>> follow(
      const std::vector<Image>& pyramid, const std::vector<Eigen::Vector2f>& predicted_px,
      Search search) const;
  void take_template(PointTrack& track) const;

  PointTrackerOptions options_;
  Eigen::Matrix2f least_ = Eigen::Matrix2f::Identity();  // least covariance of a found anchor
  std::vector<PointTrack> tracks_;
  Image image_;
  std::vector<Image> pyramid_;
  LandmarkId next_id_;
};

}  // namespace placegraph
