#include "apps/train/train_planarity.h"

#include <fmt/format.h>
#include <placegraph/frontend/cloud_planes/planarity_model.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/measurements/point_cloud_file.h>
#include <placegraph/io/synthetic/worlds/cloud_scene.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"
#include "apps/support/progress.h"

namespace placegraph::apps {
namespace {

using synthetic::LabelledCloud;

struct CloudTrainingSet {
  std::vector<PlanaritySample> samples;
  int clouds = 0;
};

void add_samples(const LabelledCloud& labelled, const CloudPlanesOptions& options,
                 CloudTrainingSet& training_set) {
  ++training_set.clouds;
  for (const PlanaritySample& sample : planarity_samples(labelled.cloud, labelled.labels, options))
    training_set.samples.push_back(sample);
}

/// Adds frames of a rendered world with the noise of a depth camera or of a stereo camera.
void add_clouds_of_world(const std::string& name, const TrainPlanarityArguments& arguments,
                         Random& random, CloudTrainingSet& training_set) {
  SyntheticOptions world_options;
  world_options.world = name;
  world_options.seed = arguments.seed;
  world_options.width = 320, world_options.height = 240;
  if (arguments.frames == 0) return;
  const SyntheticWorld world(world_options);
  const Camera camera = world.calibration().camera;
  for (int i = 0; i < arguments.frames; ++i) {
    const std::size_t frame =
        world.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(arguments.frames);
    const SyntheticFrame seen = world.render(frame, {.depth = true, .planes = true});
    LabelledCloud labelled{cloud_of_depth(seen.frame.depth, camera, 0), {}};
    const double share = i % 3 == 0 ? 0 : 2e-4 * std::pow(30, random.uniform());
    for (std::size_t k = 0; k < labelled.cloud.points.size(); ++k) {
      const int x = static_cast<int>(k) % camera.width, y = static_cast<int>(k) / camera.width;
      Eigen::Vector3d& p = labelled.cloud.points[k];
      labelled.labels.push_back(seen.planes.at<std::uint16_t>(y, x));
      if (p.allFinite()) p *= std::max(0.1, 1 + random.normal(0, share * p.z()));
    }
    add_samples(labelled, {}, training_set);
  }
}

PlanarityScore score_of(const PlanarityModel& model, const CloudTrainingSet& training_set) {
  PlanarityScore score;
  score.clouds = training_set.clouds;
  score.segments = static_cast<int>(training_set.samples.size());
  for (const PlanaritySample& sample : training_set.samples) {
    const bool kept = model.probability(sample.features) >= CloudPlanesOptions{}.min_probability;
    score.right += kept == sample.planar;
    (sample.planar ? score.planes : score.others) += 1;
    (sample.planar ? score.planes_kept : score.others_kept) += kept;
  }
  return score;
}

double share(int part, int of) { return of > 0 ? 1.0 * part / of : 0.0; }

}  // namespace

TrainPlanarityResult train_planarity(const TrainPlanarityArguments& arguments) {
  require(arguments.clouds >= 10, "--clouds: fewer than 10");
  require_free(arguments.out, arguments.force);
  // Every fourth cloud is in the test set.
  constexpr int kFold = 4;
  CloudTrainingSet training_set, test;
  Progress progress("taking clouds", arguments.clouds, "clouds");
  for (int i = 0; i < arguments.clouds; ++i) {
    Random random(arguments.seed, static_cast<std::uint64_t>(i) + 1);
    add_samples(synthetic::random_cloud(random), {}, i % kFold == 0 ? test : training_set);
    progress.update(i + 1);
  }
  Random random(arguments.seed);
  for (const std::string& world : arguments.worlds)
    add_clouds_of_world(world, arguments, random, training_set);
  const PlanarityModel model = placegraph::train_planarity(training_set.samples, arguments.rounds);
  write_file(arguments.out, to_text(model));
  return {arguments.out, score_of(model, training_set), score_of(model, test)};
}

std::string to_json(const TrainPlanarityResult& result) {
  const PlanarityScore &seen = result.trained, &score = result.left_out;
  nlohmann::ordered_json json;
  json["out"] = result.out;
  json["clouds"] = seen.clouds;
  json["segments"] = seen.segments;
  json["planes"] = seen.planes;
  json["right_trained"] = share(seen.right, seen.segments);
  json["left_out"] = {{"clouds", score.clouds},
                      {"segments", score.segments},
                      {"right", share(score.right, score.segments)},
                      {"planes_kept", share(score.planes_kept, score.planes)},
                      {"others_kept", share(score.others_kept, score.others)}};
  return json_text(json, 2);
}

std::string to_text(const TrainPlanarityResult& result) {
  const PlanarityScore &seen = result.trained, &score = result.left_out;
  return fmt::format("{} segments of {} clouds, {} of them planes, {:.1f} % correct\n",
                     seen.segments, seen.clouds, seen.planes,
                     100 * share(seen.right, seen.segments)) +
         fmt::format(
             "test: {} segments of {} clouds, {:.1f} % correct; kept: {:.1f} % of the "
             "planes, {:.1f} % of the others\n",
             score.segments, score.clouds, 100 * share(score.right, score.segments),
             100 * share(score.planes_kept, score.planes),
             100 * share(score.others_kept, score.others));
}

}  // namespace placegraph::apps
