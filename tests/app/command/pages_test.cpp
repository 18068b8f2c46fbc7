// The pages of an installed program, judged by man and bash themselves.
#include "app/command/pages.h"

#include <fmt/format.h>

#include <regex>
#include <set>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

class PagesTest : public ProgramTest {
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
  [[nodiscard]] static std::string escaped(const std::string& text) {
    const std::string minus = std::regex_replace(text, std::regex("-"), "\\-");
    return std::regex_replace(minus, std::regex("'"), "\\(aq");
  }
  [[nodiscard]] std::vector<std::string> options(const std::string& command) const {
    return found_in(help(command), "\n  (?:-h,)?(--[a-z-]+)");
  }
  std::string shell(const std::string& script) const {
    const Answer answer = wait_for(start({"/bin/bash", "-c", script}));
    EXPECT_EQ(answer.status, 0) << script;
    EXPECT_EQ(answer.err, "") << script;
    return answer.out;
  }
  // Words that the Tab key offers after `words`.
  [[nodiscard]] std::multiset<std::string> offered(const std::string& words) const {
    put("page", hapticwall({"--generate", "bash"}).out);
    const std::string out =
        shell(fmt::format("source page; COMP_WORDS=({}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))\n"
                          "complete -p hapticwall >/dev/null && _hapticwall && printf '%s\\n' "
                          "\"${{COMPREPLY[@]}}\"",
                          words));
    const std::vector<std::string> lines = found_in(out, "([^\n]+)");
    return {lines.begin(), lines.end()};
  }
};

TEST_F(PagesTest, TheManualHasEveryCommandOptionAndScene) {
  const std::string manual = hapticwall({"--generate", "man"}).out;
  std::vector<std::string> all = commands();
  ASSERT_GE(all.size(), 9U);
  all.emplace_back();
  for (const std::string& command : all) {
    const std::string heading =
        command.empty() ? ".SH OPTIONS" : ".SS hapticwall " + escaped(command);
    const std::size_t begin = manual.find("\n" + heading + "\n");
    ASSERT_NE(begin, std::string::npos) << command;
    const std::string part = manual.substr(begin, manual.find("\n.S", begin + 1) - begin);
    for (const std::string& option : options(command))
      EXPECT_THAT(part, HasSubstr(escaped(option))) << command;
  }
  for (const file::BuiltinScene& scene : file::builtin_scenes())
    EXPECT_THAT(manual, HasSubstr(escaped(scene.name) + "\\fR\n" + escaped(scene.description)));
}

TEST_F(PagesTest, TheManualShowsWhatTroffWouldTakeForARequest) {
  CLI::App app("A name\n.br is shown,\n'br too, \\n as well");
  EXPECT_THAT(manual_page(app), HasSubstr("\n\\&.br is shown,\n\\(aqbr too, \\en as well\n"));
}

TEST_F(PagesTest, ManReadsTheManualWithoutAWarning) {
  if (wait_for(start({"/bin/sh", "-c", "command -v man"})).status != 0) GTEST_SKIP() << "no man";
  put("hapticwall.1", hapticwall({"--generate", "man"}).out);
  shell("LC_ALL=C.UTF-8 man --warnings -E UTF-8 -l -Tutf8 -Z ./hapticwall.1 >/dev/null");
  const std::string text =
      shell("LC_ALL=C.UTF-8 MANWIDTH=200 man -l ./hapticwall.1 | sed 's/.\\x08//g'");
  EXPECT_THAT(text, HasSubstr("--expect verdict=settled --expect 'tail_peak_to_peak_m<1e-4'"));
  EXPECT_THAT(text, HasSubstr("EXIT STATUS\n"));
}

TEST_F(PagesTest, TabOffersCommandsAndScenesFirst) {
  std::multiset<std::string> expected;
  for (const std::string& command : commands()) expected.insert(command);
  for (const file::BuiltinScene& scene : file::builtin_scenes()) expected.insert(scene.name);
  EXPECT_EQ(offered("hapticwall ''"), expected);
  EXPECT_THAT(offered("hapticwall comp"), ElementsAre("compare"));
  EXPECT_THAT(offered("hapticwall run --quiet tap-"), ElementsAre("tap-slow"));
  EXPECT_THAT(offered("hapticwall timing ''"), IsEmpty());
}

TEST_F(PagesTest, TabOffersTheOptionsOfTheCommand) {
  for (const std::string& command : commands()) {
    const std::multiset<std::string> answer = offered("hapticwall " + command + " --");
    for (const std::string& option : options(command))
      EXPECT_EQ(answer.count(option), 1U) << command << ' ' << option;
  }
}

TEST_F(PagesTest, TabOffersAlgorithmsBehindTheirOptionAndFilesBehindOthers) {
  std::multiset<std::string> expected;
  for (const AlgorithmDescription& algorithm : algorithms()) expected.emplace(algorithm.name);
  EXPECT_EQ(offered("hapticwall run press --algorithm ''"), expected);
  EXPECT_EQ(offered("hapticwall run press --algorithm ="), expected);
  EXPECT_THAT(offered("hapticwall run press --algorithm = half"), ElementsAre("half-sample"));
  EXPECT_THAT(offered("hapticwall run press --csv ''"), IsEmpty()) << "bash completes a file";
}

}  // namespace
}  // namespace hapticwall::command::test
