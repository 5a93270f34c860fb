#pragma once
#include <placegraph/eval/internal/scene/label_check.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/scene/scene_model.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/train/training_pictures.h"

namespace placegraph::apps {

struct TrainSceneArguments {
  std::string data;       ///< a labelled set (read_labelled_set); its val/ judges
  std::string out;        ///< the model to write, and its card, OUT.md
  std::string holdout;    ///< a sequence that judges instead of teaching; empty: none
  std::string update;     ///< a model to add these data to; empty: none
  bool ablation = false;  ///< each part of the model is judged too
  bool force = false;     ///< overwrite files
  TrainingPictureOptions options;
};

/// A part more of the model than the one before, judged.
struct SceneAblation {
  std::string parts;
  LabelCheck check;
};

/// What a class of an old model loses by new data: shares of its pixels that are found.
struct SceneClassChange {
  std::string name;
  double before = 0, now = 0;
};

/// The model on pictures that were held out.
struct SceneJudgement {
  std::size_t pictures = 0;
  std::string sequence;  ///< that they are of, or "val"
  LabelCheck check;
  std::vector<SceneAblation> ablation;    ///< if asked for
  std::vector<SceneClassChange> changes;  ///< where a model was updated
};

struct TrainSceneResult {
  std::string out;
  std::size_t pictures = 0;  ///< learned from
  double wall_s = 0;
  std::vector<std::string> classes;  ///< of the model
  float smoothness = 0, relation_weight = 0, sharpness = 0;
  std::optional<SceneJudgement> held_out;  ///< where there are pictures to judge by
};

/// `placegraph train surfaces` and `train urban`: learns a model from labelled pictures and writes
/// it and its card. What is being done goes to `sink`, progress to stderr. Throws ArgumentError,
/// FileError.
TrainSceneResult train_scene(const TrainSceneArguments& arguments, SceneModel::Kind kind,
                             const LogSink& sink = {});

std::string to_text(const TrainSceneResult& result);
std::string to_json(const TrainSceneResult& result);

}  // namespace placegraph::apps
