// Commands and options as --help prints them.
#pragma once

#include <regex>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"

namespace hapticwall::command::test {

class HelpTest : public ProgramTest {
 protected:
  [[nodiscard]] std::string help(const std::string& command) const {
    const Answer answer =
        command.empty() ? hapticwall({"--help"}) : hapticwall({command, "--help"});
    EXPECT_EQ(answer.status, 0);
    return answer.out;
  }
  [[nodiscard]] std::vector<std::string> commands() const {
    const std::string text = help("");
    const std::string part =
        text.substr(0, text.find("\nExamples:\n")).substr(text.find("\nCommands:\n"));
    return found_in(part, "\n  ([a-z-]+)  ");
  }
  [[nodiscard]] static std::vector<std::string> found_in(const std::string& text,
                                                         const std::string& pattern) {
    std::vector<std::string> words;
    const std::regex regex(pattern);
    for (std::sregex_iterator hit(text.begin(), text.end(), regex), end; hit != end; ++hit)
      words.push_back((*hit)[1]);
    return words;
  }
  [[nodiscard]] std::vector<std::string> options(const std::string& command) const {
    std::vector<std::string> names = found_in(help(command), "\n  (?:-h,)?(--[a-z-]+)");
    for (std::string& second : found_in(help(command), "\n  --[a-z-]+,(--[a-z-]+)"))
      names.push_back(std::move(second));
    return names;
  }
};

}  // namespace hapticwall::command::test
