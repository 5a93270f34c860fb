#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/frontend/lines/track_consistency.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

namespace placegraph {
namespace {

bool sees(const Camera& camera, const LineMeasurement& s, const Line3& line_ref, double max_px) {
  const auto r = line_residual_px(camera, s.T_ref_cam, line_ref, s.seen.first, s.seen.second);
  const auto z = depth_on_line(camera, s.T_ref_cam, line_ref, 0.5 * (s.seen.first + s.seen.second));
  return r && r->cwiseAbs().maxCoeff() <= max_px && z && *z > 0;
}

}  // namespace

int TrackConsistency::wrong() const {
  return static_cast<int>(std::count(of_one.begin(), of_one.end(), false));
}

TrackConsistency judge_line_track(const Camera& camera, const std::vector<SE3>& T_ref_cam,
                                  const std::vector<ImageLine::Carriers>& seen, double max_error_px,
                                  int kept) {
  require(T_ref_cam.size() == seen.size(), "judge_line_track: one pose per image line is needed");
  TrackConsistency result;
  std::vector<LineMeasurement> observations;
  for (std::size_t i = 0; i < seen.size(); ++i) observations.push_back({T_ref_cam[i], seen[i]});
  const int n = static_cast<int>(observations.size());
  result.of_one.assign(observations.size(), true);
  if (n < 3) return result;
  std::vector<int> chosen;
  const int count = std::min(n, kept);
  for (int i = 0; i < count; ++i) chosen.push_back(i * (n - 1) / (count - 1));
  LineTriangulationOptions options;
  options.min_rotation_deg = 0.05;
  options.min_rotation_sigmas = 1;
  options.max_error_sigmas = 1000;
  long most = -1;
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      const auto line =
          triangulate_line(camera, {observations[chosen[i]], observations[chosen[j]]}, options);
      if (!line.outcome) continue;
      std::vector<bool> of_one;
      for (const LineMeasurement& s : observations)
        of_one.push_back(sees(camera, s, line.line_ref, max_error_px));
      const long agreeing = std::count(of_one.begin(), of_one.end(), true);
      if (agreeing <= most) continue;
      most = agreeing;
      result.of_one = std::move(of_one);
    }
  result.judged = most > 0;
  return result;
}

}  // namespace placegraph
