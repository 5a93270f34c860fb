#include <fmt/format.h>
#include <placegraph/eval/kitti/kitti_figures.h>
#include <placegraph/graph/core/angle.h>

#include <cmath>
#include <iterator>

namespace placegraph {
namespace {

// Constants of the devkit.
constexpr double kFramesPerSecond = 10;
constexpr int kLeastSegments = 3;
constexpr double kSpeedStep_m_per_s = 2, kGreatestSpeed_m_per_s = 24;

double ratio_of(double percent) { return percent / 100; }
double rad_per_m(double deg_per_100m) { return deg_to_rad(deg_per_100m) / 100; }

/// The mean of the segments that belong to the row.
template <class Belongs>
KittiRow mean_row(const std::vector<SegmentError>& segments, double at, Belongs&& belongs) {
  KittiRow row{at, 0, 0, 0};
  for (const SegmentError& segment : segments) {
    if (!belongs(segment)) continue;
    ++row.segments;
    row.t_percent += segment.t_percent;
    row.r_deg_per_100m += segment.r_deg_per_100m;
  }
  if (row.segments == 0) return row;
  row.t_percent /= row.segments;
  row.r_deg_per_100m /= row.segments;
  return row;
}

void keep_if_enough(const KittiRow& row, std::vector<KittiRow>& rows) {
  if (row.segments >= kLeastSegments) rows.push_back(row);
}

std::string rows_text(const std::vector<KittiRow>& rows, double (*value_of)(const KittiRow&)) {
  std::string text;
  for (const KittiRow& row : rows)
    fmt::format_to(std::back_inserter(text), "{:f} {:f}\n", row.at, value_of(row));
  return text;
}

}  // namespace

double kitti_speed_m_per_s(const SegmentError& segment) {
  return segment.length_m * kFramesPerSecond / (segment.last_frame - segment.first_frame + 1);
}

KittiFigures kitti_figures(const std::vector<SegmentError>& segments) {
  KittiFigures figures;
  figures.segments = static_cast<int>(segments.size());
  if (segments.empty()) {
    figures.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                       "the path is too short for the shortest segment");
    return figures;
  }
  const KittiRow all = mean_row(segments, 0, [](const SegmentError&) { return true; });
  figures.t_rel_percent = all.t_percent;
  figures.r_rel_deg_per_100m = all.r_deg_per_100m;
  for (const double length_m : SegmentOptions().lengths_m)
    keep_if_enough(
        mean_row(segments, length_m, [&](const SegmentError& s) { return s.length_m == length_m; }),
        figures.by_length);
  for (double speed = kSpeedStep_m_per_s; speed <= kGreatestSpeed_m_per_s;
       speed += kSpeedStep_m_per_s)
    keep_if_enough(mean_row(segments, speed,
                            [&](const SegmentError& s) {
                              return std::abs(kitti_speed_m_per_s(s) - speed) < kSpeedStep_m_per_s;
                            }),
                   figures.by_speed);
  figures.outcome = Outcome::ok();
  return figures;
}

std::string kitti_segments_text(const std::vector<SegmentError>& segments) {
  std::string text;
  for (const SegmentError& segment : segments)
    fmt::format_to(std::back_inserter(text), "{} {:f} {:f} {:f} {:f}\n", segment.first_frame,
                   rad_per_m(segment.r_deg_per_100m), ratio_of(segment.t_percent), segment.length_m,
                   kitti_speed_m_per_s(segment));
  return text;
}

std::string kitti_translations_text(const std::vector<KittiRow>& rows) {
  return rows_text(rows, [](const KittiRow& row) { return ratio_of(row.t_percent); });
}

std::string kitti_rotations_text(const std::vector<KittiRow>& rows) {
  return rows_text(rows, [](const KittiRow& row) { return rad_per_m(row.r_deg_per_100m); });
}

std::string kitti_path_text(const std::vector<FramePair>& pairs) {
  constexpr std::size_t kStep = 3;  // the devkit's
  std::string text;
  for (std::size_t i = 0; i < pairs.size(); i += kStep) {
    if (!pairs[i].T_world_estimate) continue;
    const Eigen::Vector3d truth = pairs[i].T_world_truth.translation();
    const Eigen::Vector3d estimate = pairs[i].T_world_estimate->translation();
    fmt::format_to(std::back_inserter(text), "{:f} {:f} {:f} {:f}\n", truth.x(), truth.z(),
                   estimate.x(), estimate.z());
  }
  return text;
}

std::string kitti_stats_text(const KittiFigures& figures) {
  return fmt::format("{:f} {:f}\n", ratio_of(figures.t_rel_percent),
                     rad_per_m(figures.r_rel_deg_per_100m));
}

}  // namespace placegraph
