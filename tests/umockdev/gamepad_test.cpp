// The port to gamepads on a mocked machine: what it asks the kernel, call by call.
#include "device/evdev/gamepad.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/input.h>
#include <umockdev.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "device/evdev/event_node.h"
#include "tests/umockdev/nobodys_rights.h"

namespace hapticwall::device::evdev::testing {
namespace {

using hapticwall::test::NobodysRights;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

// Capabilities as the kernel writes them.
constexpr const char* kGamepadKeys = "7cdb000000000000 0 0 0 0";
constexpr const char* kKeyboardKeys = "402000000 3803078f800d001 feffffdfffefffff fffffffffffffffe";
constexpr const char* kRumble = "107030000 0";
constexpr const char* kConstantOnly = "100040000 0";  // gain and a constant force

// What the kernel knows of the effects of one node. umockdev's thread calls, the test reads.
class Kernel {
 public:
  int upload(ff_effect& effect) {
    const std::scoped_lock lock(mutex_);
    uploads_.push_back(effect);
    if (effect.id < 0) effect.id = 5;
    return error_;
  }
  int write(const input_event& event) {
    const std::scoped_lock lock(mutex_);
    writes_.push_back(std::to_string(event.type) + "/" + std::to_string(event.code) + "=" +
                      std::to_string(event.value));
    return error_;
  }
  // As asked for.
  std::vector<ff_effect> uploads() {
    const std::scoped_lock lock(mutex_);
    return uploads_;
  }
  std::vector<std::string> writes() {
    const std::scoped_lock lock(mutex_);
    return writes_;
  }
  // The errno of everything from now on.
  void fail_with(int error) {
    const std::scoped_lock lock(mutex_);
    error_ = error;
  }

 private:
  std::mutex mutex_;
  std::vector<ff_effect> uploads_;
  std::vector<std::string> writes_;
  int error_ = 0;
};

UMockdevIoctlData* memory_of(UMockdevIoctlClient* client, std::size_t size) {
  return umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, size, nullptr);
}

gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer kernel) {
  if (umockdev_ioctl_client_get_request(client) != EVIOCSFF) return FALSE;
  UMockdevIoctlData* memory = memory_of(client, sizeof(ff_effect));
  ff_effect effect{};
  std::memcpy(&effect, memory->data, sizeof effect);
  const int error = static_cast<Kernel*>(kernel)->upload(effect);
  umockdev_ioctl_data_update(memory, 0, reinterpret_cast<guint8*>(&effect), sizeof effect);
  umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
  g_object_unref(memory);
  return TRUE;
}

gboolean on_write(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer kernel) {
  const UMockdevIoctlData* memory = umockdev_ioctl_client_get_arg(client);
  input_event event{};
  std::memcpy(&event, memory->data, sizeof event);
  const int error = static_cast<Kernel*>(kernel)->write(event);
  umockdev_ioctl_client_complete(client, error == 0 ? sizeof event : -1, error);
  return TRUE;
}

class MockedGamepads : public ::testing::Test {
 protected:
  void TearDown() override {
    for (const std::string& node : nodes_)
      umockdev_testbed_detach_ioctl(testbed_, node.c_str(), nullptr);
    for (UMockdevIoctlBase* answers : answers_) g_object_unref(answers);
    g_object_unref(testbed_);
  }

  void plug(int number, const std::string& name, const std::string& keys,
            const std::string& effects) {
    const std::string parent = "/devices/virtual/input/input" + std::to_string(number);
    const std::string event = "event" + std::to_string(number);
    const std::string text =
        "P: " + parent + "\nE: SUBSYSTEM=input\nA: name=" + name +
        "\\n\nA: capabilities/key=" + keys + "\\n\nA: capabilities/ff=" + effects +
        "\\n\n\nP: " + parent + "/" + event + "\nN: input/" + event + "\nE: DEVNAME=/dev/input/" +
        event + "\nE: SUBSYSTEM=input\nL: device=../../input" + std::to_string(number) + "\n";
    GError* error = nullptr;
    ASSERT_TRUE(umockdev_testbed_add_from_string(testbed_, text.c_str(), &error)) << error->message;
    nodes_.push_back("/dev/input/" + event);
    answers_.push_back(umockdev_ioctl_base_new());
    g_signal_connect(answers_.back(), "handle-ioctl", G_CALLBACK(on_ioctl), &kernel_);
    g_signal_connect(answers_.back(), "handle-write", G_CALLBACK(on_write), &kernel_);
    ASSERT_TRUE(
        umockdev_testbed_attach_ioctl(testbed_, nodes_.back().c_str(), answers_.back(), &error))
        << error->message;
  }
  void plug_gamepad(int number, const std::string& name) {
    plug(number, name, kGamepadKeys, kRumble);
  }
  // Everybody may use all else, umockdev's own sockets included.
  void forbid(const std::vector<std::string>& nodes) {
    gchar* folder = umockdev_testbed_get_root_dir(testbed_);
    const std::string root = folder;
    g_free(folder);
    std::filesystem::permissions(root, std::filesystem::perms(0755));
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
      if (!entry.is_symlink()) std::filesystem::permissions(entry, std::filesystem::perms(0777));
    for (const std::string& node : nodes_)
      std::filesystem::permissions(root + node, std::filesystem::perms(0666));
    for (const std::string& node : nodes)
      std::filesystem::permissions(root + node, std::filesystem::perms::none);
  }

  UMockdevTestbed* testbed_ = umockdev_testbed_new();
  Kernel kernel_;
  std::vector<std::string> nodes_;
  std::vector<UMockdevIoctlBase*> answers_;
};

TEST_F(MockedGamepads, NodesAreListedByNumberWithWhatTheyCanDo) {
  plug(10, "Keyboard", kKeyboardKeys, "0");
  plug_gamepad(9, "Pad");
  const std::vector<NodeListing> nodes = list_nodes();
  ASSERT_EQ(nodes.size(), 2U);
  EXPECT_EQ(nodes[0].path(), "/dev/input/event9");
  EXPECT_EQ(nodes[0].name(), "Pad");
  EXPECT_TRUE(nodes[0].has("key", BTN_GAMEPAD));
  EXPECT_TRUE(nodes[0].has("ff", FF_RUMBLE));
  EXPECT_TRUE(nodes[0].has("ff", FF_GAIN));
  EXPECT_FALSE(nodes[0].has("ff", FF_CONSTANT));
  EXPECT_FALSE(nodes[0].has("key", KEY_ENTER));
  EXPECT_TRUE(nodes[1].has("key", KEY_ENTER));
  EXPECT_FALSE(nodes[1].has("key", BTN_GAMEPAD));
  EXPECT_FALSE(nodes[1].has("ff", FF_RUMBLE));
  EXPECT_FALSE(NodeListing("event11").has("key", KEY_ENTER));
}

TEST_F(MockedGamepads, OneEffectIsUsedAgainAndEndsByItself) {
  plug_gamepad(3, "Pad");
  Result<std::unique_ptr<Gamepad>> gamepad = open_first_gamepad();
  ASSERT_TRUE(gamepad) << gamepad.error().message;
  EXPECT_EQ((*gamepad)->name(), "Pad (/dev/input/event3)");
  EXPECT_THAT(kernel_.writes(), ElementsAre("21/96=65535")) << "the gain";
  ASSERT_EQ(kernel_.uploads().size(), 1U);
  EXPECT_EQ(kernel_.uploads()[0].id, -1);
  EXPECT_FALSE((*gamepad)->rumble({65535, 100}));
  EXPECT_FALSE((*gamepad)->rumble({0, 7}));
  EXPECT_FALSE((*gamepad)->rumble({}));
  EXPECT_THAT(kernel_.writes(), ElementsAre("21/96=65535", "21/5=1", "21/5=1", "21/5=0"));
  ASSERT_EQ(kernel_.uploads().size(), 3U);
  for (const ff_effect& effect : kernel_.uploads()) {
    EXPECT_EQ(effect.type, FF_RUMBLE);
    EXPECT_EQ(effect.replay.length, 100);
  }
  EXPECT_EQ(kernel_.uploads()[1].id, 5);
  EXPECT_EQ(kernel_.uploads()[1].u.rumble.strong_magnitude, 65535);
  EXPECT_EQ(kernel_.uploads()[1].u.rumble.weak_magnitude, 100);
  EXPECT_EQ(kernel_.uploads()[2].id, 5);
  EXPECT_EQ(kernel_.uploads()[2].u.rumble.strong_magnitude, 0);
  EXPECT_EQ(kernel_.uploads()[2].u.rumble.weak_magnitude, 7);
}

TEST_F(MockedGamepads, OthersAreLeftAlone) {
  plug(1, "Keyboard", kKeyboardKeys, "0");
  plug(2, "Pad without motors", kGamepadKeys, "0");
  plug(3, "Wheel", kKeyboardKeys, kConstantOnly);
  plug(4, "Mouse with a motor", kKeyboardKeys, kRumble);
  const Result<std::unique_ptr<Gamepad>> gamepad = open_first_gamepad();
  ASSERT_FALSE(gamepad);
  EXPECT_EQ(gamepad.error().message, "no gamepad with rumble motors");
  EXPECT_TRUE(kernel_.uploads().empty());
}

TEST_F(MockedGamepads, TheFirstThatMayBeOpenedIsTaken) {
  plug_gamepad(1, "First");
  plug_gamepad(2, "Second");
  forbid({"/dev/input/event1"});
  const NobodysRights nobody;
  const Result<std::unique_ptr<Gamepad>> gamepad = open_first_gamepad();
  ASSERT_TRUE(gamepad) << gamepad.error().message;
  EXPECT_THAT((*gamepad)->name(), HasSubstr("Second"));
}

TEST_F(MockedGamepads, AMissingPermissionIsOneLine) {
  plug_gamepad(1, "First");
  plug_gamepad(2, "Second");
  forbid({"/dev/input/event1", "/dev/input/event2"});
  const NobodysRights nobody;
  const Result<std::unique_ptr<Gamepad>> gamepad = open_first_gamepad();
  ASSERT_FALSE(gamepad);
  EXPECT_EQ(gamepad.error().kind, ErrorKind::kDevice);
  EXPECT_EQ(gamepad.error().message,
            "First (/dev/input/event1) cannot be opened: a udev rule or the group 'input' must "
            "permit it");
}

TEST_F(MockedGamepads, AnUnpluggedOneIsAnErrorThatNamesIt) {
  plug_gamepad(3, "Pad");
  Result<std::unique_ptr<Gamepad>> gamepad = open_first_gamepad();
  ASSERT_TRUE(gamepad);
  kernel_.fail_with(ENODEV);
  for (const RumbleLevels levels : {RumbleLevels{1, 1}, RumbleLevels{}}) {
    const Failure failure = (*gamepad)->rumble(levels);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->message, "Pad (/dev/input/event3): No such device");
  }
}

// ENOSPC: others have used all effects.
TEST_F(MockedGamepads, OneThatTakesNoEffectIsRefused) {
  plug_gamepad(3, "Pad");
  kernel_.fail_with(ENOSPC);
  const Result<std::unique_ptr<Gamepad>> gamepad = open_first_gamepad();
  ASSERT_FALSE(gamepad);
  EXPECT_THAT(gamepad.error().message, EndsWith(": No space left on device"));
}

}  // namespace
}  // namespace hapticwall::device::evdev::testing
