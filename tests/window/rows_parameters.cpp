// The sections of the panel whose rows come from the tables of scene keys: hand and device.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>
#include <span>
#include <string>

#include "app/file/scene/device_file.h"
#include "app/file/scene/hand_description.h"
#include "app/file/scene/scene_file.h"
#include "app/ui/widget/parameter_rows.h"
#include "core/scene_keys.h"
#include "tests/window/rows.h"

namespace hapticwall::test {
namespace {

using ReadKey = std::function<std::optional<double>(Person&)>;

void type_good_and_bad(Person& person, const std::string& item, const ValueRange& range, bool whole,
                       double scale, const ReadKey& read) {
  const double good = whole ? 3.0 : range.contains(0.0625) ? 0.0625 : 2.0 * range.minimum;
  person.type(item, fmt::format("{}", good * scale));
  EXPECT_EQ(read(person), good) << item;
  EXPECT_FALSE(person.state().edit.refusal);
  person.type(item, fmt::format("{}", 10.0 * range.maximum * scale));
  EXPECT_EQ(read(person), good) << "a value out of range changes nothing";
  ASSERT_TRUE(person.state().edit.refusal) << item;
  EXPECT_EQ(person.state().edit.refusal->key, item);
  person.hover(person.state().edit.refusal->why);
  person.type(item, "nonsense");
  EXPECT_EQ(read(person), good);
  EXPECT_TRUE(person.state().edit.refusal);
}

void slide(Person& person, const std::string& item, const ReadKey& read) {
  const double before = read(person).value_or(0.0);
  person.drag(item, ImVec2(25.0F, 0.0F));
  const double more = read(person).value_or(0.0);
  EXPECT_GT(more, before) << item;
  person.drag(item, ImVec2(-25.0F, 0.0F));
  EXPECT_LT(read(person).value_or(more), more) << item;
}

void switch_off_and_on(Person& person, const std::string& item, const ReadKey& read) {
  const auto before = read(person);
  person.click("switch " + item);
  if (person.state().edit.refusal) {  // another part needs this one
    EXPECT_EQ(read(person), before) << item;
    return;
  }
  EXPECT_NE(read(person).has_value(), before.has_value()) << item;
  person.wait_a_frame();  // the wall's bounds may have changed, and the rows below have moved
  person.click("switch " + item);
  EXPECT_EQ(read(person), before) << item;
}

// Restores the scene for the next row.
void restore(Person& person, const Scene& before) {
  EXPECT_FALSE(person.live().change_scene(before));
  person.wait_a_frame();
  person.wait_a_frame();
}

template <typename Owner>
void use_key(Person& person, const std::string& item, const NumberKey<Owner>& key,
             const ReadKey& read) {
  const bool switchable = ui::may_be_absent(key);
  EXPECT_EQ(person.sees("switch " + item), switchable);
  if (switchable) EXPECT_TRUE(person.has_tooltip("switch " + item));
  const bool was_on = read(person).has_value();
  if (!was_on) person.click("switch " + item);
  ASSERT_TRUE(read(person)) << item;
  const Scene usual = person.scene();
  const double scale = key.unit == "m" ? 1e3 : 1.0;  // lengths are shown in mm
  type_good_and_bad(person, item, key.range, key.whole(), scale, read);
  restore(person, usual);
  EXPECT_TRUE(person.has_tooltip(item));
  EXPECT_EQ(person.sees(item + "-slider"), !key.whole());
  if (!key.whole()) slide(person, item + "-slider", read);
  if (switchable) switch_off_and_on(person, item, read);
}

// The scene in which a static friction may be switched on.
Scene with_stribeck_friction(Scene scene) {
  scene.simulator.integrator = Integrator::kRungeKutta4;
  scene.x().device.friction_n.reset();
  scene.x().device.stribeck_speed_m_per_s = 0.01;
  return scene;
}

template <typename Owner, typename Get>
Table parameter_rows(const std::string& section, const std::string& prefix,
                     const std::string& unfolded, std::span<const NumberKey<Owner>> keys, Get get) {
  Table table;
  for (const NumberKey<Owner>& key : keys) {
    const std::string item = prefix + std::string(key.key);
    const ReadKey read = [get, &key](Person& person) { return key.get(get(person.scene())); };
    table.push_back({item, [=, &key](Person& person) {
                       unfold(person, section, unfolded);
                       const Scene before = person.scene();
                       if (item == "device.static_friction_n")
                         restore(person, with_stribeck_friction(before));
                       use_key(person, item, key, read);
                       restore(person, before);
                     }});
  }
  return table;
}

double end_mm(Person& person) { return person.scene().x().hand->path.back().position_m * 1e3; }
double end_time_s(Person& person) { return person.scene().x().hand->path.back().time_s; }

double withdraw_mm_per_s(Person& person) { return person.state().hand.withdraw_mm_per_s; }

// Every preset, and a name in the field; one step of Undo each.
void take_devices(Person& person) {
  unfold(person, "Device", "device numbers");
  const Scene before = person.scene();
  const auto expect_taken = [&](const std::string& name) {
    EXPECT_EQ(person.scene().x().device, file::with_device(before, name)->x().device) << name;
    EXPECT_NE(person.scene().x().device, before.x().device) << name;
    person.click("undo");
    EXPECT_EQ(person.scene(), before);
  };
  for (const file::BuiltinDevice& builtin : file::builtin_devices()) {
    person.click("device numbers");
    const std::string item = "take device " + builtin.name;
    EXPECT_EQ(person.sees(item), file::load_device(builtin.name)->vendor_id == 0) << item;
    if (!person.sees(item)) {
      person.put_everything_away();
      continue;
    }
    EXPECT_TRUE(person.has_tooltip(item));
    person.click(item);
    expect_taken(builtin.name);
  }
  person.click("device numbers");
  person.type("device file", "woodenhaptics");
  expect_taken("woodenhaptics");
  person.click("device numbers");
  person.type("device file", "nowhere");
  EXPECT_EQ(person.message().text,
            "nowhere: device: nowhere.toml: cannot be read: No such file or directory");
  EXPECT_EQ(person.scene(), before);
}

void unfold_hand(Person& person) { unfold(person, "Hand", "withdraw hand"); }

// Every named hand, one step of Undo each; the path stays.
void take_hands(Person& person) {
  unfold(person, "Hand", "hand numbers");
  const Scene before = person.scene();
  for (const file::BuiltinHand& builtin : file::builtin_hands()) {
    person.click("hand numbers");
    const std::string item = "take hand " + builtin.name;
    EXPECT_TRUE(person.has_tooltip(item));
    person.click(item);
    const HandSettings numbers = file::load_hand_description(builtin.name)->hand;
    EXPECT_EQ(person.scene(), file::with_hand(before, numbers)) << builtin.name;
    EXPECT_NE(person.scene(), before) << builtin.name;
    person.click("undo");
    EXPECT_EQ(person.scene(), before);
  }
}

}  // namespace

Table hand_rows() {
  Table table{{"section Hand",
               [](Person& person) {
                 person.click("section Hand");
                 EXPECT_TRUE(person.sees("end position"));
               }},
              {"hand numbers", take_hands},
              takes("end position", "70", end_mm, 70.0, unfold_hand),
              takes("approach speed", "20", end_time_s, 2.0, unfold_hand),
              takes("withdraw speed", "40", withdraw_mm_per_s, 40.0, unfold_hand),
              {"withdraw hand", [](Person& person) {
                 unfold_hand(person);
                 person.click("withdraw hand");
                 EXPECT_TRUE(person.state().hand.led);
               }}};
  const auto keys = parameter_rows("Hand", "hand.", "hand.mass_kg", number_keys<HandSettings>(),
                                   [](const Scene& scene) { return *scene.x().hand; });
  table.insert(table.end(), keys.begin(), keys.end());
  return table;
}

Table device_rows() {
  Table table{{"section Device",
               [](Person& person) {
                 person.click("section Device");
                 EXPECT_TRUE(person.sees("device.mass_kg"));
               }},
              {"device numbers", take_devices}};
  auto keys = parameter_rows("Device", "device.", "device.mass_kg", number_keys<DeviceSettings>(),
                             [](const Scene& scene) { return scene.x().device; });
  // The start of the handle has no row: it needs a new session. Nor has what CHAI3D allows: no run
  // changes with it.
  std::erase_if(keys, [](const Row& row) {
    return row.item == "device.start_m" || row.item.starts_with("device.chai3d_");
  });
  table.insert(table.end(), keys.begin(), keys.end());
  return table;
}

Table departure_rows() {
  // The others need a new session.
  auto rows = parameter_rows("Loop", "sampling.", "rate", number_keys<SamplingSettings>(),
                             [](const Scene& scene) { return scene.sampling; });
  std::erase_if(rows, [](const Row& row) {
    return row.item != "sampling.render_every" && row.item != "sampling.lost_ticks";
  });
  return rows;
}

Table link_rows() {
  return {shown("FORCE…"),
          shown("age"),
          shown("delay"),
          shown("reports"),
          {"section Believed of it", [](Person& person) {
             person.click("section Believed of it");
             EXPECT_TRUE(person.sees("device.mass_kg"));
             EXPECT_FALSE(person.sees("device.delay_ticks")) << "the device has its own delay";
           }}};
}

}  // namespace hapticwall::test
