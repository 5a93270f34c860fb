#include "apps/viewer/map_mending.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/pipeline/map/map_file.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The body of a request is no edit.
class BadEdit : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

FrameId frame_in(const json& edit, const char* key) {
  const auto found = edit.find(key);
  if (found == edit.end() || !found->is_number_integer() || *found < 0)
    throw BadEdit(fmt::format("{}: the number of a frame is needed", key));
  return FrameId(found->get<std::int64_t>());
}

std::string text_in(const json& edit, const char* key) {
  const auto found = edit.find(key);
  if (found == edit.end() || !found->is_string()) throw BadEdit(fmt::format("{}: missing", key));
  return *found;
}

bool good_name(const std::string& name) {
  constexpr std::size_t kLongest = 64;
  return !name.empty() && name.size() <= kLongest && std::ranges::all_of(name, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_';
  });
}

}  // namespace

MapMending::MapMending(RunPages& pages)
    : pages_(pages),
      editor_(*pages.first(), options_of_run(pages.first_path(), pages.first()->origin).slam) {}

bool MapMending::unsaved() const {
  const std::lock_guard lock(mutex_);
  return editor_.revision() != saved_revision_;
}

HttpResponse MapMending::edits() const {
  const std::lock_guard lock(mutex_);
  return json_response({{"edits", editor_.edits()},
                        {"unsaved", editor_.revision() != saved_revision_},
                        {"optimized", editor_.optimized()}});
}

/// Writes the edited map beside the original.
std::string MapMending::save(const std::string& name) {
  if (!good_name(name))
    throw BadEdit("name: letters, digits, \"-\" and \"_\" are allowed, 64 at most");
  const fs::path path = fs::path(pages_.first_path()).parent_path() / (name + ".db");
  if (fs::exists(path)) throw ArgumentError(path.string() + ": it exists already");
  write_map(path.string(), editor_.stored());
  saved_revision_ = editor_.revision();
  return "saved as " + path.string();
}

std::string MapMending::apply(const std::string& action, const json& edit) {
  if (action == "refuse")
    return editor_.refuse(frame_in(edit, "query_frame"), frame_in(edit, "match_frame"));
  if (action == "accept")
    return editor_.accept(frame_in(edit, "query_frame"), frame_in(edit, "match_frame"));
  if (action == "add")
    return editor_.add(frame_in(edit, "query_frame"), frame_in(edit, "match_frame"));
  if (action == "save") return save(text_in(edit, "name"));
  if (action == "undo") {
    if (!editor_.undo()) throw ArgumentError("there is no edit to undo");
    return "took back the last edit";
  }
  if (action != "optimize") throw BadEdit("action: refuse, accept, add, optimize, undo or save");
  (void)editor_.optimize();
  return editor_.edits().back();
}

HttpResponse MapMending::edit(const std::string& body) {
  const std::lock_guard lock(mutex_);
  try {
    const json parsed = json::parse(body);
    if (!parsed.is_object()) throw BadEdit("an object is needed");
    const std::string action = text_in(parsed, "action");
    const std::string text = apply(action, parsed);
    if (action != "save")
      pages_.show(std::make_shared<const StoredMap>(editor_.stored()), editor_.revision() != 0);
    return json_response({{"text", text},
                          {"edits", editor_.edits()},
                          {"unsaved", editor_.revision() != saved_revision_},
                          {"optimized", editor_.optimized()}});
  } catch (const json::exception&) {
    return text_response(400, "the request is no JSON of an edit");
  } catch (const BadEdit& error) {
    return text_response(400, error.what());
  } catch (const Error& error) {
    return json_response({{"error", error.what()}}, 409);
  }
}

}  // namespace placegraph::apps
