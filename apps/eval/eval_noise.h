#pragma once
#include <placegraph/eval/edges/truth_noise.h>

#include <string>

namespace placegraph::apps {

/// Reads true poses, one per frame: from a file, or `poses.txt` of a folder. Throws FileError.
Trajectory read_true_poses(const std::string& path);

/// The noise that `--truth-noise` names: "none", "estimate" (from the trajectory), or
/// "POSITION_M,ROTATION_DEG", white noise of each pose; with both, stretches that were
/// interpolated. Throws ArgumentError for other texts, NoResult if the trajectory allows no
/// estimate.
TruthNoise truth_noise_of(const std::string& text, const Trajectory& truth);

struct EvalNoiseResult {
  int frames = 0, posed = 0;
  TruthNoise noise;
};

/// Estimates the noise of true poses from the poses alone: `placegraph eval noise`.
/// Throws FileError, NoResult.
EvalNoiseResult eval_noise(const std::string& path);

std::string to_text(const EvalNoiseResult& result);
std::string to_json(const EvalNoiseResult& result);

}  // namespace placegraph::apps
