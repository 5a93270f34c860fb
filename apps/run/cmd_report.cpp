#include "apps/run/cmd_report.h"

#include <CLI/CLI.hpp>
#include <memory>

#include <placegraph/pipeline/report/run_page.h>
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_report_command(CLI::App& app) {
  auto arguments = std::make_shared<RunPageArguments>();
  RunPageArguments& a = *arguments;
  a.program = "placegraph " PLACEGRAPH_VERSION;
  CLI::App* command = app.add_subcommand("report", "Write a page that shows runs, for a browser");
  command->footer("placegraph report out/town-run -o report.html");
  command->add_option("RUN", a.runs, "folders that `placegraph run` wrote, or their map.db")
      ->type_name(kInput)
      ->required();
  command->add_option("-o,--out", a.out, "the page, one file")->type_name(kOutput)->required();
  command
      ->add_option("--georeference", a.georeferences,
                   "folders written by `placegraph map georeference`, one for each run; "
                   "default: what lies in the run's folder or in `georeference` in it")
      ->type_name(kInput);
  command->add_option("--title", a.title, "its title; default: the names of the runs");
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments] { print(to_text(write_run_page(*arguments, messages()))); });
}

}  // namespace placegraph::apps
