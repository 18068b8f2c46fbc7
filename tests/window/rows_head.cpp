// The head of the panel, the toolbar, and what lies over everything.
#include <gtest/gtest.h>

#include <filesystem>

#include "app/ui/state/appearance.h"
#include "app/ui/window/keys.h"
#include "core/stabiliser/stabiliser.h"
#include "tests/window/rows.h"

namespace hapticwall::test {
namespace {

void open_settings(Person& person) { person.click("settings"); }

double look(Person& person) { return static_cast<double>(person.state().persisted.look); }
double scale_percent(Person& person) { return ui::scale_percent_in_force(person.state()); }
double is_recording(Person& person) {
  return person.recording().state == runtime::RecordingState::kRecording ? 1.0 : 0.0;
}

double number_of(draw::Look wanted) { return static_cast<double>(wanted); }

// Something to take back.
void change_algorithm(Person& person) {
  const std::size_t other = person.scene().algorithm.index == 0 ? 1 : 0;
  person.click(std::string(algorithms()[other].name));
}

void undo_and_redo(Person& person) {
  const std::size_t before = person.scene().algorithm.index;
  change_algorithm(person);
  const std::size_t after = person.scene().algorithm.index;
  ASSERT_NE(after, before);
  person.click("undo");
  EXPECT_EQ(person.scene().algorithm.index, before);
  person.click("redo");
  EXPECT_EQ(person.scene().algorithm.index, after);
}

void scale_up_and_down(Person& person) {
  open_settings(person);
  const double before = scale_percent(person);
  person.click("larger");
  EXPECT_GT(scale_percent(person), before);
  person.click("smaller");
  EXPECT_EQ(scale_percent(person), before);
  person.type("scale percent", "110");
  EXPECT_EQ(scale_percent(person), 110.0);
  person.click("automatic scale");
  EXPECT_EQ(person.state().persisted.scale_percent, 0);
}

void choose_folder(Person& person, const std::string& folder) {
  std::filesystem::create_directory(folder);
  open_settings(person);
  const std::string before = person.state().transient.recording_folder;
  person.type("recording folder", folder + "/nowhere");
  EXPECT_EQ(person.message().kind, ui::MessageKind::kProblem);
  EXPECT_EQ(person.state().transient.recording_folder, before);
  person.put_everything_away();
  open_settings(person);
  person.type("recording folder", folder);
  EXPECT_EQ(person.state().persisted.recording_folder, folder);
  EXPECT_EQ(person.state().transient.recording_folder, folder);
}

void reset_layout(Person& person) {
  ui::PersistedState& persisted = person.state().persisted;
  const double view_share = persisted.view_share;
  person.drag("panel splitter", ImVec2(40.0F, 0.0F));
  EXPECT_NE(persisted.panel_ems, ui::PersistedState{}.panel_ems);
  open_settings(person);
  person.click("reset layout");
  EXPECT_EQ(persisted.panel_ems, ui::PersistedState{}.panel_ems);
  EXPECT_EQ(persisted.view_share, ui::PersistedState{}.view_share);
  persisted.view_share = view_share;
}

void pause_and_run(Person& person) {
  for (const bool paused : {true, false}) {
    person.click("pause");
    person.wait_until([&] { return person.session().snapshot().paused == paused; }, "pause");
  }
}

void step_once(Person& person) {
  person.click("pause");
  person.wait_until([&] { return person.session().snapshot().paused; }, "pause");
  const std::uint64_t before = person.session().snapshot().newest.x().tick;
  person.click("step");
  person.wait_until([&] { return person.session().snapshot().newest.x().tick == before + 1; },
                    "one tick");
  person.click("pause");
}

void reset_once(Person& person) {
  const std::uint32_t before = person.session().snapshot().resets;
  person.click("reset");
  person.wait_until([&] { return person.session().snapshot().resets > before; }, "the reset");
}

void record_and_stop(Person& person) {
  person.click("record");
  EXPECT_EQ(is_recording(person), 1.0);
  person.wait_until([&] { return person.recording().rows > 0; }, "rows");
  person.put_everything_away();
  person.click("record");
  EXPECT_EQ(is_recording(person), 0.0);
  EXPECT_TRUE(std::filesystem::exists(person.recording().path));
}

void name_the_recording(Person& person) {
  person.type("recording name", "mine");
  EXPECT_EQ(person.state().transient.recording_name, "mine");
  person.click("record");
  EXPECT_TRUE(person.recording().path.ends_with("/mine.csv")) << person.recording().path;
  person.put_everything_away();
  person.click("record");
  person.put_everything_away();
  person.type("recording name", "");
  EXPECT_EQ(person.state().transient.recording_name, "");
}

void say_something(Person& person) {
  ui::tell(person.state(), ui::MessageKind::kProblem, "first");
  ui::tell(person.state(), ui::MessageKind::kProblem, "second");
  person.wait_a_frame();
}

std::size_t messages(Person& person) { return person.state().transient.toasts.list().size(); }

void use_messages(Person& person) {
  say_something(person);
  person.click("copy message");
  EXPECT_TRUE(person.clipboard() == "first" || person.clipboard() == "second");
  person.click("message");
  EXPECT_EQ(messages(person), 1U);
  person.click(person.items_called("toast ").front());
  EXPECT_EQ(messages(person), 0U);
  say_something(person);
  person.wait_a_frame();
  person.click("put all away");
  EXPECT_EQ(messages(person), 0U);
}

void read_help(Person& person) {
  person.click("help");
  EXPECT_TRUE(person.state().transient.help_shown);
  person.wait_a_frame();
  std::size_t seen = 0;  // a small window shows the first ones only
  for (const ui::KeyBinding& binding : ui::key_bindings()) {
    if (!person.sees(binding.what)) continue;
    person.hover(binding.what);
    ++seen;
  }
  EXPECT_GT(seen, ui::key_bindings().size() / 2);
  person.click("close help");
  EXPECT_FALSE(person.state().transient.help_shown);
}

}  // namespace

Table head_rows(const std::string& folder) {
  return {{"undo", undo_and_redo},
          {"redo", undo_and_redo},
          shown("settings"),
          sets("light", look, number_of(draw::Look::kLight), open_settings),
          sets("dark", look, number_of(draw::Look::kScreen), open_settings),
          {"larger", scale_up_and_down},
          {"recording folder", [folder](Person& person) { choose_folder(person, folder); }},
          {"reset layout", reset_layout}};
}

Table toolbar_rows() {
  return {{"pause", pause_and_run},
          {"step", step_once},
          {"reset", reset_once},
          {"record", record_and_stop},
          {"recording name", name_the_recording}};
}

Table overlay_rows() { return {{"copy message", use_messages}, {"help", read_help}}; }

}  // namespace hapticwall::test
