#include "apps/support/calib_option.h"

#include <CLI/CLI.hpp>

namespace placegraph::apps {

CLI::Option* add_calib_option(CLI::App& command, std::string& path, const std::string& doc,
                              const std::string& former) {
  CLI::Option* option = command.add_option("--calib", path, doc)->check(CLI::ExistingFile);
  if (former.empty()) return option;
  // Callbacks come before the look for what is missing.
  const auto take = [&path, option, former](const std::string& given) {
    if (option->count() > 0) throw CLI::ExcludesError(former, "--calib");
    path = given;
    option->required(false);
  };
  command.add_option_function<std::string>(former, take)->check(CLI::ExistingFile)->group("");
  return option;
}

}  // namespace placegraph::apps
