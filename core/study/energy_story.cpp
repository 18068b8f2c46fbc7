#include "core/study/energy_story.h"

namespace hapticwall {
namespace {

// Relative to the sums; smaller values are rounding errors.
constexpr double kRounding = 1e-12;

bool in_contact(const Sample& sample) { return (sample.flags & kFlagInContact) != 0; }

double positive(double value) { return std::max(0.0, value); }

EnergyBlame blame_of(const EnergyStory& story, double least_j) {
  const bool hold = story.hold_beyond_budget_j > least_j;
  const bool law = story.control_law_j > least_j;
  if (hold && law) return EnergyBlame::kBoth;
  // If neither term alone reaches the resolution, the larger one is to blame.
  if (hold || (!law && story.hold_beyond_budget_j >= story.control_law_j)) {
    return EnergyBlame::kHold;
  }
  return EnergyBlame::kControlLaw;
}

// Energy of a spring with this force at this penetration.
double stored_j(const Sample& sample) {
  return in_contact(sample) ? positive(0.5 * sample.force_n * sample.penetration_m) : 0.0;
}

}  // namespace

EnergyStory tell_energy_story(const EnergyLedger& now, const EnergyLedger& since,
                              double resolution_j) {
  const double cv_j = now.cv_j - since.cv_j;
  const double hold_j = now.hold_j - since.hold_j;
  const double scv_j = now.scv_j - since.scv_j;
  const double budget_j = now.budget_j - since.budget_j;
  // Differences inherit the rounding of the sums.
  const double rounding_j = kRounding * (std::abs(now.cv_j) + std::abs(now.hold_j) +
                                         std::abs(now.scv_j) + std::abs(now.budget_j));
  const double least_j = std::max(resolution_j, rounding_j);
  EnergyStory story;
  story.hold_beyond_budget_j = positive(budget_j - hold_j);
  story.control_law_j = positive(-cv_j);
  story.given_out_j = positive(-scv_j);
  story.budget_j = positive(-budget_j);
  story.tolerance_j = least_j;
  if (budget_j - scv_j > least_j) {
    story.state = EnergyState::kActive;
    story.extracted_j = budget_j - scv_j;
    story.blame = blame_of(story, least_j);
  } else if (-scv_j > least_j) {
    story.state = EnergyState::kSpendingBudget;
  }
  return story;
}

bool EnergyLamp::contact_begins(const Sample& sample) const {
  return in_contact(sample) && resting_ticks_ >= rest_ticks_;
}

void EnergyLamp::begin_at(const Sample& sample) {
  since_ = ledger_of(sample);
  since_tick_ = sample.tick;
  peak_force_n_ = 0.0;
}

void EnergyLamp::add(const Sample& sample) {
  if (!has_previous_ || sample.tick <= previous_.tick) {
    begin_at(sample);
    resting_ticks_ = rest_ticks_;  // no stored energy is known
  } else if ((sample.flags & kFlagParametersChanged) != 0) {
    begin_at(previous_);
    const double lent_j = stored_j(previous_);
    since_.cv_j -= lent_j;
    since_.scv_j -= lent_j;
  } else if (contact_begins(sample)) {
    begin_at(previous_);
  }
  const bool rests = !in_contact(sample) && sample.force_n == 0.0;
  resting_ticks_ = rests ? resting_ticks_ + 1 : 0;
  peak_force_n_ = std::max(peak_force_n_, std::abs(sample.force_n));
  story_ = tell_energy_story(ledger_of(sample), since_, peak_force_n_ * encoder_m_);
  previous_ = sample;
  has_previous_ = true;
}

}  // namespace hapticwall
