#include "apps/shell/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/core/error.h>

#include <CLI/CLI.hpp>

#include "apps/shell/cmd_tree.h"

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

/// "TEXT:{a,b}" names the choices a and b.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

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
  return nodes;
}

std::string words_of(const Node& node) {
  std::vector<std::string> words;
  for (const auto& command : node.commands) words.push_back(command.first);
  for (const Flag& flag : node.flags) words.push_back(flag.name);
  return fmt::format("{}", fmt::join(words, " "));
}

std::string bash_script(const std::vector<Node>& nodes) {
  std::string commands, words, values;
  for (const Node& node : nodes) {
    if (!node.path.empty()) commands += fmt::format("    '{}') path=$next ;;\n", node.path);
    words += fmt::format("    '{}') words='{}' ;;\n", node.path, words_of(node));
    for (const Flag& flag : node.flags)
      if (!flag.choices.empty())
        values += fmt::format("    '{} {}') words='{}' ;;\n", node.path, flag.name,
                              fmt::join(flag.choices, " "));
  }
  return "# bash completion of placegraph, written by `placegraph completion bash`\n"
         "_placegraph() {\n"
         "  local path='' next words='' word i\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    word=${COMP_WORDS[i]}\n"
         "    next=${path:+$path }$word\n"
         "    case $next in\n" +
         commands +
         "    esac\n"
         "  done\n"
         "  case \"$path ${COMP_WORDS[COMP_CWORD-1]}\" in\n" +
         values +
         "  esac\n"
         "  if [[ -z $words ]]; then\n"
         "    case $path in\n" +
         words +
         "    esac\n"
         "  fi\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n"
         "}\n"
         "complete -o default -o bashdefault -F _placegraph placegraph\n";
}

/// The bash function serves zsh by its emulation of bash's completion.
std::string zsh_script(const std::vector<Node>& nodes) {
  return "#compdef placegraph\n"
         "# zsh completion of placegraph, written by `placegraph completion zsh`\n"
         "autoload -Uz bashcompinit && bashcompinit\n" +
         bash_script(nodes);
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
