#include "app/ui/panel/energy_lamp_view.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "app/ui/panel/identify_state.h"
#include "app/ui/panel/tour_strip.h"
#include "app/ui/panel/verdict_view.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/timing_state.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr float kRadiusEms = 0.36F;
constexpr float kGlowEms = 0.62F;
constexpr float kGlowAlpha = 0.22F;
constexpr float kTextAtEms = 1.25F;  // start of the text, behind the lamp
constexpr const char* kRemarkMark = " · ";

// At least three digits, and no exponent.
std::string energy_text(double energy_j) {
  if (std::abs(energy_j) >= 1.0) return fmt::format("{:.2f} J", energy_j);
  return fmt::format("{:.1f} mJ", energy_j * kMillijoulesPerJoule);
}

const char* blame_text(EnergyBlame blame) {
  if (blame == EnergyBlame::kBoth) return "the hold and the control law";
  if (blame == EnergyBlame::kHold) return "the hold";
  return blame == EnergyBlame::kControlLaw ? "the control law" : "nobody";
}

// One observer misses energy that the other one sees, as in the paper.
std::string remark_of(const EnergyStory& story) {
  if (story.blame == EnergyBlame::kHold && story.control_law_j <= 0.0)
    return "the observer (Eq. 6) sees nothing";
  if (story.blame == EnergyBlame::kControlLaw && story.hold_beyond_budget_j <= 0.0)
    return "the hold keeps its bound (Eq. 22)";
  return fmt::format("the hold {}, the control law {}", energy_text(story.hold_beyond_budget_j),
                     energy_text(story.control_law_j));
}

LampWords active_words(const EnergyStory& story) {
  const std::string took = energy_text(story.extracted_j);
  const std::string blame = blame_text(story.blame);
  return {fmt::format("the hand has extracted {}, {} to blame", took, blame), remark_of(story),
          fmt::format("extracted {}, {}", took, blame), "extracted " + took};
}

LampWords spending_words(const EnergyStory& story) {
  // The two values have the unit of the budget, for comparison.
  const bool whole = story.budget_j >= 1.0;
  const double scale = whole ? 1.0 : kMillijoulesPerJoule;
  const std::string share = fmt::format("{:.{}f} of {}", story.given_out_j * scale, whole ? 2 : 1,
                                        energy_text(story.budget_j));
  const std::string decides =
      story.given_out_j > story.budget_j
          ? fmt::format("within one encoder count, {}", energy_text(story.tolerance_j))
          : std::string();
  return {"spending the budget: " + share, decides, "spending " + share, "spending"};
}

// Width with all digits 0, so that the layout does not depend on the digits.
float steady_width(std::string text) {
  for (char& c : text) {
    if (std::isdigit(static_cast<unsigned char>(c)) != 0) c = '0';
  }
  return ImGui::CalcTextSize(text.c_str()).x;
}

void draw_light(const PanelContext& context, draw::Tone tone, bool glows) {
  const float em = ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 centre(corner.x + kGlowEms * em, corner.y + 0.5F * ImGui::GetFrameHeight());
  ImDrawList* list = ImGui::GetWindowDrawList();
  if (glows) list->AddCircleFilled(centre, kGlowEms * em, context.theme.packed(tone, kGlowAlpha));
  list->AddCircleFilled(centre, kRadiusEms * em, context.theme.packed(tone));
  ImGui::SetCursorScreenPos(ImVec2(corner.x + (kTextAtEms + kGlowEms - kRadiusEms) * em, corner.y));
}

void draw_words(const PanelContext& context, const LampWords& words, float room) {
  const std::string* chosen = &words.shortest;
  if (steady_width(words.shorter) <= room) chosen = &words.shorter;
  if (steady_width(words.text) <= room) chosen = &words.text;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(chosen->c_str());
  const std::string remark = kRemarkMark + words.remark;
  if (words.remark.empty() || chosen != &words.text || steady_width(words.text + remark) > room)
    return;
  ImGui::SameLine(0.0F, 0.0F);
  ImGui::TextColored(context.theme.colour(draw::Tone::kMuted), "%s", remark.c_str());
}

void draw_story(const PanelContext& context, const EnergyLamp& lamp) {
  const LampWords words = lamp_words(lamp.story());
  const draw::Tone tone = lamp_tone(lamp.story(), context.tails.front());
  ImGui::BeginGroup();
  draw_light(context, tone, tone != draw::Tone::kMuted);
  draw_words(context, words, ImGui::GetContentRegionAvail().x);
  ImGui::EndGroup();
  point_at(context, TourPlace::kLamp);
  if (!ImGui::IsItemHovered()) return;
  const Scene& scene = context.session.scene();
  const double since_s = static_cast<double>(lamp.since_tick()) / scene.sampling.rate_hz;
  explain((scene.two_axes() ? "Only axis x: axis y has its own loop.\n" : "") +
          lamp_tooltip(lamp.story(), since_s));
}

// The lamp without words: nothing to tell.
void draw_dark_light(const PanelContext& context, const char* words) {
  ImGui::BeginGroup();
  draw_light(context, draw::Tone::kFaint, false);
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", words);
  ImGui::EndGroup();
}

}  // namespace

LampWords lamp_words(const EnergyStory& story) {
  switch (story.state) {
    case EnergyState::kActive:
      return active_words(story);
    case EnergyState::kSpendingBudget:
      return spending_words(story);
    case EnergyState::kPassive:
      break;
  }
  return {"passive", {}, "passive", "passive"};
}

draw::Tone lamp_tone(const EnergyStory& story, const draw::Tail& tail) {
  const bool wrong = tail.summary.verdict != Verdict::kNoContact && !is_good(tail.summary.verdict);
  return story.state == EnergyState::kActive && wrong ? draw::tail_tone(tail) : draw::Tone::kMuted;
}

std::string plain_sentence(const EnergyStory& story) {
  const char* source = "The hold has";
  if (story.blame == EnergyBlame::kControlLaw) source = "The control law has";
  if (story.blame == EnergyBlame::kBoth) source = "The hold and the control law have";
  const double took_j = story.extracted_j;
  const std::string took = took_j >= 0.1 ? fmt::format("{:.2f} J", took_j) : energy_text(took_j);
  return fmt::format("{} fed the hand {}.", source, took);
}

std::string lamp_tooltip(const EnergyStory& story, double since_s) {
  const LampWords words = lamp_words(story);
  std::string text = words.text + (words.remark.empty() ? "" : "\n" + words.remark);
  text += fmt::format(
      "\n\nEnergies of the contact that begins at {:.3f} s, as a controller can know it: measured "
      "displacements, its own forces, the damping that its algorithm assumes.\n"
      "\ngiven out, -E_scv: {}\nbudget, T Σ b v²: {}\n"
      "beyond the hold's budget: {}\nby the control law, -E_cv: {}\n",
      since_s, energy_text(story.given_out_j), energy_text(story.budget_j),
      energy_text(story.hold_beyond_budget_j), energy_text(story.control_law_j));
  return text +
         "\nE_scv = E_cv + E_hold (Eq. 10) is the energy between handle and actuator. The device's "
         "damping has dissipated T Σ b v² (Eq. 16, 22).\n"
         "passive: E_scv ≥ 0\n"
         "spending the budget: -T Σ b v² ≤ E_scv < 0\n"
         "active: E_scv < -T Σ b v². The hand has extracted the rest. It comes from two sources: "
         "the "
         "hold, as far as it exceeded the budget, and the control law, as far as E_cv (Eq. 6, the "
         "passivity observer) fell below zero. A surplus of one source reduces the deficit of the "
         "other.";
}

void draw_energy_lamp(const PanelContext& context) {
  const auto& lamp = context.compare.transient.lamp;
  const std::string silence = silence_text(context.timing.answer);
  const Verdict verdict = context.tails.front().summary.verdict;
  if (!silence.empty()) {
    draw_light(context, draw::Tone::kBad, true);
    draw_words(context, {silence, {}, silence, silence}, ImGui::GetContentRegionAvail().x);
  } else if (context.shows.hides_force) {
    draw_dark_light(context, "energy: hidden");
  } else if (context.identify.experiment || verdict == Verdict::kNoContact) {
    draw_dark_light(context, "");
  } else if (lamp) {
    draw_story(context, *lamp);
  }
}

}  // namespace hapticwall::ui
