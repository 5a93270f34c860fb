#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/results/plot_beside.h>

namespace placegraph {

void write_plot_beside(const std::string& path, const std::string& svg, const LogSink& log) {
  std::string bytes;
  try {
    bytes = picture_bytes(svg, path);
  } catch (const FileError& error) {
    if (log) log(LogLevel::kWarning, error.what());
    return;
  }
  write_file(path, bytes);
}

}  // namespace placegraph
