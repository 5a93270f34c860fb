#include "apps/viewer/run_view.h"

#include <placegraph/graph/core/error.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/support/interruption.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

/// A browser that shows the page again after this time at the latest is still there.
constexpr std::chrono::seconds kAbsence(5);

}  // namespace

RunView::RunView(const ViewerOptions& options, const std::string& title, std::string program)
    : program_(std::move(program)),
      events_(std::make_shared<EventLog>()),
      live_(std::make_unique<LiveRun>(events_)),
      without_pages_(text_response(404, "no such page while the run goes on")) {
  viewer_ = std::make_unique<Viewer>(options,
                                     json{{"format", "placegraph-live-1"},
                                          {"kind", "run"},
                                          {"program", program_},
                                          {"title", title},
                                          {"editable", false}},
                                     [this](const HttpRequest& request, const std::string& path) {
                                       return respond(request, path);
                                     });
  note("the run is shown at " + viewer_->address());
}

RunView::~RunView() { events_->close(); }

HttpResponse RunView::control(const std::string& body) {
  const json request = json::parse(body, nullptr, false);
  const std::string action =
      request.is_object() && request.contains("action") && request["action"].is_string()
          ? request["action"].get<std::string>()
          : "";
  if (action == "pause" || action == "resume")
    live_->pause(action == "pause");
  else if (action == "step")
    live_->step();
  else
    return text_response(400, "action: pause, resume or step");
  return json_response({{"paused", live_->paused()}});
}

HttpResponse RunView::respond(const HttpRequest& request, const std::string& path) {
  if (request.method == "POST")
    return path == "control" ? control(request.body)
                             : text_response(405, "only GET is answered here");
  if (path == "live/state.json") return json_response(live_->state());
  if (path == "live/image.json") {
    const auto image = live_->image();
    return image ? json_response(*image) : HttpResponse{204, "", ""};
  }
  if (path == "events") {
    HttpResponse response;
    response.type = "text/event-stream";
    response.stream = events_->reader();
    return response.stream ? response : text_response(503, "too many browsers");
  }
  std::unique_lock lock(mutex_);
  const std::shared_ptr<RunPages> pages = pages_;
  if (!pages) return without_pages_;
  lock.unlock();
  return pages->respond(path);
}

/// The run has ended: its map is served from now on, or what is wrong with it.
void RunView::serve_map(const std::string& folder) {
  std::shared_ptr<RunPages> pages;
  HttpResponse without_pages = text_response(404, "the run has no map");
  try {
    if (std::filesystem::exists(std::filesystem::path(folder) / "map.db"))
      pages = std::make_shared<RunPages>(std::vector{folder}, program_);
  } catch (const Error& error) {
    without_pages = text_response(500, error.what());
  }
  const std::lock_guard lock(mutex_);
  pages_ = std::move(pages);
  without_pages_ = std::move(without_pages);
}

void RunView::finish(const std::string& folder, const std::string& verdict) {
  serve_map(folder);
  live_->finish(verdict);
  if (!events_->visited()) return;
  note("the run has ended; its page is served until it is closed, or Ctrl-C");
  const Interruption interruption;
  auto seen = std::chrono::steady_clock::now();
  while (!interruption.requested() && std::chrono::steady_clock::now() - seen < kAbsence) {
    if (events_->readers() > 0) seen = std::chrono::steady_clock::now();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

}  // namespace placegraph::apps
