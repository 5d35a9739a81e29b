#pragma once

#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace encore::test {

/// The commands in the text of `encore --help`.
inline std::vector<std::string> commands_of(const std::string& help) {
  std::vector<std::string> commands;
  std::istringstream lines(help);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "Subcommands:") {
      inside = true;
    } else if (line.rfind("  ", 0) != 0) {
      inside = false;
    } else if (inside && line[2] != ' ') {
      commands.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
  }
  return commands;
}

/// The exit codes in the text of `encore --help`, each with its first words.
inline std::map<int, std::string> exit_codes_of(const std::string& help) {
  static const std::regex pattern(R"((\d+) ([A-Za-z][A-Za-z ]*[A-Za-z]))");
  std::map<int, std::string> codes;
  const std::size_t start = help.find("Exit codes:");
  if (start == std::string::npos) return codes;
  const std::string text = help.substr(start);
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    codes[std::stoi((*match)[1])] = (*match)[2];
  }
  return codes;
}

}  // namespace encore::test
