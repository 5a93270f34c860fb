#pragma once
#include <string>
#include <vector>

namespace placegraph::apps {

/// A command line in the present spelling.
struct CommandWords {
  std::vector<std::string> words;  ///< the words behind the program's name
  std::vector<std::string> notes;  ///< one line per old spelling, naming the new one
};

/// A short form of a command, which stays beside its full name.
struct ShortForm {
  std::string name, command;  ///< "optimize", "graph optimize"
};
std::vector<ShortForm> short_forms();

/// First words of short forms and of old spellings, for suggestions.
std::vector<std::string> first_words();

/// Replaces short forms and old spellings of commands and flags by the present ones.
/// `eval T E` becomes `eval trajectory T E`, `help map info` becomes `map info --help`, and
/// `hover F` becomes `flight run F` with a note. Words that are not known are kept.
CommandWords present_spelling(std::vector<std::string> words);

}  // namespace placegraph::apps
