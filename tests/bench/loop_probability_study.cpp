// Fits the coefficients of pipeline/loops/loop_probability to candidates of runs whose
// truth is known.
//   bench_loop_probability_study MAP TRUTH RADIUS [MAP TRUTH RADIUS ...]
// MAP: map.db of a run; TRUTH: a pose per frame of its sequence; two views show one place where
// their true positions are within RADIUS [m] and their headings within 40 deg. Every run weighs
// alike. Prints for each fate its candidates, how many are true, and its constant.
#include <fmt/format.h>
#include <placegraph/eval/loops/same_view.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/loops/loop_probability.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace placegraph {
namespace {

constexpr int kStages = kLoopStageCount;
constexpr int kUnknowns = kStages + 2;
using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/// The two stages that files call "drift" differ here.
std::string name_of(LoopStage stage) {
  return stage == LoopStage::kReach ? "reach" : to_string(stage);
}

struct Candidate {
  LoopFeatures features;
  bool same = false;
  double weight = 1;

  Vector row() const {
    Vector x = Vector::Zero();
    x[static_cast<Eigen::Index>(features.stage)] = 1;
    x[kStages] = features.log_similarity;
    x[kStages + 1] = features.log_agreeing;
    return x;
  }
};

std::vector<Candidate> candidates_of(const std::string& map, const std::string& truth_file,
                                     double radius_m) {
  const Trajectory truth = read_trajectory(truth_file);
  const SameView same{radius_m, 40};
  std::vector<Candidate> candidates;
  for (const LoopRecord& loop : read_map(map).map.loops) {
    const auto at = [&](FrameId frame) {
      require(frame.value() < static_cast<std::int64_t>(truth.size()),
              truth_file + ": too few poses");
      return truth.poses[static_cast<std::size_t>(frame.value())].T_world_body;
    };
    const auto query = at(loop.query_frame), match = at(loop.match_frame);
    if (query && match) candidates.push_back({loop_features(loop), same.holds(*query, *match)});
  }
  for (Candidate& candidate : candidates)
    candidate.weight = 50.0 / static_cast<double>(candidates.size());
  return candidates;
}

/// Greatest posterior of a logistic model, coefficients normal about zero with a deviation of 3. A
/// run of hundreds of candidates is worth fifty independent ones: neighbours fare alike.
Vector fit(const std::vector<Candidate>& candidates) {
  constexpr double kSigma = 3;
  Vector coefficients = Vector::Zero();
  for (int iteration = 0; iteration < 50; ++iteration) {
    Matrix H = Matrix::Identity() / (kSigma * kSigma);
    Vector g = -coefficients / (kSigma * kSigma);
    for (const Candidate& candidate : candidates) {
      const Vector x = candidate.row();
      const double p = 1 / (1 + std::exp(-coefficients.dot(x)));
      g += candidate.weight * ((candidate.same ? 1 : 0) - p) * x;
      H += candidate.weight * p * (1 - p) * x * x.transpose();
    }
    const Vector step = H.ldlt().solve(g);
    coefficients += step;
    if (step.norm() < 1e-9) break;
  }
  return coefficients;
}

void run(int count, char** arguments) {
  require(count >= 4 && (count - 1) % 3 == 0, "MAP TRUTH RADIUS [MAP TRUTH RADIUS ...] needed");
  std::vector<Candidate> candidates;
  for (int i = 1; i < count; i += 3) {
    const auto of_run =
        candidates_of(arguments[i], arguments[i + 1], std::strtod(arguments[i + 2], nullptr));
    candidates.insert(candidates.end(), of_run.begin(), of_run.end());
  }
  const Vector coefficients = fit(candidates);
  for (int stage = 0; stage < kStages; ++stage) {
    int all = 0, same = 0;
    for (const Candidate& candidate : candidates) {
      if (static_cast<int>(candidate.features.stage) != stage) continue;
      ++all;
      same += candidate.same;
    }
    fmt::print("{}\t{}\t{}\t{:.2f}\n", name_of(static_cast<LoopStage>(stage)), all, same,
               coefficients[stage]);
  }
  fmt::print("per log likeness\t{:.2f}\nper log agreeing\t{:.2f}\n", coefficients[kStages],
             coefficients[kStages + 1]);
}

}  // namespace
}  // namespace placegraph

int main(int count, char** arguments) {
  try {
    placegraph::run(count, arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_loop_probability_study: {}\n", error.what());
    return 2;
  }
  return 0;
}
