// The views and the plots.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "app/ui/page/magnifier.h"
#include "tests/window/rows.h"

namespace hapticwall::test {
namespace {

using draw::PlotId;

void flip_item(Person& person, const std::string& item, const Look& look) {
  SCOPED_TRACE(item);
  flip_twice(person, look, [&] { person.click(item); });
}

constexpr std::array kAllPlots{PlotId::kPosition, PlotId::kForce, PlotId::kStiffness,
                               PlotId::kPassivity};

// ---- views

void turn_and_reset_view(Person& person) {
  const auto orbit = [&]() -> const ui::WallOrbit& { return person.state().wall.persisted.orbit; };
  person.drag("wall view", ImVec2(60.0F, 20.0F), ImGuiMouseButton_Right);
  EXPECT_NE(orbit().yaw_rad, 0.0);
  person.turn_wheel("wall view", 3.0F);
  EXPECT_GT(orbit().zoom, 1.0);
  person.drag("wall view", ImVec2(20.0F, 10.0F), ImGuiMouseButton_Middle);
  person.click("reset view");
  EXPECT_EQ(orbit(), ui::WallOrbit{});
  person.drag("wall view", ImVec2(60.0F, 0.0F), ImGuiMouseButton_Right);
  person.double_click("wall view", ImGuiMouseButton_Right);
  EXPECT_EQ(orbit(), ui::WallOrbit{});
}

void expect_buttons_stand_still(Person& person) {
  const auto place_at = [&](int magnification) {
    person.state().wall.persisted.magnification = magnification;
    person.wait_a_frame();
    return find_item("magnify more")->from.x;
  };
  EXPECT_EQ(place_at(ui::kMagnifications.front()), place_at(ui::kMagnifications.back()));
  person.state().wall.persisted.magnification = 0;
  person.wait_a_frame();
}

void magnify(Person& person) {
  expect_buttons_stand_still(person);
  const auto kept = [&] { return person.state().wall.persisted.magnification; };
  person.click("magnify more");
  EXPECT_GT(kept(), 0);
  person.click("magnify automatically");
  EXPECT_EQ(kept(), 0);
  person.click("magnify more");
  const int more = kept();
  person.click("magnify less");
  EXPECT_LT(kept(), more);
  person.turn_wheel("magnifier", 1.0F);
  EXPECT_EQ(kept(), more);
  person.double_click("magnifier");
  EXPECT_EQ(kept(), 0);
}

Row moves(const char* gap, ImVec2 way) {
  return {gap, [=](Person& person) {
            const ui::DockLayout before = *person.state().dock.chosen;
            const ImVec2 place = find_item(gap)->from;
            person.drag(gap, way);
            EXPECT_NEAR(find_item(gap)->from.x, place.x + way.x, 2.0F);
            EXPECT_NEAR(find_item(gap)->from.y, place.y + way.y, 2.0F);
            EXPECT_NE(*person.state().dock.chosen, before);
            person.state().dock.chosen = before;
            person.state().dock.rebuild = true;
            person.wait_a_frame();
          }};
}

// ---- the row above the plots

void choose_arrangements(Person& person) {
  using enum ui::PlotArrangement;
  const std::array<std::pair<const char*, ui::PlotArrangement>, 4> choices{
      {{"two plots", kTwo},
       {"as Figure 4", kFigure4},
       {"as Figures 5, 6", kFigure5And6},
       {"all plots", kAll}}};
  for (const auto& [name, value] : choices) {
    person.click("arrangement");
    person.click(name);
    EXPECT_EQ(person.state().plots.persisted.arrangement, value);
    EXPECT_EQ(person.sees("plot Passivity"), value == kAll || value == kFigure4);
    EXPECT_EQ(person.sees("plot Stiffness"), value == kAll || value == kFigure5And6);
  }
}

void choose_lengths(Person& person) {
  person.click("follow");
  EXPECT_FALSE(person.state().time.follow);
  person.click("time window");
  auto names = person.items_called("length ");
  EXPECT_EQ(std::erase(names, "length auto"), 1U);
  EXPECT_EQ(names.size(), ui::kTimeWindowsS.size());
  person.put_everything_away();
  flip_twice(
      person, [](Person& p) { return p.state().time.follows_rhythm ? 1.0 : 0.0; },
      [&] {
        person.click("time window");
        person.click("length auto");
      });
  double before_s = 0.0;
  const auto choose = [&](const std::string& name) {
    person.click("time window");
    person.click(name);
    EXPECT_TRUE(person.state().time.follow) << "it follows the newest samples again";
    EXPECT_NE(person.state().time.window_s, before_s) << name;
    before_s = person.state().time.window_s;
  };
  for (const std::string& name : names) choose(name);
  choose("length 6 s");
  EXPECT_EQ(before_s, 6.0);
}

double trigger_mode(Person& person) {
  return static_cast<double>(person.state().plots.persisted.trigger.mode);
}

void open_trigger(Person& person) { person.click("trigger"); }

void slide_pre_trigger(Person& person) {
  open_trigger(person);
  const auto share = [&] { return person.state().plots.persisted.trigger.pre_share; };
  const double before = share();
  person.drag("pre-trigger", ImVec2(30.0F, 0.0F));
  EXPECT_GT(share(), before);
}

Row trigger(draw::TriggerMode mode, const char* name) {
  return sets(fmt::format("trigger {}", name), trigger_mode, static_cast<double>(mode),
              open_trigger);
}

void make_axes_automatic(Person& person) {
  const auto manual = [&] {
    return person.state()
        .plots.transient.axes[static_cast<std::size_t>(PlotId::kForce)]
        .left.manual;
  };
  // The value axis is on the left of the plot.
  person.drag_from("plot Force", ImVec2(-0.04F, 0.5F), ImVec2(0.0F, 20.0F));
  EXPECT_TRUE(manual());
  person.click("automatic axes");
  EXPECT_FALSE(manual());
}

void export_both(Person& person) {
  person.click("export csv");
  person.wait_until([&] { return person.message().text.starts_with("exported"); }, "the CSV");
  person.put_everything_away();
  person.click("export png");
  EXPECT_TRUE(person.message().text.starts_with("exported the figure")) << person.message().text;
}

void show_cursor_table(Person& person) {
  person.click("cursors");
  person.hover("cursor table");
  person.click("cursors");
  EXPECT_FALSE(person.sees("cursor table"));
}

// ---- the plots

draw::LineSet chosen(Person& person, PlotId id) {
  return person.state().plots.persisted.lines[static_cast<std::size_t>(id)];
}

// Those of every algorithm too.
const draw::PlotTable& all_lines() {
  static const draw::PlotTable kTable(signal_names());
  return kTable;
}

void open_signals(Person& person, PlotId id) {
  person.click(std::string("signals ") + draw::plot_description(id).title);
}

void choose_every_signal(Person& person, PlotId id) {
  open_signals(person, id);
  for (const draw::PlotLine& line : all_lines()[id].lines) {
    flip_item(person, std::string("signal ") + line.name, [id](Person& p) {
      const bool counts = p.state().plots.persisted.show_counts;  // of the encoder, on demand
      return static_cast<double>(chosen(p, id)) + (counts ? 0.5 : 0.0);
    });
  }
}

void show_all_signals(Person& person, PlotId id) {
  open_signals(person, id);
  for (const draw::PlotLine& line : all_lines()[id].lines) {
    if ((chosen(person, id) & draw::line_bit(line.quantity)) == 0)
      person.click(std::string("signal ") + line.name);
  }
  person.put_everything_away();
}

void hide_every_line(Person& person, PlotId id) {
  show_all_signals(person, id);
  for (const draw::PlotLine& line : all_lines()[id].lines) {
    flip_item(person, std::string("legend ") + line.name, [&line](Person& p) {
      return static_cast<double>(p.state().plots.persisted.hidden_lines &
                                 draw::line_bit(line.quantity));
    });
  }
  person.state().plots.persisted.lines = draw::usual_lines();
  person.wait_a_frame();
}

void toggle_bounds(Person& person) {
  open_signals(person, PlotId::kStiffness);
  flip_item(person, "bounds",
            [](Person& p) { return p.state().plots.persisted.show_bounds ? 1.0 : 0.0; });
}

void drag_and_zoom_time(Person& person, const std::string& plot) {
  const ui::TimeView& time = person.state().time;
  person.drag(plot, ImVec2(30.0F, 0.0F));
  EXPECT_FALSE(time.follow) << plot;
  const double length_s = time.to_s - time.from_s;
  person.turn_wheel(plot, 1.0F);
  EXPECT_LT(time.to_s - time.from_s, length_s) << plot;
  person.double_click(plot);
  EXPECT_TRUE(time.follow) << plot;
}

Row time_of(PlotId id) {
  const std::string item = std::string("plot ") + draw::plot_description(id).title;
  return {item, [item](Person& person) { drag_and_zoom_time(person, item); }};
}

void use_phase_plane(Person& person) {
  auto& phase = person.state().plots.persisted.phase;
  if (!phase.shown) person.click("phase plane");
  ASSERT_TRUE(phase.shown);
  flip_item(person, "last contact", [&](Person&) { return phase.last_contact ? 1.0 : 0.0; });
  flip_item(person, "true", [&](Person&) { return phase.true_position ? 1.0 : 0.0; });
  person.hover(person.sees("in …") ? "in …" : "out …");
  person.turn_wheel("plot Phase", 1.0F);
  EXPECT_TRUE(person.state().plots.transient.phase.force.manual);
  person.double_click("plot Phase");
  EXPECT_FALSE(person.state().plots.transient.phase.force.manual);
  person.click("phase plane");
  EXPECT_FALSE(phase.shown);
}

void use_spectrum(Person& person) {
  auto& spectrum = person.state().plots.persisted.spectrum;
  if (!spectrum.shown) person.click("spectrum");
  ASSERT_TRUE(spectrum.shown);
  person.click("spectrum signal");
  person.click("spectrum of actuator F_d");
  EXPECT_EQ(spectrum.quantity, draw::Quantity(&Sample::force_n));
  person.click("spectrum");
  EXPECT_FALSE(spectrum.shown);
}

}  // namespace

Table view_rows() {
  return {{"wall view", turn_and_reset_view},
          {"magnify more", magnify},
          moves("gap 0", ImVec2(30.0F, 0.0F)),
          moves("gap 1", ImVec2(0.0F, 30.0F)),
          moves("gap 2", ImVec2(30.0F, 0.0F))};
}

Table plot_control_rows() {
  using enum draw::TriggerMode;
  return {{"arrangement", choose_arrangements},
          flips("follow", [](Person& p) { return p.state().time.follow ? 1.0 : 0.0; }),
          {"time window", choose_lengths},
          {"automatic axes", make_axes_automatic},
          shown("trigger"),
          {"pre-trigger", slide_pre_trigger},
          trigger(kAuto, "auto"),
          trigger(kNormal, "normal"),
          trigger(kSingle, "single"),
          trigger(kOff, "off"),
          flips("cursors",
                [](Person& person) {
                  return person.state().plots.transient.cursors.shown ? 1.0 : 0.0;
                }),
          {"cursor table", show_cursor_table},
          {"export csv", export_both}};
}

Table plot_rows() {
  Table table{{"phase plane", use_phase_plane},
              {"spectrum", use_spectrum},
              {"spectrum signal", use_spectrum},
              {"bounds", toggle_bounds}};
  for (const PlotId id : kAllPlots) {
    table.push_back(time_of(id));
    table.push_back({std::string("signals ") + draw::plot_description(id).title,
                     [id](Person& person) { choose_every_signal(person, id); }});
    table.push_back({std::string("legend ") + draw::plot_description(id).lines.front().name,
                     [id](Person& person) { hide_every_line(person, id); }});
  }
  return table;
}

Table status_rows() {
  Table table;
  for (const char* item : {"Simulator", "missed", "wake-up", "compute", "plot drops", "frame"})
    table.push_back(shown(item));
  return table;
}

}  // namespace hapticwall::test
