#pragma once
#include <memory>
#include <mutex>
#include <string>

#include "apps/run/run_watcher.h"
#include "apps/viewer/live_run.h"
#include "apps/viewer/run_pages.h"
#include "apps/viewer/viewer.h"

namespace placegraph::apps {

/// The viewer of a run that goes on: `placegraph run --view`.
class RunView : public RunDisplay {
 public:
  /// Begins to serve, and prints the address on stderr. `program`: name and version of the program.
  RunView(const ViewerOptions& options, const std::string& title, std::string program);
  ~RunView() override;

  RunWatcher& watcher() override { return *live_; }
  void finish(const std::string& folder, const std::string& verdict) override;

 private:
  HttpResponse respond(const HttpRequest& request, const std::string& path);
  HttpResponse control(const std::string& body);
  void serve_map(const std::string& folder);

  std::string program_;
  std::shared_ptr<EventLog> events_;
  std::unique_ptr<LiveRun> live_;
  std::mutex mutex_;
  std::shared_ptr<RunPages> pages_;  // once the run has ended with a map that can be read
  HttpResponse without_pages_;       // what the server answers in their place
  std::unique_ptr<Viewer> viewer_;   // ends first
};

}  // namespace placegraph::apps
