#include "apps/map/loops/cmd_map_loops.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/loops/map_loops.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

void add_edit(CLI::App& loops, const char* name, LoopEdit edit, const char* what) {
  auto arguments = std::make_shared<MapLoopsArguments>();
  auto json = std::make_shared<bool>(false);
  MapLoopsArguments& a = *arguments;
  a.edit = edit;
  CLI::App* command = loops.add_subcommand(name, what);
  command->footer(std::string("placegraph map loops ") + name +
                  " out/town-run 612:40 --out mended.db");
  command
      ->add_option("MAP", a.map, kMapText)
      ->type_name(kInput)
      ->required();
  command->add_option("PAIR", a.pairs, "two frames, QUERY:MATCH, the later one first")->required();
  command
      ->add_option("-o,--out", a.out, "file for the edited map")
      ->type_name(kOutput)
      ->required();
  command->add_flag("--keep-poses", a.keep_poses, "do not optimize the map again");
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] {
    const MapLoopsResult result = map_loops(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace

void add_map_loops_commands(CLI::App& map) {
  CLI::App* loops = map.add_subcommand("loops", "Edit the loops of a saved map by hand");
  loops->footer("placegraph map loops refuse out/town-run 612:40 --out mended.db");
  loops->require_subcommand(1);
  add_edit(*loops, "refuse", LoopEdit::kRefuse, "Remove accepted loops and optimize the map again");
  add_edit(*loops, "accept", LoopEdit::kAccept,
           "Accept refused candidates whose images agree, and optimize the map again");
  add_edit(*loops, "add", LoopEdit::kAdd,
           "Add loops between frames whose images agree, and optimize the map again");
}

}  // namespace placegraph::apps
