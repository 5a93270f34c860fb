#pragma once
#include <placegraph/pipeline/map/loop_editor.h>

#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/server/http_server.h"
#include "apps/viewer/run_pages.h"

namespace placegraph::apps {

/// Edits of the loops of a shown map, by requests of the page. Any thread may call it.
class MapMending {
 public:
  /// Edits the first run of the pages. Throws ArgumentError as LoopEditor does.
  explicit MapMending(RunPages& pages);

  /// The edits in force: "edits.json".
  HttpResponse edits() const;
  /// Answers POST "edits" with this body: 200 with the edits, 400 for a body that is no edit, 409
  /// with the reason if the edit cannot be made.
  HttpResponse edit(const std::string& body);
  /// Whether there are edits that were not saved.
  bool unsaved() const;

 private:
  std::string apply(const std::string& action, const nlohmann::json& edit);
  std::string save(const std::string& name);

  RunPages& pages_;
  mutable std::mutex mutex_;
  LoopEditor editor_;
  int saved_revision_ = 0;  // revision of the map at the last saving
};

}  // namespace placegraph::apps
