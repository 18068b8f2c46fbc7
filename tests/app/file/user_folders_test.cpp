#include "app/file/disk/user_folders.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "tests/temporary_folder.h"

namespace hapticwall::file {
namespace {

namespace fs = std::filesystem;

Environment environment(std::map<std::string, std::string> variables) {
  return [variables = std::move(variables)](const std::string& name) {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  };
}

TEST(SettingsPath, FollowsTheXdgFolders) {
  EXPECT_EQ(settings_path(environment({{"XDG_CONFIG_HOME", "/c"}, {"HOME", "/home/a"}})),
            "/c/hapticwall/settings.json");
  EXPECT_EQ(settings_path(environment({{"HOME", "/home/a"}})),
            "/home/a/.config/hapticwall/settings.json");
  // An empty or relative path counts as not set.
  EXPECT_EQ(settings_path(environment({{"XDG_CONFIG_HOME", ""}, {"HOME", "/home/a"}})),
            "/home/a/.config/hapticwall/settings.json");
  EXPECT_EQ(settings_path(environment({{"XDG_CONFIG_HOME", "c"}, {"HOME", "/home/a"}})),
            "/home/a/.config/hapticwall/settings.json");
  EXPECT_EQ(settings_path(environment({})), "");
}

TEST(SettingsPath, AVariableOfItsOwnComesFirst) {
  EXPECT_EQ(settings_path(environment({{"HAPTICWALL_SETTINGS", "off"}, {"HOME", "/home/a"}})), "");
  EXPECT_EQ(settings_path(environment({{"HAPTICWALL_SETTINGS", "/x.json"}, {"HOME", "/home/a"}})),
            "/x.json");
  EXPECT_EQ(settings_path(environment({{"HAPTICWALL_SETTINGS", ""}, {"HOME", "/h"}})),
            "/h/.config/hapticwall/settings.json");
}

TEST(MakeFolderOf, MakesAllOfThemOrSaysWhyNot) {
  const hapticwall::test::TemporaryFolder folder;
  const fs::path& root = folder.path();
  const std::string path = (root / "a" / "b" / "settings.json").string();
  EXPECT_FALSE(make_folder_of(path));
  EXPECT_TRUE(fs::is_directory(root / "a" / "b"));
  EXPECT_FALSE(make_folder_of(path)) << "it is there already";
  EXPECT_FALSE(make_folder_of("here.toml"));
  std::ofstream(root / "file") << "x";
  const Failure failure = make_folder_of((root / "file" / "c" / "x.toml").string());
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, ErrorKind::kFile);
}

}  // namespace
}  // namespace hapticwall::file
