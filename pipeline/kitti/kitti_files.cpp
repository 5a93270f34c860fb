#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/eval/kitti/kitti_figures.h>
#include <placegraph/eval/kitti/kitti_plots.h>
#include <placegraph/eval/kitti/kitti_report.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/kitti/kitti_files.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace placegraph {
namespace {

namespace fs = std::filesystem;

constexpr const char *kErrors = "errors", *kPaths = "plot_path", *kErrorPlots = "plot_error";

/// Paths in the folder, and what stands in the files.
using Files = std::vector<std::pair<fs::path, std::string>>;

void add_rows(const KittiFigures& figures, const std::string& name, const fs::path& folder,
              Files& files) {
  const auto add = [&](const char* ending, std::string text) {
    files.emplace_back(folder / kErrorPlots / fmt::format("{}_{}.txt", name, ending),
                       std::move(text));
  };
  if (!figures.by_length.empty()) {
    add("tl", kitti_translations_text(figures.by_length));
    add("rl", kitti_rotations_text(figures.by_length));
  }
  if (!figures.by_speed.empty()) {
    add("ts", kitti_translations_text(figures.by_speed));
    add("rs", kitti_rotations_text(figures.by_speed));
  }
}

void add_tables(const KittiSystem& system, const fs::path& folder, Files& files) {
  for (const KittiSequence& sequence : system.sequences) {
    if (!sequence.has_truth) continue;
    const std::string name = sequence.name + ".txt";
    files.emplace_back(folder / kErrors / name, kitti_segments_text(sequence.segments));
    files.emplace_back(folder / kPaths / name, kitti_path_text(sequence.pairs));
    add_rows(sequence.figures, sequence.name, folder, files);
  }
  if (!system.mean.outcome) return;
  add_rows(system.mean, kKittiAverage, folder, files);
  files.emplace_back(folder / "stats.txt", kitti_stats_text(system.mean));
}

void add_plots(const KittiBenchmark& benchmark, const std::string& format, Files& files) {
  std::vector<std::string> names;
  for (const KittiSequence& sequence : benchmark.systems.front().sequences)
    if (sequence.has_truth) names.push_back(sequence.name);
  names.emplace_back(kKittiAverage);
  for (const std::string& name : names)
    for (std::size_t i = 0; i < kitti_plot_names().size(); ++i) {
      const auto plot = static_cast<KittiPlot>(i);
      const std::optional<Figure> figure = figure_of(benchmark, name, plot);
      if (!figure) continue;
      const fs::path path = plot == KittiPlot::kPath
                                ? fs::path(kPaths) / fmt::format("{}.{}", name, format)
                                : fs::path(kErrorPlots) /
                                      fmt::format("{}_{}.{}", name, kitti_plot_names()[i], format);
      files.emplace_back(path, picture_bytes(to_svg(*figure), path.string()));
    }
}

/// The folder of a system: names that are paths become one name.
std::string folder_name(std::string name) {
  std::ranges::replace(name, '/', '_');
  return name;
}

Files files_of(const KittiBenchmark& benchmark, const std::string& format) {
  Files files = {{"figures.csv", to_csv(benchmark)}};
  const bool several = benchmark.systems.size() > 1;
  for (const KittiSystem& system : benchmark.systems)
    add_tables(system, several ? folder_name(system.name) : "", files);
  if (format != "none") add_plots(benchmark, format, files);
  return files;
}

}  // namespace

const std::vector<std::string>& kitti_plot_formats() {
  static const std::vector<std::string> formats = {"none", "png", "svg", "pdf"};
  return formats;
}

void write_kitti_files(const KittiBenchmark& benchmark, const std::string& folder,
                       const std::string& format, bool force) {
  require(std::ranges::count(kitti_plot_formats(), format) > 0,
          fmt::format("format: '{}' is none of {}", format, fmt::join(kitti_plot_formats(), ", ")));
  require(benchmark.faults() == 0 && !benchmark.systems.empty(),
          folder + ": nothing is written for a submission with faults");
  require_free_folder(folder, force);
  const Files files = files_of(benchmark, format);
  const OutputFolder output(folder);
  for (const auto& [path, content] : files) {
    const fs::path whole = fs::path(folder) / path;
    make_output_folder(whole.parent_path().string());
    write_file(whole.string(), content);
  }
}

}  // namespace placegraph
