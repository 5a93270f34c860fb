#include "apps/train/train_environment.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/shipped/scene_models.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/train/environment_samples.h"

namespace placegraph::apps {
namespace {

using EnvironmentSamples = std::vector<EnvironmentSample>;

void append(EnvironmentSamples more, EnvironmentSamples& samples) {
  std::move(more.begin(), more.end(), std::back_inserter(samples));
}

EnvironmentScore score_of(const EnvironmentModel& model, const EnvironmentSamples& samples) {
  EnvironmentScore score;
  for (const EnvironmentSample& sample : samples) {
    const auto p = model.probabilities(sample.evidence);
    const auto kind = static_cast<std::size_t>(sample.kind);
    ++score.views[kind];
    score.right[kind] += std::max_element(p.begin(), p.end()) - p.begin() == static_cast<int>(kind);
  }
  return score;
}

nlohmann::ordered_json described(const EnvironmentScore& score) {
  nlohmann::ordered_json json;
  for (std::size_t k = 0; k < kEnvironmentCount; ++k)
    if (score.views[k] > 0)
      json[environment_name(static_cast<Environment>(k))] = {{"views", score.views[k]},
                                                             {"right", score.right[k]}};
  return json;
}

std::string lines_of(const char* set, const EnvironmentScore& score) {
  std::string text;
  for (std::size_t k = 0; k < kEnvironmentCount; ++k)
    if (score.views[k] > 0)
      text += fmt::format("{:9} {:9} {:4} of {:4} correct\n", set,
                          environment_name(static_cast<Environment>(k)), score.right[k],
                          score.views[k]);
  return text;
}

}  // namespace

TrainEnvironmentResult train_environment(const TrainEnvironmentArguments& arguments) {
  require_free(arguments.out, arguments.force);
  const auto surfaces = std::make_shared<const SceneModel>(
      load_scene_model(SceneModel::Kind::kSurfaces, arguments.model));
  const std::vector<std::string> worlds{"town-loop", "corridor-loop", "warehouse"};
  EnvironmentSamples training_set, test;
  Progress progress("rendering",
                    static_cast<std::int64_t>(worlds.size() *
                                              (arguments.seeds.size() + arguments.left_out.size())),
                    "worlds");
  std::int64_t done = 0;
  for (const std::string& world : worlds) {
    for (const std::uint64_t seed : arguments.seeds) {
      append(samples_of_world(world, seed, arguments.frames, surfaces), training_set);
      progress.update(++done);
    }
    for (const std::uint64_t seed : arguments.left_out) {
      append(samples_of_world(world, seed, arguments.frames, surfaces), test);
      progress.update(++done);
    }
  }
  if (!arguments.data.empty()) append(samples_of_images(arguments.data, surfaces), training_set);
  const EnvironmentModel model = train_environments(training_set, arguments.penalty);
  write_file(arguments.out, to_text(model));
  return {arguments.out, score_of(model, training_set), score_of(model, test)};
}

std::string to_json(const TrainEnvironmentResult& result) {
  const nlohmann::ordered_json report = {{"out", result.out},
                                         {"lesson", described(result.training_set)},
                                         {"left_out", described(result.left_out)}};
  return json_text(report, 2);
}

std::string to_text(const TrainEnvironmentResult& result) {
  return lines_of("training", result.training_set) + lines_of("test", result.left_out);
}

}  // namespace placegraph::apps
