#include "apps/graph/cmd_bundle.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/graph/bundle.h"
#include "apps/graph/colmap_bundle.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_bundle_command(CLI::App& graph) {
  auto arguments = std::make_shared<BundleArguments>();
  auto json = std::make_shared<bool>(false);
  BundleArguments& a = *arguments;
  CLI::App* command =
      graph.add_subcommand("bundle", "Adjust a bundle of cameras and points: BAL or COLMAP");
  command->footer("placegraph graph bundle problem-49-7776-pre.txt -o adjusted.txt --json");
  command->add_option("IN", a.in, "problem in BAL format, or folder of a COLMAP model")
      ->required()
      ->check(CLI::ExistingPath);
  command
      ->add_option("-o,--out", a.out, "file or folder for the adjusted problem")
      ->type_name(kOutput);
  command->add_option("--kernel", a.kernel, "robust kernel of the reprojection errors")
      ->check(CLI::IsMember(robust_kernel_names()))
      ->capture_default_str();
  command->add_option("--kernel-width", a.options.kernel.width, "width of the robust kernel [px]")
      ->check(CLI::Range(0.01, 1e6))
      ->capture_default_str();
  command->add_option("--iterations", a.options.max_iterations, "largest number of iterations")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] {
    if (std::filesystem::is_directory(arguments->in)) {
      const ColmapBundleResult result = colmap_bundle(*arguments);
      print(*json ? to_json(result) : to_text(result));
      return;
    }
    const BundleResult result = bundle(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
