// A trial of the blind test: two walls to feel, and the choice. Between trials, a break.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "app/ui/page/blind_test_page.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

using compare::Presentation;

constexpr float kBigFontSize = 22.0F;
constexpr float kProgressEms = 0.3F;  // height
constexpr float kChooseEms = 2.4F;    // height of the buttons below
constexpr float kMinFeelEms = 4.0F;   // minimum height of the big buttons
constexpr float kMaxFeelEms = 16.0F;  // max height of the big buttons
constexpr float kMaxPageEms = 62.0F;  // max width of the page
constexpr float kWaitEms = 16.0F;     // width of the button in a break

struct Words {
  Presentation presentation;
  const char* wall;
  const char* key;
  const char* feel;  // the item
  const char* choice;
  const char* choose;  // the item
  const char* choice_tooltip;
};
constexpr std::array kWords{
    Words{Presentation::kFirst, "First wall", "1 or ←", "feel first", "Choose the first",
          "choose first", "The answer is the first wall: on to the next trial (Ctrl+1)"},
    Words{Presentation::kSecond, "Second wall", "2 or →", "feel second", "Choose the second",
          "choose second", "The answer is the second wall: on to the next trial (Ctrl+2)"}};

void draw_centred(ImVec2 middle, ImFont* font, float size, ImU32 colour, const char* text) {
  const FontScope scope(font, size);
  const ImVec2 extent = ImGui::CalcTextSize(text);
  ImGui::GetWindowDrawList()->AddText(
      ImVec2(middle.x - 0.5F * extent.x, middle.y - 0.5F * extent.y), colour, text);
}

// Highlights the presentation in force; marks the others as felt or not.
void draw_feel_button(const PanelContext& context, const BlindTest& test, const Words& words,
                      ImVec2 size) {
  const draw::Theme& theme = context.theme;
  const bool now = test.felt == words.presentation;
  const bool felt = test.trials.felt(words.presentation);
  if (now) ImGui::PushStyleColor(ImGuiCol_Button, theme.packed(draw::Tone::kAccent, 0.30F));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::Button(fmt::format("##{}", words.feel).c_str(), size);
  if (now) ImGui::PopStyleColor();
  explain(fmt::format("Applies this wall, as often as you like (key {})", words.key));
  const ImVec2 middle(corner.x + 0.5F * size.x, corner.y + 0.5F * size.y);
  draw_centred(ImVec2(middle.x, middle.y - ems(0.6F)), theme.fonts.strong, kBigFontSize,
               theme.packed(draw::Tone::kText), words.wall);
  // The text does not follow the loop's echo: equal walls change nothing, which would tell that
  // they are equal.
  const std::string below = std::string(now && context.snapshot.paused ? "paused"
                                        : now                          ? "felt now"
                                        : felt                         ? "felt"
                                                                       : "not felt yet") +
                            "   " + words.key;
  draw_centred(ImVec2(middle.x, middle.y + ems(1.1F)), theme.fonts.text, draw::kSmallFontSize,
               theme.packed(now ? draw::Tone::kAccent : draw::Tone::kMuted), below.c_str());
  if (clicked) feel(context, words.presentation);
}

bool both_felt(const BlindTest& test) {
  return test.trials.felt(Presentation::kFirst) && test.trials.felt(Presentation::kSecond);
}

void draw_choose_button(const PanelContext& context, const BlindTest& test, const Words& words,
                        ImVec2 size) {
  ImGui::BeginDisabled(!both_felt(test));
  const bool clicked =
      ImGui::Button(fmt::format("{}###{}", words.choice, words.choose).c_str(), size);
  ImGui::EndDisabled();
  explain(both_felt(test) ? words.choice_tooltip : "Feel both first");
  if (clicked) choose(context, words.presentation);
}

// Stands beside progress and stop button if it fits, else above them.
void draw_question(const PanelContext& context, const std::string& question, float room) {
  ImGui::PushFont(context.theme.fonts.strong, draw::kTitleFontSize);
  ImGui::AlignTextToFramePadding();
  const bool fits = ImGui::CalcTextSize(question.c_str()).x <= room;
  ImGui::TextWrapped("%s", question.c_str());
  ImGui::PopFont();
  if (fits) ImGui::SameLine();
}

std::string title_of(const BlindTest& test) {
  if (test.begun && test.trials.awaits()) return "The next trial is on its way";
  if (test.begun) return test.trials.spec().question;
  const file::Answer& identity = test.experiment->answers.identity();
  return fmt::format("{}, participant {}, session {}", test.experiment->name, identity.participant,
                     identity.session);
}

const char* kind_text(const compare::BlindTrials& trials) {
  return trials.spec().kind == file::TrialKind::kPractice ? "practice, " : "";
}

std::string progress_of(const BlindTest& test) {
  const compare::BlindTrials& trials = test.trials;
  if (trials.open()) {
    if (waits(test) || trials.awaits()) return fmt::format("{} answered", trials.trial());
    return fmt::format("{}trial {}", kind_text(trials), trials.trial() + 1);
  }
  if (waits(test)) return fmt::format("{} of {} answered", trials.trial(), trials.planned());
  return fmt::format("{}trial {} of {}", kind_text(trials), trials.trial() + 1, trials.planned());
}

void draw_head(const PanelContext& context, const BlindTest& test, float width) {
  const float left = ImGui::GetCursorPosX();
  constexpr const char* kStop = "Stop and show###stop and show";
  const float stop_width = button_width(kStop);
  const std::string progress = progress_of(test);
  const float gap = ImGui::GetFontSize();
  const float progress_at = width - stop_width - gap - ImGui::CalcTextSize(progress.c_str()).x;
  draw_question(context, title_of(test), progress_at - gap);
  ImGui::SetCursorPosX(left + progress_at);
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", progress.c_str());
  ImGui::SameLine(left + width - stop_width);
  if (button(kStop, "Ends the test with the trials that were answered, and shows their order"))
    end_blind_test(context);
}

void draw_progress(const PanelContext& context, const BlindTest& test, float width) {
  const float height = kProgressEms * ImGui::GetFontSize();
  // Nobody knows how many trials come from another program.
  const float share = test.trials.open() ? 0.0F
                                         : static_cast<float>(test.trials.trial()) /
                                               static_cast<float>(test.trials.planned());
  const ImVec2 from = ImGui::GetCursorScreenPos();
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(from, ImVec2(from.x + width, from.y + height),
                      context.theme.packed(draw::Tone::kFaint), 0.5F * height);
  if (share > 0.0F) {
    list->AddRectFilled(from, ImVec2(from.x + share * width, from.y + height),
                        context.theme.packed(draw::Tone::kAccent), 0.5F * height);
  }
  ImGui::Dummy(ImVec2(width, height + ImGui::GetStyle().ItemSpacing.y));
}

// Draws the page at the beginning of a list, and in its breaks.
void draw_wait(const PanelContext& context, const BlindTest& test, float width) {
  ImGui::Dummy(ImVec2(width, ems(kChooseEms)));
  const bool begins = !test.begun && test.answers.empty();
  const char* label = begins ? "Begin###go on" : "Go on###go on";
  const float button_ems = std::min(width, ems(kWaitEms));
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 0.5F * (width - button_ems));
  if (ImGui::Button(label, ImVec2(button_ems, ems(kChooseEms)))) go_on(context);
  explain("On to the next trial");
  ImGui::Dummy(ImVec2(width, ems(kChooseEms)));
}

// Draws the page while the next trial has not come.
void draw_awaiting(const PanelContext& context, const BlindTest& test) {
  if (test.feed_left) {
    ImGui::TextWrapped(
        "The program that gives the trials has ended. Close the window and start both again: the "
        "experiment resumes after the last answer.");
  }
  const std::string& problem = test.experiment->feed->problem();
  if (problem.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, context.theme.packed(draw::Tone::kBad));
  ImGui::TextWrapped("A line of the program that gives the trials is wrong: %s", problem.c_str());
  ImGui::PopStyleColor();
}

void draw_buttons(const PanelContext& context, float width) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float each = 0.5F * (width - style.ItemSpacing.x);
  const float hint = 2.0F * draw::kSmallFontSize * style.FontScaleMain + 2.0F * style.ItemSpacing.y;
  const float free = ImGui::GetContentRegionAvail().y - ems(kChooseEms) - hint;
  const float height = std::clamp(free, ems(kMinFeelEms), ems(kMaxFeelEms));
  // A click may end the trial or the test, so that each button reads the present state.
  const auto test = [&]() -> const BlindTest& { return *context.compare.transient.test; };
  const auto row = [&](auto draw, ImVec2 size) {
    for (const Words& words : kWords) {
      if (&words != kWords.data()) ImGui::SameLine();
      draw(context, test(), words, size);
    }
  };
  row(draw_feel_button, ImVec2(each, height));
  row(draw_choose_button, ImVec2(each, ems(kChooseEms)));
}

}  // namespace

void draw_blind_trial(const PanelContext& context) {
  const float free = ImGui::GetContentRegionAvail().x;
  const float widest = std::min(free, ems(kMaxPageEms));
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 0.5F * (free - widest));
  ImGui::BeginChild("trial", ImVec2(widest, 0.0F), ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoBackground);
  const float width = ImGui::GetContentRegionAvail().x;  // less a scrollbar
  const BlindTest& test = *context.compare.transient.test;
  draw_head(context, test, width);
  draw_progress(context, test, width);
  // The head may just have ended the test; a finished test has no trial.
  const bool waiting = waits(test);
  if (!blind_test_runs(context.compare)) {
    // Nothing: the next frame shows the result.
  } else if (waiting) {
    draw_wait(context, test, width);
  } else if (test.trials.awaits()) {
    draw_awaiting(context, test);
  } else {
    draw_buttons(context, width);
  }
  muted_text(context,
             waiting || test.trials.awaits()
                 ? "Every answer is stored. After an end of the program, the same command resumes."
                 : "Feel each as often as you like, in any order. To begin from "
                   "rest, leave the wall before you switch, or reset (R).");
  ImGui::EndChild();
}

}  // namespace hapticwall::ui
