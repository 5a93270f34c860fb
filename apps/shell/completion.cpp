#include "apps/shell/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/core/error.h>

#include <CLI/CLI.hpp>
#include <functional>

#include "apps/shell/cmd_tree.h"
#include "apps/shell/spellings.h"

namespace placegraph::apps {
namespace {

/// A flag with the values that it takes, as far as they are a fixed list.
struct Flag {
  std::string name, text;
  std::vector<std::string> choices;
};

/// A command with all words that may follow it.
struct Node {
  std::string path;  ///< "map export"; empty for the program itself
  std::vector<std::pair<std::string, std::string>> commands;  ///< name and description
  std::vector<Flag> flags;
};

void list_nodes(const CLI::App& app, const std::string& path, std::vector<Node>& nodes) {
  Node node{path, {}, {}};
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames())
      if (!option->get_group().empty())
        node.flags.push_back({"--" + name, option->get_description(), choices_of(*option)});
  for (const CLI::App* command : commands_of(app))
    node.commands.emplace_back(command->get_name(), command->get_description());
  nodes.push_back(std::move(node));
  for (const CLI::App* command : commands_of(app))
    list_nodes(*command, path.empty() ? command->get_name() : path + " " + command->get_name(),
               nodes);
}

std::vector<Node> nodes_of(const CLI::App& app) {
  std::vector<Node> nodes;
  list_nodes(app, "", nodes);
  for (const ShortForm& form : short_forms())
    nodes.front().commands.emplace_back(form.name, form.command);
  return nodes;
}

/// The names of commands or flags, separated by blanks.
template <class Items, class Name>
std::string names_of(const Items& items, Name name) {
  std::string words;
  for (const auto& item : items) words += (words.empty() ? "" : " ") + std::invoke(name, item);
  return words;
}

/// The function of bash by which words are completed; flags only behind a dash, so that files are
/// completed where a command takes them.
std::string bash_function(const std::vector<Node>& nodes) {
  std::string paths, commands, flags, values;
  for (const ShortForm& form : short_forms())
    paths += fmt::format("    '{}') command='{}' ;;\n", form.name, form.command);
  for (const Node& node : nodes) {
    if (!node.path.empty()) paths += fmt::format("    '{0}') command='{0}' ;;\n", node.path);
    commands += fmt::format("    '{}') words='{}' ;;\n", node.path,
                            names_of(node.commands, &std::pair<std::string, std::string>::first));
    flags += fmt::format("    '{}') words='{}' ;;\n", node.path, names_of(node.flags, &Flag::name));
    for (const Flag& flag : node.flags)
      if (!flag.choices.empty())
        values += fmt::format("    '{} {}') words='{}' ;;\n", node.path, flag.name,
                              fmt::join(flag.choices, " "));
  }
  return "_placegraph_words() {\n"
         "  local command='' words='' i\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case \"${command:+$command }${COMP_WORDS[i]}\" in\n" +
         paths +
         "    esac\n"
         "  done\n"
         "  case \"$command ${COMP_WORDS[COMP_CWORD-1]}\" in\n" +
         values +
         "  esac\n"
         "  if [[ -z $words && ${COMP_WORDS[COMP_CWORD]} == -* ]]; then\n"
         "    case $command in\n" +
         flags +
         "    esac\n"
         "  elif [[ -z $words ]]; then\n"
         "    case $command in\n" +
         commands +
         "    esac\n"
         "  fi\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n"
         "}\n";
}

std::string bash_script(const std::vector<Node>& nodes) {
  return "# bash completion of placegraph, written by `placegraph completion bash`\n" +
         bash_function(nodes) +
         "complete -o default -o bashdefault -F _placegraph_words placegraph\n";
}

/// zsh runs the function of bash by its emulation of bash's completion.
std::string zsh_script(const std::vector<Node>& nodes) {
  return "#compdef placegraph\n"
         "# zsh completion of placegraph, written by `placegraph completion zsh`\n"
         "autoload -Uz bashcompinit && bashcompinit\n" +
         bash_function(nodes) + "_bash_complete -o default -F _placegraph_words\n";
}

std::string fish_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

/// True where exactly the words of `path`, and no command below it, have been given.
std::string fish_condition(const Node& node) {
  if (node.path.empty()) return "__fish_use_subcommand";
  std::string condition;
  for (const std::string& word : CLI::detail::split(node.path, ' '))
    condition += (condition.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + word);
  for (const auto& command : node.commands)
    condition += "; and not __fish_seen_subcommand_from " + command.first;
  return condition;
}

std::string fish_script(const std::vector<Node>& nodes) {
  std::string text = "# fish completion of placegraph, written by `placegraph completion fish`\n";
  for (const Node& node : nodes) {
    const std::string head = "complete -c placegraph -n " + fish_quoted(fish_condition(node));
    for (const auto& [name, what] : node.commands)
      text += head + " -f -a " + name + " -d " + fish_quoted(what) + "\n";
    for (const Flag& flag : node.flags) {
      text += head + " -l " + flag.name.substr(2) + " -d " + fish_quoted(flag.text);
      if (!flag.choices.empty())
        text += " -x -a " + fish_quoted(fmt::format("{}", fmt::join(flag.choices, " ")));
      text += "\n";
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> completion_shells() { return {"bash", "fish", "zsh"}; }

std::string completion_script(const CLI::App& app, const std::string& shell) {
  const std::vector<Node> nodes = nodes_of(app);
  if (shell == "bash") return bash_script(nodes);
  if (shell == "fish") return fish_script(nodes);
  require(shell == "zsh", "completion: '" + shell + "' is not one of bash, fish, zsh");
  return zsh_script(nodes);
}

}  // namespace placegraph::apps
