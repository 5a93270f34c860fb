#include <placegraph/pipeline/report/tables/page_thinning.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include <placegraph/pipeline/report/tables/column.h>
#include <placegraph/pipeline/report/tables/graph_thinning.h>
#include <placegraph/pipeline/report/tables/row_thinning.h>

namespace placegraph::report {
namespace {

using nlohmann::json;
using Rows = std::vector<std::size_t>;

/// What a sentence on left out rows takes at most.
constexpr std::size_t kNoteBytes = 150;

/// Replaces the columns of a table by some of their rows.
void keep_rows(json& table, const Rows& rows) {
  for (auto& [name, column] : table.items())
    if (column.is_object()) column = rows_of_column(column, rows);
}

std::string left_out(std::size_t kept, std::size_t all, const char* what) {
  return fmt::format("this page has {} of {} {}; figures and counts are of all", kept, all, what);
}

/// Keeps fewer rows until a table has so few bytes; `rows_for` chooses so many.
template <class RowsFor>
Rows fit_rows(json& table, std::size_t count, std::size_t most_bytes, const RowsFor& rows_for) {
  const double bytes_per_row =
      static_cast<double>(page_bytes(table)) / static_cast<double>(std::max<std::size_t>(count, 1));
  auto most = static_cast<std::size_t>(static_cast<double>(most_bytes) / bytes_per_row);
  while (true) {
    const Rows rows = rows_for(std::max<std::size_t>(most, 2));
    json kept = table;
    keep_rows(kept, rows);
    if (most <= 2 || page_bytes(kept) <= most_bytes) {
      table = std::move(kept);
      return rows;
    }
    most -= std::max<std::size_t>(most / 20, 1);
  }
}

/// Rows of loops by their worth: accepted and wrong ones, missed ones, others.
std::array<Rows, 3> loops_by_worth(const json& loops) {
  const std::vector<float> stage = values_of(loops["stage"]["index"]);
  std::array<Rows, 3> rows;
  for (std::size_t i = 0; i < stage.size(); ++i) {
    const std::string name =
        stage[i] < 0 ? "" : loops["stage"]["table"][static_cast<std::size_t>(stage[i])];
    rows[name == "accepted" || name == "wrong" ? 0U : name == "missed" ? 1U : 2U].push_back(i);
  }
  return rows;
}

void thin_loops(json& run, std::size_t most_bytes) {
  json& loops = run["loops"];
  const std::size_t count = rows_of(loops["query_frame"]);
  const std::array<Rows, 3> by_worth = loops_by_worth(loops);
  const Rows rows = fit_rows(loops, count, most_bytes, [&](std::size_t most) {
    Rows kept;
    for (const Rows& each : by_worth)
      for (const std::size_t i : even_rows(each.size(), most - kept.size()))
        kept.push_back(each[i]);
    std::ranges::sort(kept);
    return kept;
  });
  run["notes"].push_back(left_out(rows.size(), count, "loops, the important ones first"));
}

/// Rows of the frames with these ids, ascending.
Rows rows_of_ids(const std::vector<float>& ids, const std::set<float>& wanted) {
  Rows rows;
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (wanted.contains(ids[i])) rows.push_back(i);
  return rows;
}

std::vector<RowSeries> series_of(const json& frames) {
  std::vector<RowSeries> series;
  for (const char* name : {"pose", "online", "truth"})
    if (!frames[name].is_null()) series.push_back({values_of(frames[name]), 7, 3});
  for (const char* name : {"error_m", "error_deg", "sigma_m", "confidence", "inliers", "component"})
    if (!frames[name].is_null()) series.push_back({values_of(frames[name]), 1, 1});
  for (const auto& [name, values] : frames.items())
    if (name.starts_with("series_")) series.push_back({values_of(values), 1, 1});
  return series;
}

/// Rows of the frames of loops; without loops, of keyframes.
Rows wanted_frames(const json& run, const std::vector<float>& ids) {
  std::set<float> wanted;
  if (!run["loops"].is_null())
    for (const char* end : {"query_frame", "match_frame"})
      for (const float id : values_of(run["loops"][end])) wanted.insert(id);
  if (wanted.empty())
    for (const float id : values_of(run["keyframes"]["frame"])) wanted.insert(id);
  return rows_of_ids(ids, wanted);
}

double path_length(const json& frames) {
  const std::vector<float> pose = values_of(frames["pose"]),
                           component = values_of(frames["component"]);
  double length = 0;
  for (std::size_t i = 1; i < component.size(); ++i) {
    if (component[i] != component[i - 1]) continue;
    const float *a = &pose[7 * (i - 1)], *b = &pose[7 * i];
    const double step =
        std::hypot(static_cast<double>(b[0] - a[0]), static_cast<double>(b[1] - a[1]),
                   static_cast<double>(b[2] - a[2]));
    if (std::isfinite(step)) length += step;
  }
  return length;
}

/// The keyframe that stands for each one: the last kept one before it in its component, or the
/// first one.
std::unordered_map<float, float> kept_keyframes(const json& frames, const json& keyframes,
                                                const Rows& kept) {
  std::unordered_map<float, float> component_of, stands_for, last, first;
  const std::vector<float> ids = values_of(frames["id"]),
                           component = values_of(frames["component"]);
  for (std::size_t i = 0; i < ids.size(); ++i) component_of[ids[i]] = component[i];
  const std::vector<float> id = values_of(keyframes["id"]), frame = values_of(keyframes["frame"]);
  for (const std::size_t i : kept) first.try_emplace(component_of[frame[i]], id[i]);
  std::size_t next = 0;
  for (std::size_t i = 0; i < id.size(); ++i) {
    const float of = component_of[frame[i]];
    if (next < kept.size() && kept[next] == i) last[of] = id[i], ++next;
    const auto before = last.find(of);
    const auto any = before == last.end() ? first.find(of) : before;
    if (any != (before == last.end() ? first.end() : last.end())) stands_for[id[i]] = any->second;
  }
  return stands_for;
}

/// The image points of some keyframes.
json tracks_of_rows(const json& tracks, const Rows& rows) {
  if (tracks.is_null()) return tracks;
  std::vector<std::size_t> first = {0};
  for (const float count : values_of(tracks["count"]))
    first.push_back(first.back() + static_cast<std::size_t>(count));
  Rows points;
  for (const std::size_t row : rows)
    for (std::size_t i = first[row]; i < first[row + 1]; ++i) points.push_back(i);
  return {{"count", rows_of_column(tracks["count"], rows)},
          {"landmark", rows_of_column(tracks["landmark"], points)},
          {"pixel", rows_of_column(tracks["pixel"], points)}};
}

/// Leaves keyframes out whose frames are; landmarks of these belong to the one before.
void thin_keyframes(json& run, const json& all_frames, const std::set<float>& frames) {
  json& keyframes = run["keyframes"];
  const std::vector<float> frame = values_of(keyframes["frame"]);
  const Rows rows = rows_of_ids(frame, frames);
  if (rows.size() == frame.size()) return;
  const auto stands_for = kept_keyframes(all_frames, keyframes, rows);
  std::vector<std::int32_t> of_landmarks;
  for (const float id : values_of(run["landmarks"]["keyframe"])) {
    const auto found = stands_for.find(id);
    of_landmarks.push_back(
        static_cast<std::int32_t>(found == stands_for.end() ? id : found->second));
  }
  run["landmarks"]["keyframe"] = column(of_landmarks);
  json thumbnails = json::array();
  for (const std::size_t row : rows) thumbnails.push_back(keyframes["thumbnails"][row]);
  json tracks = tracks_of_rows(keyframes["tracks"], rows);
  keyframes.erase("tracks");
  keep_rows(keyframes, rows);
  keyframes["thumbnails"] = std::move(thumbnails);
  keyframes["tracks"] = std::move(tracks);
  run["notes"].push_back(left_out(rows.size(), frame.size(), "keyframes and images"));
}

void thin_frames(json& run, std::size_t most_bytes) {
  json& frames = run["frames"];
  const json all = frames;
  const std::vector<float> ids = values_of(all["id"]);
  const std::vector<RowSeries> series = series_of(all);
  const Rows wanted = wanted_frames(run, ids);
  if (!run["georeference"].is_null()) frames["track"] = run["georeference"]["track"];
  const Rows rows = fit_rows(frames, ids.size(), most_bytes, [&](std::size_t most) {
    return chosen_rows(ids.size(), series, wanted, most);
  });
  if (!run["georeference"].is_null()) run["georeference"]["track"] = frames["track"];
  frames.erase("track");
  run["summary"]["path_length"] = path_length(all);
  run["notes"].push_back(
      left_out(rows.size(), ids.size(), "frames, ends of gaps and outliers first"));
  std::set<float> kept;
  for (const std::size_t row : rows) kept.insert(ids[row]);
  thin_keyframes(run, all, kept);
}

void thin_landmarks(json& run, std::size_t most_bytes) {
  json& landmarks = run["landmarks"];
  const std::size_t count = rows_of(landmarks["keyframe"]);
  fit_rows(landmarks, count, most_bytes, [&](std::size_t most) { return even_rows(count, most); });
}

/// A table of a run, and what makes it smaller.
struct ThinnedTable {
  json* owner;
  std::size_t bytes;
  void (*thin)(json&, std::size_t);
};

std::size_t bytes_of_frames(const json& run) {
  const json& earth = run["georeference"];
  return page_bytes(run["frames"]) + (earth.is_null() ? 0 : page_bytes(earth["track"]));
}

std::vector<ThinnedTable> tables_of(json& report) {
  std::vector<ThinnedTable> tables;
  for (json& run : report["runs"]) {
    if (!run["loops"].is_null())  // first: their frames stay
      tables.push_back({&run, page_bytes(run["loops"]), thin_loops});
    tables.push_back({&run, bytes_of_frames(run), thin_frames});
    tables.push_back({&run, page_bytes(run["landmarks"]), thin_landmarks});
    tables.push_back(
        {&run, page_bytes(run["places"]) + page_bytes(run["constraints"]), thin_places});
  }
  for (json& graph : report["graphs"])
    tables.push_back({&graph, page_bytes(graph) - page_bytes(graph["figures"]), thin_graph});
  return tables;
}

/// The number of bytes to which tables are limited so that all of them have so many.
std::size_t limit_of(const std::vector<ThinnedTable>& tables, std::size_t most) {
  std::vector<std::size_t> bytes;
  for (const ThinnedTable& table : tables) bytes.push_back(table.bytes);
  std::ranges::sort(bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t share = most / (bytes.size() - i);
    if (bytes[i] > share) return share;
    most -= bytes[i];
  }
  return bytes.empty() ? 0 : bytes.back();
}

std::size_t bytes_of_images(const json& report) {
  std::size_t bytes = 0;
  for (const json& run : report["runs"]) bytes += page_bytes(run["keyframes"]);
  return bytes;
}

}  // namespace

void thin_report(json& report, std::size_t most) {
  const std::size_t all = page_bytes(report) - bytes_of_images(report);
  if (all <= most) return;
  std::vector<ThinnedTable> tables = tables_of(report);
  std::size_t other = all + kNoteBytes * tables.size();
  for (const ThinnedTable& table : tables) other -= table.bytes;
  const std::size_t limit = limit_of(tables, most > other ? most - other : 0);
  for (const ThinnedTable& table : tables)
    if (table.bytes > limit) table.thin(*table.owner, limit);
}

}  // namespace placegraph::report
