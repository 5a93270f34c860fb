#include "apps/train/cmd_train_planarity.h"

#include <fmt/format.h>
#include <placegraph/frontend/cloud_planes/cloud_planes.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/measurements/point_cloud_file.h>
#include <placegraph/io/synthetic/worlds/cloud_scene.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"
#include "apps/support/progress.h"

namespace placegraph::apps {
namespace {

using synthetic::LabelledCloud;

struct TrainPlanarityArguments {
  std::string out;
  std::vector<std::string> worlds = {"corridor-loop", "warehouse", "town-loop"};
  int frames = 12, clouds = 300, rounds = 60;
  std::uint64_t seed = 1;
  bool json = false, force = false;
};

struct Lesson {
  std::vector<PlanaritySample> samples;
  int clouds = 0, planes = 0;
};

/// Segments whose points are nearly all of one plane, and those that are mostly something else;
/// what is in between teaches nothing.
void add_samples(const LabelledCloud& labelled, const CloudPlanesOptions& options, Lesson& lesson) {
  constexpr double kPlane = 0.9, kNoPlane = 0.6;
  const JudgedSegments judged = segments_to_judge(labelled.cloud, options);
  ++lesson.clouds;
  for (std::size_t k = 0; k < judged.segments.size(); ++k) {
    std::map<int, int> share;
    for (const int c : judged.segments[k].cells)
      for (int i = judged.cloud.cells[c].begin; i < judged.cloud.cells[c].end; ++i)
        ++share[labelled.labels[judged.points.source[judged.cloud.order[i]]]];
    int most = 0;
    for (const auto& [label, count] : share)
      if (label > 0) most = std::max(most, count);
    const double purity = most / judged.segments[k].sums.count();
    if (purity < kPlane && purity > kNoPlane) continue;
    lesson.samples.push_back({judged.features[k], purity >= kPlane});
    lesson.planes += purity >= kPlane;
  }
}

/// Frames of a rendered world with the noise of a depth camera or of stereo.
void add_world(const std::string& name, const TrainPlanarityArguments& arguments, Random& random,
               Lesson& lesson) {
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
    add_samples(labelled, {}, lesson);
  }
}

struct Score {
  int right = 0, planes_kept = 0, planes = 0, others_kept = 0, others = 0;
};

Score score_of(const PlanarityModel& model, const std::vector<PlanaritySample>& samples) {
  Score score;
  for (const PlanaritySample& sample : samples) {
    const bool kept = model.probability(sample.features) >= CloudPlanesOptions{}.min_probability;
    score.right += kept == sample.planar;
    (sample.planar ? score.planes : score.others) += 1;
    (sample.planar ? score.planes_kept : score.others_kept) += kept;
  }
  return score;
}

void train(const TrainPlanarityArguments& arguments) {
  require(arguments.clouds >= 10, "--clouds: fewer than 10");
  require_free(arguments.out, arguments.force);
  // Every fourth cloud is left out of training and judged.
  constexpr int kFold = 4;
  Lesson lesson, test;
  Progress progress("taking clouds", arguments.clouds, "clouds");
  for (int i = 0; i < arguments.clouds; ++i) {
    Random random(arguments.seed, static_cast<std::uint64_t>(i) + 1);
    add_samples(synthetic::random_cloud(random), {}, i % kFold == 0 ? test : lesson);
    progress.update(i + 1);
  }
  Random random(arguments.seed);
  for (const std::string& world : arguments.worlds) add_world(world, arguments, random, lesson);
  const PlanarityModel model = train_planarity(lesson.samples, arguments.rounds);
  write_file(arguments.out, to_text(model));
  const Score score = score_of(model, test.samples), seen = score_of(model, lesson.samples);
  const auto share = [](int part, int of) { return of > 0 ? 1.0 * part / of : 0.0; };
  if (arguments.json) {
    nlohmann::ordered_json json;
    json["out"] = arguments.out;
    json["clouds"] = lesson.clouds;
    json["segments"] = lesson.samples.size();
    json["planes"] = lesson.planes;
    json["right_trained"] = share(seen.right, static_cast<int>(lesson.samples.size()));
    json["left_out"] = {{"clouds", test.clouds},
                        {"segments", test.samples.size()},
                        {"right", share(score.right, static_cast<int>(test.samples.size()))},
                        {"planes_kept", share(score.planes_kept, score.planes)},
                        {"others_kept", share(score.others_kept, score.others)}};
    std::puts(json.dump(2).c_str());
    return;
  }
  fmt::print("{} segments of {} clouds, {} of them planes, {:.1f} % told right\n",
             lesson.samples.size(), lesson.clouds, lesson.planes,
             100 * share(seen.right, static_cast<int>(lesson.samples.size())));
  fmt::print(
      "left out: {} segments of {} clouds, {:.1f} % told right; kept: {:.1f} % of the planes, "
      "{:.1f} % of the others\n",
      test.samples.size(), test.clouds,
      100 * share(score.right, static_cast<int>(test.samples.size())),
      100 * share(score.planes_kept, score.planes), 100 * share(score.others_kept, score.others));
}

}  // namespace

void add_train_planarity_command(CLI::App& train_command) {
  auto arguments = std::make_shared<TrainPlanarityArguments>();
  TrainPlanarityArguments& a = *arguments;
  CLI::App* command = train_command.add_subcommand(
      "planarity", "Which segments of a point cloud are planes: for `planes --model`");
  command->footer("placegraph train planarity --out planarity.txt --clouds 300");
  command->add_option("--out", a.out, "write the model")->required();
  command->add_option("--worlds", a.worlds, "rendered worlds to learn from")
      ->check(CLI::IsMember(SyntheticWorld::worlds()))
      ->capture_default_str();
  command->add_option("--frames", a.frames, "of each world")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command
      ->add_option("--clouds", a.clouds,
                   "generated clouds with curved surfaces and heaps; every fourth is left out and "
                   "judged")
      ->check(CLI::Range(10, 100000))
      ->capture_default_str();
  command->add_option("--rounds", a.rounds, "stumps")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--seed", a.seed, "of clouds and worlds")->capture_default_str();
  command->add_flag("--json", a.json, "print JSON");
  command->add_flag("--force", a.force, "overwrite outputs");
  command->callback([arguments] { train(*arguments); });
}

}  // namespace placegraph::apps
