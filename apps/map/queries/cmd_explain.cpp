#include "apps/map/queries/cmd_explain.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/queries/explain.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_explain_command(CLI::App& map) {
  auto arguments = std::make_shared<ExplainArguments>();
  auto json = std::make_shared<bool>(false);
  ExplainArguments& a = *arguments;
  CLI::App* command = map.add_subcommand(
      "explain", "Explain one frame of a map: its pose, the evidence for it, rejected loops");
  command->footer("placegraph map explain out/drive 250 --json");
  command->add_option("MAP", a.map, kMapText)->type_name(kInput)->required();
  command
      ->add_option_function<std::int64_t>(
          "FRAME", [&a](std::int64_t frame) { a.frame = FrameId(frame); },
          "number of the frame in its sequence")
      ->required()
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1'000'000'000}));
  command->add_flag("--json", *json, kJsonText);
  command->callback([arguments, json] {
    const ExplainResult result = explain(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
