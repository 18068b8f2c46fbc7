// The head of the panel, the toolbar, and the overlays: messages and help.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "app/ui/panel/layout_choice.h"
#include "app/ui/state/appearance.h"
#include "app/ui/state/tour.h"
#include "app/ui/window/keys.h"
#include "tests/window/rows.h"

namespace hapticwall::test {
namespace {

void open_settings(Person& person) { person.click("settings"); }

void show(Person& person, const ui::DockLayout& layout) {
  person.state().dock.chosen = layout;
  person.state().dock.rebuild = true;
  person.put_everything_away();
}

double look(Person& person) { return static_cast<double>(person.state().appearance.look); }
double scale_percent(Person& person) {
  return ui::scale_percent_in_force(person.state().appearance);
}
double number_of(draw::Look wanted) { return static_cast<double>(wanted); }

void scale_up_and_down(Person& person) {
  open_settings(person);
  const double before = scale_percent(person);
  person.click("larger");
  EXPECT_GT(scale_percent(person), before);
  person.click("smaller");
  EXPECT_EQ(scale_percent(person), before);
  person.type("scale percent", "110");
  EXPECT_EQ(scale_percent(person), 110.0);
  person.type("scale percent", "1000");
  ASSERT_TRUE(person.state().edit.refusal);
  EXPECT_EQ(person.state().edit.refusal->why, "1000 is out of range; it takes 50 to 300 %");
  EXPECT_EQ(scale_percent(person), 110.0);
  person.wait_a_frame();
  EXPECT_FLOAT_EQ(ImGui::GetStyle().FontScaleMain, 1.1F);
  person.click("automatic scale");
  EXPECT_EQ(person.state().appearance.scale_percent, 0);
}

void choose_folder(Person& person, const std::string& folder) {
  std::filesystem::create_directory(folder);
  open_settings(person);
  const std::string before = person.state().recording.folder;
  person.type("recording folder", folder + "/nowhere");
  EXPECT_TRUE(person.message().text.starts_with(folder + "/nowhere: there is no such folder"));
  EXPECT_EQ(person.state().recording.folder, before);
  person.put_everything_away();
  open_settings(person);
  person.type("recording folder", folder);
  EXPECT_EQ(person.state().recording.chosen_folder, folder);
  EXPECT_EQ(person.state().recording.folder, folder);
}

void reset_layout(Person& person) {
  const ui::DockState& dock = person.state().dock;
  const ui::DockLayout before = *person.state().dock.chosen;
  open_settings(person);
  person.click("reset layout");
  EXPECT_EQ(dock.docked, "");
  EXPECT_FALSE(person.state().window.more);
  person.put_everything_away();
  person.click("more");
  EXPECT_TRUE(person.state().window.more);
  show(person, before);
}

void choose_layouts(Person& person) {
  const ui::DockState& dock = person.state().dock;
  const ui::DockLayout before = *person.state().dock.chosen;
  for (const ui::BuiltinLayout& each : ui::builtin_layouts()) {
    person.click("layout");
    person.click(std::string("layout of ") + each.name);
    EXPECT_EQ(dock.layout, each.name);
  }
  person.click("layout");
  person.type("layout name", "mine");
  EXPECT_EQ(dock.layout, "mine");
  person.put_everything_away();
  person.click("layout");
  person.click("layout of bench");
  person.click("layout");
  person.click("layout of mine");
  EXPECT_EQ(dock.layout, "mine");
  person.click("layout");
  person.click("forget layout");
  EXPECT_TRUE(dock.own_layouts.empty());
  show(person, before);
}

void open_and_close_windows(Person& person) {
  const ui::DockState& dock = person.state().dock;
  const ui::DockLayout before = *dock.chosen;
  for (const ui::DockWindow& window : dock.windows) {
    const std::string item = std::string("window ") + window.name;
    const std::size_t count = windows_of(*dock.chosen).size();
    if (!person.sees(item)) person.click("layout");
    person.click(item);
    EXPECT_EQ(windows_of(*dock.chosen).size(), count - 1) << item;
    if (!person.sees(item)) person.click("layout");
    person.click(item);
    EXPECT_EQ(windows_of(*dock.chosen).size(), count) << item;
    person.put_everything_away();
    person.hover(std::string("page ") + window.name);  // its tab, beside the plots
  }
  show(person, before);
}

// Opens the controls that have no room in the row of the session.
void open_more(Person& person) {
  if (!person.sees("repeat scene")) person.click("more of session");
  person.wait_a_frame();
}

void use_slow_motion(Person& person) {
  open_more(person);
  for (const std::uint32_t wanted : {5U, 1U}) {
    person.click("slow motion");
    person.click(fmt::format("slow motion {}", wanted));
    person.wait_until([&] { return person.session().snapshot().periods_per_tick == wanted; },
                      "the slow motion");
  }
}

// This machine may have no card: then a message says so, and there is no volume.
void use_sound(Person& person) {
  const ui::SoundChoice& sound = person.state().sound;
  person.click("sound");
  person.wait_until([&] { return !sound.on || !sound.status.card.empty(); }, "the sound card");
  if (!sound.on) return;
  const double before = sound.volume;
  if (!person.sees("volume")) person.click("more of session");
  person.drag("volume", ImVec2(20.0F, 0.0F));
  EXPECT_NE(sound.volume, before);
  person.put_everything_away();
  person.click("sound");
  EXPECT_FALSE(sound.on);
}

// The window as it opens, and back.
void use_less_and_more(Person& person) {
  person.click("less");
  EXPECT_FALSE(person.state().window.more);
  person.wait_until([&] { return person.sees("lead B") || person.sees("lead A"); }, "two walls");
  for (int each = 0; each < 2; ++each) {
    const std::size_t algorithm = person.scene().algorithm.index;
    person.click(person.sees("lead B") ? "lead B" : "lead A");
    person.wait_until([&] { return person.scene().algorithm.index != algorithm; },
                      "the other wall");
    person.wait_a_frame();
  }
  person.click("more");
  EXPECT_TRUE(person.state().window.more);
}

void open_and_close_the_status(Person& person) {
  const bool before = person.state().window.status_shown;
  person.click("status");
  EXPECT_NE(person.state().window.status_shown, before);
  person.click("status");
  EXPECT_EQ(person.state().window.status_shown, before);
}

void take_the_tour(Person& person) {
  const std::size_t& step = person.state().tour.step;
  person.click("help");
  person.click("tour of help");
  EXPECT_EQ(step, 1U);
  person.click("tour next");
  EXPECT_EQ(step, 2U);
  person.click("tour back");
  EXPECT_EQ(step, 1U);
  person.click("close tour");
  EXPECT_EQ(step, 0U);
  person.state().tour.offered = true;
  person.wait_a_frame();
  person.click("begin tour");
  EXPECT_EQ(step, 1U);
  EXPECT_EQ(person.scene().name, ui::kTourScene);
  person.click("close tour");
}

void name_the_recording(Person& person) {
  person.type("recording name", "mine");
  EXPECT_EQ(person.state().recording.name, "mine");
  person.click("record");
  EXPECT_TRUE(person.recording().path.ends_with("/mine.csv")) << person.recording().path;
  person.put_everything_away();
  person.click("record");
  person.put_everything_away();
  person.type("recording name", "");
  EXPECT_EQ(person.state().recording.name, "");
}

void say_something(Person& person) {
  person.state().toasts.tell(ui::MessageKind::kProblem, "first");
  person.state().toasts.tell(ui::MessageKind::kProblem, "second");
  person.wait_a_frame();
}

std::size_t messages(Person& person) { return person.state().toasts.list().size(); }

void use_messages(Person& person) {
  say_something(person);
  person.click("copy message");
  EXPECT_TRUE(person.clipboard() == "first" || person.clipboard() == "second");
  person.click("message");
  EXPECT_EQ(messages(person), 1U);
  person.click(person.items_called("toast ").front());
  EXPECT_EQ(messages(person), 0U);
  say_something(person);
  person.click("put all away");
  EXPECT_EQ(messages(person), 0U);
}

void read_help(Person& person) {
  const bool& shown = person.state().window.help_shown;
  person.click("help");
  EXPECT_TRUE(shown);
  person.wait_a_frame();
  for (const ui::KeyBinding& binding : ui::key_bindings()) {
    EXPECT_TRUE(person.scroll_until([&] { return draws_text("help", binding.what); }))
        << binding.what;
  }
  person.click("close help");
  EXPECT_FALSE(shown);
  person.click("help");
  person.drag_from("scene", ImVec2(0.1F, -0.6F), ImVec2(0.0F, 0.0F));
  EXPECT_FALSE(shown) << "a click beside it closes it";
}

}  // namespace

Table head_rows(const std::string& folder) {
  return {does("undo", undo_once),
          does("redo", redo_once),
          shown("settings"),
          sets("light", look, number_of(draw::Look::kLight), open_settings),
          sets("dark", look, number_of(draw::Look::kScreen), open_settings),
          {"larger", scale_up_and_down},
          {"recording folder", [folder](Person& person) { choose_folder(person, folder); }},
          flips(
              "record signals",
              [](Person& person) { return person.state().recording.chosen_signals ? 1.0 : 0.0; },
              open_settings),
          {"reset layout", reset_layout},
          {"layout", choose_layouts},
          {"window ", open_and_close_windows}};
}

Table toolbar_rows() {
  return {does("pause", pause_and_run),
          does("step", step_once),
          does("reset", reset_once),
          does("record", record_and_stop),
          {"slow motion", use_slow_motion},
          {"sound", use_sound},
          {"less", use_less_and_more},
          {"status", open_and_close_the_status},
          flips(
              "repeat scene",
              [](Person& person) { return person.state().scene.repeats ? 1.0 : 0.0; }, open_more),
          {"recording name", name_the_recording}};
}

Table overlay_rows() {
  return {{"copy message", use_messages}, {"help", read_help}, {"tour of help", take_the_tour}};
}

}  // namespace hapticwall::test
