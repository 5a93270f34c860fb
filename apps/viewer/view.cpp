#include "apps/viewer/view.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "apps/support/interruption.h"
#include "apps/support/output.h"
#include "apps/viewer/map_mending.h"
#include "apps/viewer/run_pages.h"

namespace placegraph::apps {
namespace {

/// The mending of a single run, if its map can be edited.
std::optional<MapMending> mending_of(RunPages& pages) {
  if (pages.count() != 1) return std::nullopt;
  try {
    return std::optional<MapMending>(std::in_place, pages);
  } catch (const ArgumentError& error) {
    note(error.what());
    return std::nullopt;
  }
}

}  // namespace

void view(const ViewArguments& arguments) {
  RunPages pages(arguments.runs, arguments.program);
  std::optional<MapMending> mending = mending_of(pages);
  const auto respond = [&](const HttpRequest& request, const std::string& path) {
    if (mending && path == "edits" && request.method == "POST") return mending->edit(request.body);
    if (request.method != "GET") return text_response(405, "only GET is answered here");
    if (mending && path == "edits.json") return mending->edits();
    return pages.respond(path);
  };
  const Interruption interruption;
  const Viewer viewer(arguments.viewer,
                      {{"format", "placegraph-live-1"},
                       {"kind", "view"},
                       {"program", arguments.program},
                       {"title", pages.title()},
                       {"editable", mending.has_value()}},
                      respond);
  print(viewer.address() + "\n");
  finish_printing();
  note("Ctrl-C ends the viewer");
  while (!interruption.requested()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  if (mending && mending->unsaved()) warn("edits of the map were not saved");
}

}  // namespace placegraph::apps
