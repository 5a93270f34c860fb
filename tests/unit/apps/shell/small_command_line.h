#pragma once
#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace placegraph::apps {

/// A command line with a group of two commands, a command of its own and a hidden one.
struct SmallCommandLine {
  SmallCommandLine() {
    app.footer("placegraph run a");
    CLI::App* group = app.add_subcommand("map", "Saved maps");
    group->footer("placegraph map info a.db");
    group->require_subcommand(1);
    info = group->add_subcommand("info", "Tell what a map <holds>, it's *all*");
    info->footer("placegraph map info a.db");
    info->add_option("MAP", map, "a file")->required();
    info->add_option("-k,--kind", kind, "kind of a|b")
        ->check(CLI::IsMember({"short", "long"}))
        ->capture_default_str();
    info->add_flag("--json", json, "print .json \\ nothing else");
    info->add_option("--secret", secret, "for tests")->group("");
    draw = group->add_subcommand("draw", "Draw a map");
    draw->footer("placegraph map draw a.db");
    run = app.add_subcommand("run", "Run");
    run->footer("placegraph run a");
    run->add_option("SEQUENCE", sequence, "images");
    run->add_option("--frames", frames, "number of frames");
    app.add_subcommand("hidden", "Not shown")->group("");
  }
  void parse(std::vector<std::string> words) {
    std::reverse(words.begin(), words.end());
    app.parse(std::move(words));
  }
  CLI::App app{"Does things", "placegraph"};
  CLI::App *info = nullptr, *draw = nullptr, *run = nullptr;
  std::string map, kind = "short", secret, sequence;
  bool json = false;
  int frames = 0;
};

}  // namespace placegraph::apps
