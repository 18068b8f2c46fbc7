#include "app/file/scene/toml_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace hapticwall::file {
namespace {

using ::testing::HasSubstr;

TEST(TomlSettings, EveryValueIsInTheJson) {
  const Result<std::string> json = json_of_toml_settings(
      "root = 1\n[a]\nflag = true\nnumber = 0.1\nwhole = 200.0\nlist = [1, 2]\n"
      "day = 2020-01-01\nbig = inf\n[b]\ntext = \"quote \\\" and \\\\ and\\nline\"\n"
      "unit = \"N\u00b7s/m\"\n",
      "x");
  ASSERT_TRUE(json.ok()) << json.error().message;
  const auto read = nlohmann::json::parse(*json);
  EXPECT_EQ(read["a"]["flag"], true);
  EXPECT_EQ(read["a"]["number"], 0.1);
  EXPECT_EQ(read["a"]["whole"], 200.0);
  EXPECT_EQ(read["b"]["text"], "quote \" and \\ and\nline");
  EXPECT_EQ(read["b"]["unit"], "N\u00b7s/m");
}

TEST(TomlSettings, SaysWhereTheFileIsBroken) {
  const Result<std::string> json = json_of_toml_settings("[a]\nx = = 3\n", "settings.toml");
  ASSERT_FALSE(json.ok());
  EXPECT_THAT(json.error().message, HasSubstr("settings.toml:2"));
}

}  // namespace
}  // namespace hapticwall::file
