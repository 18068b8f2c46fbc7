#include "app/python/law.h"

#include <fmt/format.h>
#include <nanobind/nanobind.h>

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "app/file/plugin/plugin_file.h"
#include "app/file/text/text.h"
#include "app/python/environment.h"
#include "app/python/heard_call.h"
#include "app/python/interruptible.h"
#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/include/hapticwall/plugin.h"
#include "core/algorithm/plugin/plugin_list.h"

namespace hapticwall::python {
namespace {

// A law in the list of algorithms, which points to its texts for ever.
struct Slot {
  Law law;
  std::size_t algorithm = 0;
  std::vector<hw_parameter> parameters;
  hw_plugin plugin{};
};

struct Slots {
  std::array<std::unique_ptr<Slot>, kMaxLaws> all;
  std::size_t count = 0;
};
Slots& slots() {
  static Slots kept;
  return kept;
}

// Functions that the list calls, one set a slot, because a law's function does not know its law.
// Plain pointers, so that a tick reads only one.
struct Functions {
  double (*step)(void*, const hw_input*, double*) = nullptr;
  void (*configure)(void*, const hw_context*) = nullptr;
  void (*reset)(void*) = nullptr;
};
constinit std::array<Functions, kMaxLaws> functions{};

template <std::size_t kSlot>
double step_of(void* state, const hw_input* input, double* signals) {
  return heard([&] { return functions[kSlot].step(state, input, signals); });
}
template <std::size_t kSlot>
void configure_of(void* state, const hw_context* context) {
  heard_if_given(functions[kSlot].configure, state, context);
}
template <std::size_t kSlot>
void reset_of(void* state) {
  heard_if_given(functions[kSlot].reset, state);
}

template <std::size_t... kSlot>
constexpr auto calls_of(std::index_sequence<kSlot...>) {
  return std::array{Functions{step_of<kSlot>, configure_of<kSlot>, reset_of<kSlot>}...};
}
constexpr auto kCalls = calls_of(std::make_index_sequence<kMaxLaws>());

// A step without signals does not look at its third argument.
// NOLINTBEGIN(performance-no-int-to-ptr): a Python integer is an address
Functions functions_of(const Law& law) {
  return {reinterpret_cast<double (*)(void*, const hw_input*, double*)>(law.step),
          reinterpret_cast<void (*)(void*, const hw_context*)>(law.configure),
          reinterpret_cast<void (*)(void*)>(law.reset)};
}
// NOLINTEND(performance-no-int-to-ptr)

std::unique_ptr<Slot> slot_of(const Law& law, const Functions& calls) {
  auto slot = std::make_unique<Slot>();
  slot->law = law;
  slot->parameters = c_parameters(slot->law.parameters);
  slot->plugin = {HAPTICWALL_PLUGIN_ABI,
                  sizeof(hw_plugin),
                  law.state_bytes,
                  static_cast<std::uint32_t>(slot->parameters.size()),
                  0,
                  slot->parameters.data(),
                  nullptr,
                  slot->law.name.c_str(),
                  slot->law.title.c_str(),
                  slot->law.idea.c_str(),
                  slot->law.equation.c_str(),
                  calls.configure,
                  calls.reset,
                  calls.step};
  return slot;
}

[[noreturn]] void refuse(const Law& law, std::string_view problem) {
  raise(usage_error(fmt::format("algorithm {}: {}", file::in_quotes(law.name), problem)));
}

void check_state(const Law& law) {
  if (law.state_bytes > kMaxPluginStateBytes)
    refuse(law, fmt::format("a state of {} bytes; it takes at most {}", law.state_bytes,
                            kMaxPluginStateBytes));
}

std::size_t replace(std::size_t index, const Law& law) {
  Slot& slot = *slots().all.at(index);
  if (slot.law.parameters != law.parameters)
    refuse(law, "it is there already, with other parameters; choose another name");
  check_state(law);
  slot.plugin.state_bytes = law.state_bytes;
  slot.law.takes_lock = law.takes_lock;
  functions.at(index) = functions_of(law);
  return slot.algorithm;
}

}  // namespace

std::vector<hw_parameter> c_parameters(const std::vector<LawParameter>& parameters) {
  std::vector<hw_parameter> all;
  for (const LawParameter& parameter : parameters) {
    all.push_back({parameter.key.c_str(), parameter.unit.c_str(), parameter.minimum,
                   parameter.maximum, parameter.fallback, parameter.meaning.c_str()});
  }
  return all;
}

void refuse_while_running() {
  if (RunningMark::count() > 0)
    throw std::runtime_error("a run is in progress; register functions before or after it");
}

bool operator==(const LawParameter& a, const LawParameter& b) {
  const bool same_fallback =
      a.fallback == b.fallback || (std::isnan(a.fallback) && std::isnan(b.fallback));
  return a.key == b.key && a.unit == b.unit && a.minimum == b.minimum && a.maximum == b.maximum &&
         a.meaning == b.meaning && same_fallback;
}

std::size_t add_law(const Law& law) {
  refuse_while_running();
  Slots& kept = slots();
  if (law.step == 0) refuse(law, "step has the address 0");
  for (std::size_t i = 0; i < kept.count; ++i) {
    if (kept.all.at(i)->law.name == law.name) return replace(i, law);
  }
  if (kept.count == kMaxLaws)
    refuse(law, fmt::format("a process takes at most {} names", kMaxLaws));
  auto slot = slot_of(law, kCalls.at(kept.count));
  const std::string problem = plugin_problem(slot->plugin);
  if (!problem.empty()) refuse(law, problem);
  functions.at(kept.count) = functions_of(law);
  slot->algorithm = add_plugin(slot->plugin);
  return (kept.all.at(kept.count++) = std::move(slot))->algorithm;
}

std::size_t algorithm_index(const std::string& name_or_path) {
  if (file::names_plugin(name_or_path)) {
    refuse_while_running();
    return value_or_raise(file::load_plugin(name_or_path));
  }
  if (const auto index = find_algorithm(name_or_path)) return *index;
  const auto names = file::names_of(algorithms(), &AlgorithmDescription::name);
  raise(usage_error(fmt::format("no algorithm is called {}{}; known: {}",
                                file::in_quotes(name_or_path),
                                file::suggestion(name_or_path, names), file::joined(names))));
}

bool scene_takes_lock(const Scene& scene) {
  return takes_lock(scene.algorithm.index) || environment_takes_lock(scene.environment.index);
}

bool takes_lock(std::size_t algorithm) {
  const Slots& kept = slots();
  for (std::size_t i = 0; i < kept.count; ++i) {
    if (kept.all.at(i)->algorithm == algorithm) return kept.all.at(i)->law.takes_lock;
  }
  return false;
}

bool note_raised() {
  if (calling == Calling::kNothing) return false;
  calling = Calling::kFunctionThatRaised;
  return true;
}

}  // namespace hapticwall::python
