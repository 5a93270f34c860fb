#include "apps/eval/benchmarks/cmd_eval_table.h"

#include <placegraph/eval/tables/table_writers.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/eval/benchmarks/eval_table.h"
#include "apps/eval/cmd_eval.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct EvalTableCommand {
  EvalTableArguments arguments;
  bool json = false;
};

}  // namespace

void add_eval_table_command(CLI::App& eval_group) {
  auto table_command = std::make_shared<EvalTableCommand>();
  EvalTableArguments& a = table_command->arguments;
  CLI::App* command = eval_group.add_subcommand(
      "table",
      "Make a table of figures of systems on sequences, from trajectories or evo's results");
  command->footer(
      "placegraph eval table ours=out/ours theirs=out/theirs --truth gt --out table.tex,table.md");
  command
      ->add_option("SYSTEM", a.systems,
                   "NAME=PATH or PATH: folders of trajectories, paired with those of --truth by "
                   "name; or result archives of evo (.zip)")
      ->required()
      ->type_name(kInput);
  command
      ->add_option("--truth", a.judging.truth,
                   "folder of true trajectories, or one true trajectory for a system each")
      ->check(CLI::ExistingPath);
  command
      ->add_option("--figures", a.figures,
                   "keys of figures, joined by commas, as in the JSON of `eval trajectory` "
                   "[ate_rmse_m,t_rel_percent; of archives the RMSE, as ape_m_rmse]")
      ->delimiter(',');
  command->add_option("--rows", a.rows, "what the rows are")
      ->check(CLI::IsMember(table_row_names()))
      ->capture_default_str();
  add_protocol_options(*command, a.judging);
  command->add_flag("--intervals", a.judging.options.intervals,
                    "confidence intervals of the figures");
  command
      ->add_option("-o,--out", a.outputs,
                   "files to write, joined by commas: .txt, .csv, .tex, .md, .json, .html")
      ->delimiter(',')
      ->type_name(kOutput);
  command->add_flag("--json", table_command->json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([table_command] {
    const FigureTable table = eval_table(table_command->arguments);
    print(table_command->json ? to_json(table) : to_text(table));
  });
}

}  // namespace placegraph::apps
