#include "apps/shipped/scene_models.h"

#include <placegraph/graph/core/error.h>
#include <placegraph/io/models/scene_model_file.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "apps/shipped/shipped_files.h"

namespace placegraph::apps {
namespace fs = std::filesystem;

std::string name_of(SceneModel::Kind kind) {
  return kind == SceneModel::Kind::kUrban ? "urban" : "surfaces";
}

std::string scene_model_path(SceneModel::Kind kind, const std::string& given) {
  const std::string name = name_of(kind);
  const std::string advice = "placegraph train " + name + " DATA --out " + name + ".pgscene";
  if (!given.empty()) {
    if (!fs::exists(given)) throw FileError(given, "no such model; `" + advice + "` makes one");
    return given;
  }
  std::vector<fs::path> folders;
  if (const char* folder = std::getenv("PLACEGRAPH_MODELS")) {
    folders.emplace_back(folder);
  } else {
    for (const std::string& folder : shipped_folders("models")) folders.emplace_back(folder);
  }
  for (const fs::path& folder : folders)
    if (const fs::path path = folder / (name + ".pgscene"); fs::exists(path)) return path.string();
  throw FileError(
      (folders.back() / (name + ".pgscene")).string(),
      "no such model; `" + advice + "` makes one, --model or $PLACEGRAPH_MODELS says where it is");
}

SceneModel load_scene_model(SceneModel::Kind kind, const std::string& given) {
  const std::string path = scene_model_path(kind, given);
  SceneModel model = read_scene_model(path);
  if (model.kind != kind)
    throw FileError(
        path, "a model of kind " + name_of(model.kind) + ", and " + name_of(kind) + " is needed");
  return model;
}

}  // namespace placegraph::apps
