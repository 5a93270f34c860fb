#include "apps/report/report.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/page/page.h"
#include "apps/report/parts.h"
#include "apps/report/report_run.h"
#include "apps/support/output.h"

namespace placegraph::apps {

using nlohmann::json;

json report_data(const std::string& title, const std::string& program, json runs) {
  json data = bare_report(program, title);
  data["runs"] = std::move(runs);
  return data;
}

ReportResult report(const ReportArguments& arguments) {
  require_page_name(arguments.out);
  require_free(arguments.out, arguments.force);
  require(
      arguments.georeferences.empty() || arguments.georeferences.size() == arguments.runs.size(),
      "--georeference: one folder for each run");
  json runs = json::array();
  std::string names;
  for (std::size_t i = 0; i < arguments.runs.size(); ++i) {
    runs.push_back(describe_run_for_report(
        arguments.runs[i], arguments.georeferences.empty() ? "" : arguments.georeferences[i]));
    names += (names.empty() ? "" : ", ") + runs.back()["name"].get<std::string>();
  }
  const std::string page = page_with(report_data(arguments.title.empty() ? names : arguments.title,
                                                 arguments.program, std::move(runs)));
  write_file(arguments.out, page);
  return {arguments.out, arguments.runs.size(), page.size()};
}

void write_run_page(const std::string& folder, const std::string& file,
                    const std::string& program) {
  if (!std::filesystem::exists(std::filesystem::path(folder) / "map.db")) return;
  ReportArguments arguments;
  arguments.runs = {folder};
  arguments.out = file;
  arguments.program = program;
  arguments.force = true;
  (void)report(arguments);
}

std::string to_text(const ReportResult& result) {
  return fmt::format("{}: {} run{}, {:.1f} MB\n", result.file, result.runs,
                     result.runs == 1 ? "" : "s", 1e-6 * static_cast<double>(result.bytes));
}

}  // namespace placegraph::apps
