#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

struct ReportArguments {
  std::vector<std::string> runs;  ///< folders that `placegraph run` wrote, or their maps
  std::vector<std::string>
      georeferences;    ///< folders of `map georeference`, one each; empty: beside the runs
  std::string out;      ///< file of the report
  std::string title;    ///< title of the page; empty: the names of the runs
  std::string program;  ///< name and version of the program, for the page
  bool force = false;   ///< whether an existing file is overwritten
};

struct ReportResult {
  std::string file;       ///< the report
  std::size_t runs = 0;   ///< number of runs in it
  std::size_t bytes = 0;  ///< its size
};

/// What a page shows: `runs` as describe_run_for_report() gives them.
nlohmann::json report_data(const std::string& title, const std::string& program,
                           nlohmann::json runs);

/// Writes a page with the runs that opens from disk without a network.
ReportResult report(const ReportArguments& arguments);
std::string to_text(const ReportResult& result);

/// Writes the page of the run in a folder, if the run has a map, and replaces an earlier one.
/// `program`: name and version of the program.
void write_run_page(const std::string& folder, const std::string& file, const std::string& program);

}  // namespace placegraph::apps
