#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/report/page.h>
#include <placegraph/pipeline/report/run_page.h>
#include <placegraph/pipeline/report/run_part.h>
#include <placegraph/pipeline/report/tables/page_thinning.h>

#include <filesystem>
#include <nlohmann/json.hpp>

namespace placegraph {

using nlohmann::json;

namespace {

std::string thinned_page(const std::string& title, const std::string& program, json runs) {
  json data = report::report_data(title, program, std::move(runs));
  report::thin_report(data, report::kMostRunPageBytes);
  return report::page_with(data);
}

}  // namespace

void require_page_name(const std::string& path) {
  const std::string extension = extension_of(path);
  require(extension == ".html" || extension == ".htm", path + ": a page ends in .html");
}

RunPageResult write_run_page(const RunPageArguments& arguments, const LogSink& log) {
  require_page_name(arguments.out);
  require_free(arguments.out, arguments.force);
  require(
      arguments.georeferences.empty() || arguments.georeferences.size() == arguments.runs.size(),
      "--georeference: one folder for each run");
  json runs = json::array();
  std::string names;
  for (std::size_t i = 0; i < arguments.runs.size(); ++i) {
    runs.push_back(report::describe_run_for_report(
        arguments.runs[i], arguments.georeferences.empty() ? "" : arguments.georeferences[i], log));
    names += (names.empty() ? "" : ", ") + runs.back()["name"].get<std::string>();
  }
  const std::string page = thinned_page(arguments.title.empty() ? names : arguments.title,
                                        arguments.program, std::move(runs));
  write_file(arguments.out, page);
  return {arguments.out, arguments.runs.size(), page.size()};
}

std::string to_text(const RunPageResult& result) {
  return fmt::format("{}: {} run{}, {:.1f} MB\n", result.file, result.runs,
                     result.runs == 1 ? "" : "s", 1e-6 * static_cast<double>(result.bytes));
}

std::string run_page(const StoredMap& stored, const std::string& path, const std::string& title,
                     const std::string& program, const LogSink& log) {
  namespace fs = std::filesystem;
  std::string file = path;
  if (file.empty()) {
    const fs::path recording = (fs::path(stored.origin.sequence) / "").parent_path().filename();
    file = (recording.empty() ? "map" : recording.string()) + ".db";
  }
  json run = report::describe_run_for_report(stored, file, "", log);
  if (path.empty()) run["folder"] = "";
  const std::string name = title.empty() ? run["name"].get<std::string>() : title;
  json runs = json::array();
  runs.push_back(std::move(run));
  return thinned_page(name, program, std::move(runs));
}

}  // namespace placegraph
