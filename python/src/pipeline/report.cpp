#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/report/evaluation_page.h>
#include <placegraph/pipeline/report/graph_page.h>
#include <placegraph/pipeline/report/loops_page.h>
#include <placegraph/pipeline/report/run_page.h>
#include <placegraph/pipeline/results/run_results.h>

#include "python/src/graph/maps.h"
#include "python/src/warnings.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

constexpr const char* kProgram = "placegraph " PLACEGRAPH_VERSION;

/// The page of a map, as `placegraph report` writes it; `path`: its file, empty for a map of this
/// process, which is named after its recording.
std::string map_page(const StoredMap& stored, const std::string& path, const std::string& title) {
  return run_page(stored, path, title, kProgram, python_warnings());
}

std::string map_picture(const StoredMap& stored, const std::optional<Trajectory>& truth,
                        const std::string& title) {
  for (const FrameRecord& each : stored.map.frames)
    require(!truth || each.frame.value() < static_cast<std::int64_t>(truth->size()),
            fmt::format("truth: it has no pose of frame {}", each.frame.value()));
  return run_picture(stored.map, stored.map.trajectory_optimized(), truth ? &*truth : nullptr,
                     title);
}

std::string evaluation_page(const std::vector<EvaluationResult>& results, const std::string& truth,
                            bool sequences) {
  require(!results.empty(), "results: there is none");
  return placegraph::evaluation_page({truth, results, sequences}, kProgram);
}

void require_same_graph(const PoseGraph& before, const PoseGraph& after,
                        const std::vector<int>& rejected) {
  require(before.nodes.size() == after.nodes.size() &&
              before.constraints.size() == after.constraints.size(),
          "before: it has other nodes or constraints than the graph");
  for (const int i : rejected)
    require(i >= 0 && static_cast<std::size_t>(i) < after.constraints.size(),
            fmt::format("rejected: there is no constraint {}", i));
}

std::string pose_graph_picture(const PoseGraph& graph, const PoseGraph* before,
                               const std::vector<int>& rejected, const std::string& title) {
  require(!graph.nodes.empty(), "graph: it has no nodes");
  require_same_graph(before ? *before : graph, graph, rejected);
  return before ? graph_picture(*before, graph, rejected, title)
                : graph_picture(graph, rejected, title);
}

std::string pose_graph_page(const PoseGraph& graph, const PoseGraph& before,
                            const std::vector<double>& chi2, const std::vector<int>& rejected,
                            const std::string& title) {
  require(!graph.nodes.empty(), "graph: it has no nodes");
  require_same_graph(before, graph, rejected);
  return graph_page({title, before, graph, chi2, rejected, {}}, kProgram);
}

}  // namespace

void bind_reports(nb::module_& m) {
  const auto released = nb::call_guard<WithoutGil>();
  m.def("map_page", &map_page, "map"_a, "path"_a = "", "title"_a = "", released,
        "The page of a map as `placegraph report` writes it, HTML. `path`: the file of the map, "
        "beside which are other results of its run.");
  m.def("map_picture", &map_picture, "map"_a, "truth"_a = nb::none(), "title"_a = "", released,
        "Trajectories, places and loops of a map, over the true trajectory, SVG. `truth`: poses "
        "of the recording's frames, T_world_cam.");
  m.def("evaluation_page", &evaluation_page, "results"_a, "truth"_a, "sequences"_a = false,
        released, "The page of `placegraph eval --report`, HTML; `truth`: name of the truth.");
  m.def("pose_graph_picture", &pose_graph_picture, "graph"_a, "before"_a = nb::none(),
        "rejected"_a = std::vector<int>(), "title"_a = "", released,
        "A pose graph, over what it was before its optimization if that is given, SVG.");
  m.def(
      "precision_recall_picture",
      [](const LoopBenchmark& judged, const std::string& name, const std::string& protocol) {
        return precision_recall_picture(protocol, {{name, judged.curve}});
      },
      "judged"_a, "name"_a, "protocol"_a, released,
      "Precision over recall of judged loops, SVG; `protocol`: what a true match is.");
  m.def("pose_graph_page", &pose_graph_page, "graph"_a, "before"_a,
        "chi2"_a = std::vector<double>(), "rejected"_a = std::vector<int>(), "title"_a = "",
        released, "The page of `placegraph graph optimize --report`, HTML.");
}

}  // namespace placegraph::python
