#pragma once
#include <placegraph/eval/scene/label_check.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/scene/scene_model.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/train/training_images.h"

namespace placegraph::apps {

struct TrainSceneArguments {
  std::string data;       ///< labelled set (read_labelled_set); its val/ is the test set
  std::string out;        ///< file for the model; its card is OUT.md
  std::string holdout;    ///< sequence of the test set; empty: none
  std::string update;     ///< model to extend by these data; empty: none
  bool ablation = false;  ///< also evaluate each part of the model
  bool force = false;     ///< overwrite existing files
  TrainingImageOptions options;
};

/// Evaluation of the model up to one of its parts.
struct SceneAblation {
  std::string parts;
  LabelCheck check;
};

/// Change of a class of the old model: shares of its pixels that are found.
struct SceneClassChange {
  std::string name;
  double before = 0, now = 0;
};

/// Evaluation of the model on the test set.
struct SceneJudgement {
  std::size_t images = 0;
  std::string sequence;  ///< name of the sequence, or "val"
  LabelCheck check;
  std::vector<SceneAblation> ablation;    ///< set if it was requested
  std::vector<SceneClassChange> changes;  ///< set if a model was extended
};

struct TrainSceneResult {
  std::string out;
  std::size_t images = 0;  ///< number of training images
  double wall_s = 0;
  std::vector<std::string> classes;  ///< classes of the model
  float smoothness = 0, relation_weight = 0, sharpness = 0;
  std::optional<SceneJudgement> held_out;  ///< set if there is a test set
};

/// Trains a model of surfaces or street classes: `placegraph train surfaces`, `train urban`.
/// It writes the model and its card. The steps go to `sink`, progress to stderr. Throws
/// ArgumentError, FileError.
TrainSceneResult train_scene(const TrainSceneArguments& arguments, SceneModel::Kind kind,
                             const LogSink& sink = {});

std::string to_text(const TrainSceneResult& result);
std::string to_json(const TrainSceneResult& result);

}  // namespace placegraph::apps
