// The manual page, judged by man itself.
#include "app/command/pages.h"

#include <regex>

#include "app/file/scene/scene_file.h"
#include "tests/app/command/help.h"

namespace hapticwall::command::test {
namespace {

class PagesTest : public HelpTest {
 protected:
  [[nodiscard]] static std::string escaped(const std::string& text) {
    const std::string minus = std::regex_replace(text, std::regex("-"), "\\-");
    return std::regex_replace(minus, std::regex("'"), "\\(aq");
  }
  std::string shell(const std::string& script) const {
    const Answer answer = wait_for(start({"/bin/bash", "-c", script}));
    EXPECT_EQ(answer.status, 0) << script;
    EXPECT_EQ(answer.err, "") << script;
    return answer.out;
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

}  // namespace
}  // namespace hapticwall::command::test
