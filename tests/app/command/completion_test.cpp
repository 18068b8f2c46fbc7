// The completion of bash, zsh and fish, judged by these shells themselves.
#include "app/command/completion.h"

#include <fmt/format.h>

#include <regex>
#include <set>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/command/help.h"

namespace hapticwall::command::test {
namespace {

// Prints the words that the Tab key offers behind LINE, in a terminal of its own.
constexpr const char* kZsh = R"zsh(
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell 'PS1= PS2=; stty -echo; autoload -U compinit; compinit -u -D; source ./page
compadd() {
  if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)* ]]; then builtin compadd "$@"; return; fi
  local -a hits; builtin compadd -A hits "$@"; print -rl -- "offered "$^hits
}
offer() { _main_complete; print -r -- "the end"; exit }
zle -C offer complete-word offer
bindkey "^I" offer
print ready'
zpty -r shell line '*ready'
zpty -w -n shell "$LINE"$'\t'
zpty -r shell line '*the end*'
print -r -- "$line" | tr -d '\r' | sed -n 's/.*offered //p'
)zsh";

constexpr const char* kFish = "source ./page; complete -C \"$LINE\" | cut -f 1";

constexpr const char* kBash = R"bash(
source ./page
eval "COMP_WORDS=(${LINE//=/ = })"
if [[ $LINE == *' ' ]]; then COMP_WORDS+=(''); fi
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
complete -p hapticwall >/dev/null && _hapticwall
printf '%s\n' "${COMPREPLY[@]}")bash";

class CompletionTest : public HelpTest, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    HelpTest::SetUp();
    if (wait_for(start({"/bin/sh", "-c", "command -v " + shell()})).status != 0)
      GTEST_SKIP() << "no " << shell();
    put("page", hapticwall({"--generate", shell()}).out);
    put("script", shell() == "zsh" ? kZsh : shell() == "fish" ? kFish : kBash);
  }
  [[nodiscard]] static std::string shell() { return GetParam(); }

  // Words that the Tab key offers behind `line`. bash completes files by itself.
  [[nodiscard]] std::multiset<std::string> offered(const std::string& line) const {
    const Answer answer =
        wait_for(start({"/usr/bin/env", "HOME=" + path(""), "XDG_CONFIG_HOME=" + path(""),
                        "TERM=dumb", "LINE=" + line, shell(), path("script")}));
    EXPECT_EQ(answer.status, 0) << line;
    EXPECT_EQ(answer.err, "") << line;
    std::multiset<std::string> words;
    // fish shows --algorithm=NAME as one word.
    for (const std::string& word : found_in(answer.out, "(?:^|\n)(?:--algorithm=)?([^\n]+)"))
      words.insert(word);
    return words;
  }
  // Without the files of the folder.
  [[nodiscard]] std::multiset<std::string> offered_names(const std::string& line) const {
    std::multiset<std::string> words = offered(line);
    for (const char* file : {"page", "script", "stdout", "stderr"}) words.erase(file);
    std::erase_if(words, [](const std::string& word) { return word.ends_with('/'); });
    return words;
  }
};

TEST_P(CompletionTest, TabOffersCommandsAndScenesFirst) {
  std::multiset<std::string> expected;
  for (const std::string& command : commands()) expected.insert(command);
  for (const file::BuiltinScene& scene : file::builtin_scenes()) expected.insert(scene.name);
  EXPECT_EQ(offered_names("hapticwall "), expected);
  EXPECT_THAT(offered("hapticwall comp"), ElementsAre("compare"));
  EXPECT_THAT(offered("hapticwall run --quiet tap-"), ElementsAre("tap-slow"));
  EXPECT_THAT(offered_names("hapticwall timing "), IsEmpty());
}

TEST_P(CompletionTest, TabOffersTheOptionsOfTheCommandAndNoOther) {
  std::vector<std::string> all = commands();
  all.emplace_back("press");  // the window's options
  for (const std::string& command : all) {
    const std::vector<std::string> known = options(command == "press" ? "" : command);
    EXPECT_EQ(offered("hapticwall " + command + " --"),
              (std::multiset<std::string>{known.begin(), known.end()}))
        << command;
  }
}

TEST_P(CompletionTest, TabOffersAlgorithmsBehindTheirOptionAndFilesBehindOthers) {
  std::multiset<std::string> expected;
  for (const AlgorithmDescription& algorithm : algorithms()) expected.emplace(algorithm.name);
  EXPECT_EQ(offered_names("hapticwall run press --algorithm "), expected);
  EXPECT_EQ(offered_names("hapticwall run press --algorithm="), expected);
  EXPECT_EQ(offered_names("hapticwall run press --beside "), expected);
  EXPECT_THAT(offered("hapticwall run press --algorithm=half"), ElementsAre("half-sample"));
  EXPECT_THAT(offered_names("hapticwall run press --csv "), IsEmpty());
  if (shell() != "bash") EXPECT_EQ(offered("hapticwall run press --csv ").count("page"), 1U);
}

INSTANTIATE_TEST_SUITE_P(Shells, CompletionTest, ::testing::Values("bash", "zsh", "fish"),
                         [](const auto& shell) { return std::string(shell.param); });

TEST(Completion, QuotesWhatAShellWouldTakeForItsOwn) {
  CLI::App app("A name", "program");
  app.add_flag("--odd")->description("the wall's \\ and $HOME");
  EXPECT_THAT(completion_writer("zsh")(app), HasSubstr("'--odd:the wall'\\''s \\ and $HOME'"));
  EXPECT_THAT(completion_writer("fish")(app), HasSubstr("-d 'the wall\\'s \\\\ and $HOME'"));
  EXPECT_EQ(completion_writer("csh"), nullptr);
}

}  // namespace
}  // namespace hapticwall::command::test
