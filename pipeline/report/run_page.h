#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/io/map/stored_map.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Which runs a page shows, and where it is written.
struct RunPageArguments {
  std::vector<std::string> runs;  ///< folders that `placegraph run` wrote, or their maps
  std::vector<std::string>
      georeferences;    ///< folders of `map georeference`, one each; empty: beside the runs
  std::string out;      ///< file of the page
  std::string title;    ///< title of the page; empty: the names of the runs
  std::string program;  ///< name and version of the program, for the page
  bool force = false;   ///< whether an existing file is overwritten
};

/// The page that was written.
struct RunPageResult {
  std::string file;       ///< the page
  std::size_t runs = 0;   ///< number of runs in it
  std::size_t bytes = 0;  ///< its size
};

/// Checks that a file for a page has an extension that browsers know, .html or .htm.
/// Throws ArgumentError for another one.
void require_page_name(const std::string& path);

/// Writes a page with runs, as `placegraph report` does.
///
/// It opens from disk without a network.
///
/// Where the recording is at its path and has ground truth, errors and figures are those of the
/// optimized trajectory against it. `log` takes warnings of what is left out of the page.
/// Throws ArgumentError for a file that exists or has another extension, and FileError.
RunPageResult write_run_page(const RunPageArguments& arguments, const LogSink& log = {});

/// One line on the page that was written.
std::string to_text(const RunPageResult& result);

/// The same page of one map that was read, HTML.
///
/// `path` is the file of the map, beside which are other results of its run; an empty one stands
/// for a map without a file, which is named after its recording. An empty `title` is the name of
/// the run. Throws FileError for files beside the map that are broken.
std::string run_page(const StoredMap& stored, const std::string& path, const std::string& title,
                     const std::string& program, const LogSink& log = {});

}  // namespace placegraph
