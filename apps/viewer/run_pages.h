#pragma once
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/report/served_page.h>

#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/server/http_server.h"
#include "apps/viewer/map_images.h"

namespace placegraph::apps {

/// JSON as an answer.
HttpResponse json_response(const nlohmann::json& data, int status = 200);

/// What a browser may see of finished runs: the report of all, images and observations of each.
/// Functions may be called on any thread.
class RunPages {
 public:
  /// Folders that `placegraph run` wrote, or their maps; `program`: name and version of the
  /// program. Throws FileError for a map that cannot be read.
  RunPages(const std::vector<std::string>& runs, std::string program);

  /// Answers "report.json", "runs/R/frames/F/image.jpg" and "runs/R/frames/F/observations.json".
  ///
  /// 404 with the reason for other paths and for frames and recordings that are not there; 500 with
  /// the reason for a map, a recording or a file beside them that is damaged.
  HttpResponse respond(const std::string& path);
  /// Shows another state of the first run's map from now on; `edited`: not as the run left it, so
  /// that what lies beside the map does not belong to it.
  void show(std::shared_ptr<const StoredMap> stored, bool edited);
  /// The first run's map, and its file.
  std::shared_ptr<const StoredMap> first() const;
  const std::string& first_path() const { return runs_.front().path; }
  std::size_t count() const { return runs_.size(); }
  /// The names of the runs.
  std::string title() const;

 private:
  struct Run {
    std::string path, name;
    bool edited = false;
    std::shared_ptr<const StoredMap> stored;
    std::unique_ptr<MapImages> images;
  };
  ServedRun served(std::size_t number) const;
  HttpResponse report() const;
  HttpResponse of_frame(const std::string& path);
  std::shared_ptr<const StoredMap> stored(std::size_t run) const;

  std::string program_;
  std::vector<Run> runs_;
  mutable std::mutex mutex_;  // guards the maps
};

}  // namespace placegraph::apps
