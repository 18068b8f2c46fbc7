// The views and the plots.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

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

Row moves(const char* gap, ImVec2 way) {
  return {gap, [=](Person& person) {
            const ui::DockLayout before = *person.state().transient.dock.chosen;
            const ImVec2 place = find_item(gap)->from;
            person.drag(gap, way);
            EXPECT_NEAR(find_item(gap)->from.x, place.x + way.x, 2.0F);
            EXPECT_NEAR(find_item(gap)->from.y, place.y + way.y, 2.0F);
            EXPECT_NE(*person.state().transient.dock.chosen, before);
            person.state().transient.dock.chosen = before;
            person.state().transient.dock.rebuild = true;
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
    EXPECT_EQ(person.state().persisted.arrangement, value);
    EXPECT_EQ(person.sees("plot Passivity"), value == kAll || value == kFigure4);
    EXPECT_EQ(person.sees("plot Stiffness"), value == kAll || value == kFigure5And6);
  }
}

void choose_lengths(Person& person) {
  person.click("follow");
  EXPECT_FALSE(person.state().transient.follow);
  person.click("time window");
  const auto names = person.items_called("length ");
  EXPECT_EQ(names.size(), ui::kTimeWindowsS.size());
  person.put_everything_away();
  double before_s = 0.0;
  const auto choose = [&](const std::string& name) {
    person.click("time window");
    person.click(name);
    EXPECT_TRUE(person.state().transient.follow) << "it follows the newest samples again";
    EXPECT_NE(person.state().persisted.time_window_s, before_s) << name;
    before_s = person.state().persisted.time_window_s;
  };
  for (const std::string& name : names) choose(name);
  choose("length 6 s");
  EXPECT_EQ(before_s, 6.0);
}

void open_trigger(Person& person) { person.click("trigger"); }

void slide_pre_trigger(Person& person) {
  open_trigger(person);
  const auto share = [&] { return person.state().plots.persisted.trigger.pre_share; };
  const double before = share();
  person.drag("pre-trigger", ImVec2(30.0F, 0.0F));
  EXPECT_GT(share(), before);
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
    flip_item(person, std::string("signal ") + line.name,
              [id](Person& p) { return static_cast<double>(chosen(p, id)); });
  }
}

void toggle_bounds(Person& person) {
  open_signals(person, PlotId::kStiffness);
  flip_item(person, "bounds",
            [](Person& p) { return p.state().plots.persisted.show_bounds ? 1.0 : 0.0; });
}

}  // namespace

Table view_rows() { return {moves("gap 2", ImVec2(30.0F, 0.0F))}; }

Table plot_control_rows() {
  return {{"arrangement", choose_arrangements},
          {"time window", choose_lengths},
          {"pre-trigger", slide_pre_trigger}};
}

Table plot_rows() {
  Table table{{"bounds", toggle_bounds}};
  for (const PlotId id : kAllPlots)
    table.push_back({std::string("signals ") + draw::plot_description(id).title,
                     [id](Person& person) { choose_every_signal(person, id); }});
  return table;
}

}  // namespace hapticwall::test
