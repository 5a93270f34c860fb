#pragma once
#include <placegraph/graph/scene/environment.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace placegraph::apps {

struct TrainEnvironmentArguments {
  std::string data;   ///< labelled pictures of streets and roads to learn from too; empty: none
  std::string out;    ///< the model to write
  std::string model;  ///< of surfaces; empty: the one that came with the program
  std::vector<std::uint64_t> seeds{11, 12};  ///< of the rendered worlds to learn from
  std::vector<std::uint64_t> left_out{14};   ///< of those that judge
  int frames = 14;                           ///< of each world
  double penalty = 3e-3;                     ///< on the weights
  bool force = false;                        ///< overwrite `out`
};

/// By kind of surroundings: how many views there are, and how many are told rightly.
struct EnvironmentScore {
  std::array<int, kEnvironmentCount> views{}, right{};
};

struct TrainEnvironmentResult {
  std::string out;
  EnvironmentScore training_set, left_out;
};

/// `placegraph train environment`: learns what kind of surroundings a view shows and writes the
/// model. Progress goes to stderr. Throws ArgumentError, FileError.
TrainEnvironmentResult train_environment(const TrainEnvironmentArguments& arguments);

/// One line a kind, of the lesson and of what was left out.
std::string to_text(const TrainEnvironmentResult& result);
std::string to_json(const TrainEnvironmentResult& result);

}  // namespace placegraph::apps
