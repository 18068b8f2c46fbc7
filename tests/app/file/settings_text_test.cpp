#include "app/file/scene/settings_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

namespace hapticwall::file {
namespace {

using ::testing::HasSubstr;

TEST(SettingsText, ReadsBackWhatItWrote) {
  const Settings settings{{"a.flag", true},
                          {"a.number", 0.1},
                          {"a.whole", 200.0},
                          {"b.text", std::string("quote \" and \\ and\nline")},
                          {"b.unit", std::string("N·s/m")}};
  const std::string text = settings_text(settings);
  const Result<Settings> back = parse_settings(text, "settings.toml");
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(*back, settings);
}

TEST(SettingsText, AnyTextsAndNumbersReadBack) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> letter(1, 127);
  std::uniform_real_distribution<double> number(-1e12, 1e12);
  for (int round = 0; round < 200; ++round) {
    Settings settings;
    std::string text;
    for (int i = 0; i < round % 40; ++i) text += static_cast<char>(letter(random));
    settings.insert_or_assign("t.text", text);
    settings.insert_or_assign("t.number", number(random));
    const Result<Settings> back = parse_settings(settings_text(settings), "x");
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(*back, settings);
  }
}

TEST(SettingsText, LeavesOutWhatNoTomlFileCanHold) {
  const Settings settings{{"a.bad", std::string("\xff\xfe")},
                          {"a.beyond", std::string("\xf4\x90\x80\x80")},  // U+110000
                          {"a.cut", std::string("caf\xc3")},
                          {"a.good", std::string("caf\xc3\xa9")},
                          {"a.last", std::string("\xf4\x8f\xbf\xbf")},  // U+10FFFF
                          {"a.overlong", std::string("\xe0\x80\x80")},
                          {"a.surrogate", std::string("\xed\xa0\x80")}};
  const Result<Settings> back = parse_settings(settings_text(settings), "x");
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(*back, (Settings{{"a.good", std::string("caf\xc3\xa9")},
                             {"a.last", std::string("\xf4\x8f\xbf\xbf")}}));
}

TEST(SettingsText, LeavesOutWhatIsNoPlainValueOfATable) {
  const Result<Settings> settings = parse_settings(
      "root = 1\n[a]\nlist = [1, 2]\nday = 2020-01-01\nbig = inf\nx = 3\n[a.deep]\ny = 1\n", "x");
  ASSERT_TRUE(settings.ok()) << settings.error().message;
  EXPECT_EQ(*settings, (Settings{{"a.x", 3.0}}));
}

TEST(SettingsText, SaysWhereTheFileIsBroken) {
  const Result<Settings> settings = parse_settings("[a]\nx = = 3\n", "settings.toml");
  ASSERT_FALSE(settings.ok());
  EXPECT_THAT(settings.error().message, HasSubstr("settings.toml:2"));
}

}  // namespace
}  // namespace hapticwall::file
