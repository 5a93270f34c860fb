#pragma once
#include <placegraph/eval/kitti/kitti_result.h>

#include <string>
#include <vector>

namespace placegraph {

/// The figures of the devkit's `evaluate_odometry` (Geiger et al. 2012) over segments.
/// A row needs three segments. That of a length L has those of this length; that of a speed of 2,
/// 4, ... 24 m/s those within 2 m/s of it, so that a segment counts in two rows.
KittiFigures kitti_figures(const std::vector<SegmentError>& segments);

/// The speed of a segment as the devkit has it: its length over a tenth of a second for each of its
/// frames, both ends counted.
double kitti_speed_m_per_s(const SegmentError& segment);

/// A file `errors/NN.txt` of the devkit, a line for each segment: number of the first frame,
/// rotation error [rad/m], translation error (a ratio), length [m], speed [m/s].
std::string kitti_segments_text(const std::vector<SegmentError>& segments);

/// A file `plot_error/NN_tl.txt` or `NN_ts.txt` of the devkit: length or speed, translation error
/// (a ratio).
std::string kitti_translations_text(const std::vector<KittiRow>& rows);
/// A file `plot_error/NN_rl.txt` or `NN_rs.txt`: length or speed, rotation error [rad/m].
std::string kitti_rotations_text(const std::vector<KittiRow>& rows);

/// A file `plot_path/NN.txt`: x and z of the true and of the estimated position [m], of every third
/// frame.
std::string kitti_path_text(const std::vector<FramePair>& pairs);

/// The file `stats.txt`: translation error (a ratio) and rotation error [rad/m] over all segments.
std::string kitti_stats_text(const KittiFigures& figures);

}  // namespace placegraph
