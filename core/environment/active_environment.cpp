#include "core/environment/active_environment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/algorithm/algorithm.h"

namespace hapticwall {

void ActiveEnvironment::configure(const Environment* environment,
                                  const EnvironmentContext& context) {
  const bool starts = environment != environment_;
  environment_ = environment;
  plugin_->choose(environment == nullptr ? nullptr : environment->plugin);
  if (environment == nullptr) return;
  find_places();
  if (plugin_->acts()) return plugin_->configure(context);
  if (starts) environment->start(block_.data());
  environment->configure(block_.data(), context);
}

void ActiveEnvironment::reset() {
  if (environment_ == nullptr) return;
  if (plugin_->acts()) return plugin_->reset();
  environment_->reset(block_.data());
}

void ActiveEnvironment::advance(double applied_force_n) {
  if (!computes_) return;
  if (plugin_->acts()) return plugin_->advance(motion_, applied_force_n);
  if (environment_->advance != nullptr)
    environment_->advance(block_.data(), motion_, applied_force_n);
}

void ActiveEnvironment::show(Signals& signals) const {
  if (environment_ == nullptr || environment_->show == nullptr) return;
  Signals values = no_signals();
  const std::size_t count = environment_->description.signals.size();
  environment_->show(block_.data(), std::span(values).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    if (places_.at(i) < kMaxSignals && std::isfinite(values.at(i)))
      signals.at(places_.at(i)) = values.at(i);
  }
}

void ActiveEnvironment::find_places() {
  const std::span<const SignalDescription> signals = environment_->description.signals;
  for (std::size_t i = 0; i < signals.size(); ++i)
    places_.at(i) = find_algorithm_signal(signals[i].name).value_or(kMaxSignals);
}

}  // namespace hapticwall
