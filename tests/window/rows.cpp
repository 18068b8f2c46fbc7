#include "tests/window/rows.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace hapticwall::test {
namespace {

constexpr float kSlidePixels = 30.0F;

// Areas, headings and texts. 'undo' has a tooltip after a change: undo_once().
const std::set<std::string> kWithoutTooltip{
    "undo",           "light",     "dark",        "section Hand",
    "section Device", "wall view", "penetration", "section Believed of it",
    "FORCE…",         "gap 0",     "gap 1",       "gap 2"};

void expect_tooltip(Person& person, const std::string& item) {
  if (kWithoutTooltip.contains(item) || item.starts_with("plot ")) return;
  EXPECT_TRUE(person.has_tooltip(item)) << item << " has no tooltip";
}

Row row(std::string item, std::function<void(Person&)> first,
        std::function<void(Person&, const std::string&)> use) {
  std::string name = item;
  return {std::move(name),
          [item = std::move(item), first = std::move(first), use = std::move(use)](Person& person) {
            if (first) {
              first(person);
              person.wait_a_frame();
              expect_tooltip(person, item);
            }
            use(person, item);
          }};
}

}  // namespace

Row does(std::string item, std::function<void(Person&, const Act&)> deed) {
  return row(std::move(item), {},
             [deed = std::move(deed)](Person& person, const std::string& name) {
               deed(person, [&] { person.click(name); });
             });
}

Row shown(std::string item, std::function<void(Person&)> first) {
  return row(std::move(item), std::move(first), [](Person& person, const std::string& name) {
    person.hover(name);
    expect_tooltip(person, name);
    const auto found = find_item(name);
    ASSERT_TRUE(found);
    EXPECT_GT(found->to.x, found->from.x);
    EXPECT_GT(found->to.y, found->from.y);
  });
}

Row flips(std::string item, Look look, std::function<void(Person&)> first) {
  return row(std::move(item), std::move(first),
             [look = std::move(look)](Person& person, const std::string& name) {
               flip_twice(person, look, [&] { person.click(name); });
             });
}

Row sets(std::string item, Look look, double wanted, std::function<void(Person&)> first) {
  return row(std::move(item), std::move(first),
             [look = std::move(look), wanted](Person& person, const std::string& name) {
               person.click(name);
               EXPECT_EQ(look(person), wanted);
             });
}

Row takes(std::string item, std::string text, Look look, double wanted,
          std::function<void(Person&)> first) {
  return row(std::move(item), std::move(first),
             [text = std::move(text), look = std::move(look), wanted](Person& person,
                                                                      const std::string& name) {
               EXPECT_NE(look(person), wanted) << "the value must differ before";
               person.type(name, text);
               EXPECT_DOUBLE_EQ(look(person), wanted);
             });
}

Row slides(std::string item, Look look, std::function<void(Person&)> first) {
  return row(std::move(item), std::move(first),
             [look = std::move(look)](Person& person, const std::string& name) {
               const double before = look(person);
               person.drag(name, ImVec2(kSlidePixels, 0.0F));
               const double more = look(person);
               EXPECT_GT(more, before);
               person.drag(name, ImVec2(-kSlidePixels, 0.0F));
               EXPECT_LT(look(person), more);
             });
}

void use_all(Person& person, const char* panel, const Table& table) {
  SCOPED_TRACE(panel);
  for (const Row& row : table) {
    if (person.is_stuck()) return;
    SCOPED_TRACE(row.item);
    person.put_everything_away();
    if (person.sees(row.item)) expect_tooltip(person, row.item);
    row.use(person);
    EXPECT_TRUE(person.log().used.contains(kind_of(row.item))) << "its row does not use it";
    EXPECT_FALSE(person.is_stuck()) << "cannot be used";
  }
}

void unfold(Person& person, const std::string& section, const std::string& something_in_it) {
  if (!person.sees(something_in_it)) person.click("section " + section);
  person.wait_a_frame();
}

}  // namespace hapticwall::test
