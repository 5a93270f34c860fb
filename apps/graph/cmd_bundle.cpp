#include "apps/graph/cmd_bundle.h"

#include <fmt/format.h>
#include <placegraph/backend/factor_graph/bundle_adjustment.h>
#include <placegraph/io/graphs/bal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct BundleArguments {
  std::string in, out, kernel = "none";
  bool json = false, force = false;
  BundleOptions options;
};

void run(BundleArguments arguments) {
  const auto& names = robust_kernel_names();
  arguments.options.kernel.kind = static_cast<RobustKernel::Kind>(
      std::find(names.begin(), names.end(), arguments.kernel) - names.begin());
  arguments.options.check();
  if (!arguments.out.empty()) require_free(arguments.out, arguments.force);
  const Bundle start = read_bal(arguments.in);

  const auto wall_begin = std::chrono::steady_clock::now();
  const std::clock_t cpu_begin = std::clock();
  const BundleReport report = adjust_bundle(start, arguments.options);
  const double cpu_ms = 1e3 * static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
  const double wall_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - wall_begin)
          .count();
  if (!report.outcome) throw NoAnswer(arguments.in + ": " + report.outcome.reason);
  if (!arguments.out.empty()) write_bal(arguments.out, report.bundle);

  if (arguments.json) {
    nlohmann::ordered_json json;
    json["in"] = arguments.in;
    json["cameras"] = start.cameras.size();
    json["points"] = start.points.size();
    json["observations"] = start.observations.size();
    json["cost_initial"] = report.cost_initial;
    json["cost"] = report.cost_final;
    json["rms_px"] = report.rms_px;
    json["iterations"] = report.iterations;
    json["cpu_ms"] = cpu_ms;
    json["wall_ms"] = wall_ms;
    std::puts(json.dump(2).c_str());
    return;
  }
  fmt::print("{}: {} cameras, {} points, {} observations\n", arguments.in, start.cameras.size(),
             start.points.size(), start.observations.size());
  fmt::print("  half the sum of squares {:.6f} -> {:.6f}, {:.4f} px rms\n", report.cost_initial,
             report.cost_final, report.rms_px);
  fmt::print("  {} iterations, {:.1f} ms CPU, {:.1f} ms wall{}\n", report.iterations, cpu_ms,
             wall_ms, arguments.out.empty() ? "" : "; written to " + arguments.out);
}

}  // namespace

void add_bundle_command(CLI::App& app) {
  auto arguments = std::make_shared<BundleArguments>();
  BundleArguments& a = *arguments;
  CLI::App* command =
      app.add_subcommand("bundle", "Bundle adjustment of a problem in the form of BAL");
  command->footer("placegraph bundle problem-49-7776-pre.txt -o adjusted.txt --json");
  command->add_option("IN", a.in, "problem to read")->required()->check(CLI::ExistingFile);
  command->add_option("-o,--out", a.out, "problem to write, adjusted");
  command->add_option("--kernel", a.kernel, "robust kernel on the reprojection errors")
      ->check(CLI::IsMember(robust_kernel_names()))
      ->capture_default_str();
  command->add_option("--kernel-width", a.options.kernel.width, "its width [px]")
      ->check(CLI::Range(0.01, 1e6))
      ->capture_default_str();
  command->add_option("--iterations", a.options.max_iterations, "at most")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_flag("--json", a.json, "print JSON");
  command->add_flag("--force", a.force, "overwrite OUT");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
