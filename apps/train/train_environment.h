#pragma once
#include <placegraph/graph/scene/environment.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace placegraph::apps {

struct TrainEnvironmentArguments {
  std::string data;   ///< labelled images of streets and roads, also used for training; empty: none
  std::string out;    ///< file for the model
  std::string model;  ///< model of surfaces; empty: the installed one
  std::vector<std::uint64_t> seeds{11, 12};  ///< seeds of the rendered worlds of the training set
  std::vector<std::uint64_t> left_out{14};   ///< seeds of the rendered worlds of the test set
  int frames = 14;                           ///< number of frames of each world
  double penalty = 3e-3;                     ///< penalty on the weights
  bool force = false;                        ///< overwrite `out`
};

/// Numbers of views and of correct predictions by kind of environment.
struct EnvironmentScore {
  std::array<int, kEnvironmentCount> views{}, right{};
};

struct TrainEnvironmentResult {
  std::string out;
  EnvironmentScore training_set, left_out;
};

/// Trains the classifier of environments: `placegraph train environment`.
/// It writes the model; progress goes to stderr. Throws ArgumentError, FileError.
TrainEnvironmentResult train_environment(const TrainEnvironmentArguments& arguments);

/// One line per kind, for the training set and for the test set.
std::string to_text(const TrainEnvironmentResult& result);
std::string to_json(const TrainEnvironmentResult& result);

}  // namespace placegraph::apps
