#pragma once
#include <placegraph/graph/core/image.h>
#include <placegraph/graph/core/options.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace placegraph {

struct PointTrackerOptions {
  int max_tracks = 500;
  int window_px = 21;
  int pyramid_levels = 4;
  double max_forward_backward_px = 0.8;
  double min_eigenvalue = 2e-4;  ///< of the window's gradient matrix per pixel, grey levels / 255
  int cell_px = 48;              ///< detection balances tracks over cells of this side
  int min_distance_px = 10;
  void check() const;
};
void visit(OptionVisitor& field, PointTrackerOptions& options);

/// One image point followed over time.
struct PointTrack {
  std::int64_t id = 0;
  Eigen::Vector2f px = Eigen::Vector2f::Zero();
  Eigen::Vector2f px_previous = Eigen::Vector2f::Zero();
  int age = 0;  ///< frames since detection
};

/// Corners (Shi & Tomasi 1994) followed by pyramidal Lucas-Kanade (Bouguet 2000) with a
/// forward-backward check (Kalal et al. 2010); new ones are detected so that they cover the image
/// evenly. Ids are never used twice.
class PointTracker {
 public:
  explicit PointTracker(const PointTrackerOptions& options);

  /// Follows all tracks into `image` (CV_8UC1, the size of the last); lost ones are dropped.
  /// `predicted_px` holds a starting point for each present track, or is empty. How far from there
  /// a point is sought: over all levels of the pyramid, or over the finest two at less than half
  /// the cost, some ten pixels wide; farther off, such a search may end at something alike.
  enum class Search { kWide, kNear };
  void track(const Image& image, const std::vector<Eigen::Vector2f>& predicted_px = {},
             Search search = Search::kWide);
  /// Detects new corners in the last image wherever tracks are missing; `mask` 0 = not here (may be
  /// empty).
  void detect(const Image& mask = {});
  /// Drops the tracks whose flag is false (one flag a track, in order).
  void keep(const std::vector<bool>& flags);
  /// Forgets tracks and images; ids go on counting.
  void reset();

  const std::vector<PointTrack>& tracks() const { return tracks_; }
  const Image& image() const { return image_; }

 private:
  std::vector<std::optional<Eigen::Vector2f>> follow(
      const std::vector<Image>& pyramid, const std::vector<Eigen::Vector2f>& predicted_px,
      Search search) const;

  PointTrackerOptions options_;
  std::vector<PointTrack> tracks_;
  Image image_;
  std::vector<Image> pyramid_;
  std::int64_t next_id_ = 0;
};

}  // namespace placegraph
