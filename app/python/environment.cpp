#include "app/python/environment.h"

#include <fmt/format.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <memory>
#include <string_view>
#include <utility>

#include "app/file/plugin/plugin_file.h"
#include "app/file/text/text.h"
#include "app/python/heard_call.h"
#include "app/python/interruptible.h"
#include "core/algorithm/plugin/include/hapticwall/environment.h"
#include "core/algorithm/plugin/plugin_algorithm.h"
#include "core/environment/plugin/plugin_environment.h"

namespace nb = nanobind;

namespace hapticwall::python {
namespace {

// An environment in the list, which points to its texts for ever.
struct Slot {
  OwnEnvironment own;
  std::size_t environment = 0;
  std::vector<hw_parameter> parameters;
  hw_environment plugin{};
};

struct Slots {
  std::array<std::unique_ptr<Slot>, kMaxOwnEnvironments> all;
  std::size_t count = 0;
};
Slots& slots() {
  static Slots kept;
  return kept;
}

// Functions that the list calls, one set a slot, because a function does not know its environment.
struct Functions {
  void (*configure)(void*, const hw_environment_context*) = nullptr;
  void (*reset)(void*) = nullptr;
  double (*force)(const void*, const hw_motion*) = nullptr;
  void (*advance)(void*, const hw_motion*, double) = nullptr;
  double (*depth)(const void*, const hw_motion*) = nullptr;
  double (*stiffness_hint)(const void*, const hw_motion*) = nullptr;
};
constinit std::array<Functions, kMaxOwnEnvironments> functions{};

template <std::size_t kSlot>
constexpr Functions calls_of_slot() {
  return {
      [](void* state, const hw_environment_context* context) {
        heard_if_given(functions[kSlot].configure, state, context);
      },
      [](void* state) { heard_if_given(functions[kSlot].reset, state); },
      [](const void* state, const hw_motion* motion) {
        return heard([&] { return functions[kSlot].force(state, motion); });
      },
      [](void* state, const hw_motion* motion, double force_n) {
        heard_if_given(functions[kSlot].advance, state, motion, force_n);
      },
      [](const void* state, const hw_motion* motion) {
        return heard([&] { return functions[kSlot].depth(state, motion); });
      },
      [](const void* state, const hw_motion* motion) {
        return heard([&] { return functions[kSlot].stiffness_hint(state, motion); });
      },
  };
}
template <std::size_t... kSlot>
constexpr auto calls_of(std::index_sequence<kSlot...>) {
  return std::array{calls_of_slot<kSlot>()...};
}
constexpr auto kCalls = calls_of(std::make_index_sequence<kMaxOwnEnvironments>());

// NOLINTBEGIN(performance-no-int-to-ptr): a Python integer is an address
Functions functions_of(const OwnEnvironment& own) {
  return {reinterpret_cast<void (*)(void*, const hw_environment_context*)>(own.configure),
          reinterpret_cast<void (*)(void*)>(own.reset),
          reinterpret_cast<double (*)(const void*, const hw_motion*)>(own.force),
          reinterpret_cast<void (*)(void*, const hw_motion*, double)>(own.advance),
          reinterpret_cast<double (*)(const void*, const hw_motion*)>(own.depth),
          reinterpret_cast<double (*)(const void*, const hw_motion*)>(own.stiffness_hint)};
}
// NOLINTEND(performance-no-int-to-ptr)

std::unique_ptr<Slot> slot_of(const OwnEnvironment& own, const Functions& calls) {
  auto slot = std::make_unique<Slot>();
  slot->own = own;
  slot->parameters = c_parameters(slot->own.parameters);
  slot->plugin = {HAPTICWALL_ENVIRONMENT_ABI,
                  sizeof(hw_environment),
                  own.state_bytes,
                  static_cast<std::uint32_t>(slot->parameters.size()),
                  slot->parameters.data(),
                  slot->own.name.c_str(),
                  slot->own.title.c_str(),
                  slot->own.idea.c_str(),
                  slot->own.equation.c_str(),
                  calls.configure,
                  calls.reset,
                  calls.force,
                  calls.advance,
                  own.depth == 0 ? nullptr : calls.depth,
                  own.stiffness_hint == 0 ? nullptr : calls.stiffness_hint};
  return slot;
}

[[noreturn]] void refuse(const OwnEnvironment& own, std::string_view problem) {
  raise(usage_error(fmt::format("environment {}: {}", file::in_quotes(own.name), problem)));
}

// The list has told which functions there are.
bool same_kind(const OwnEnvironment& a, const OwnEnvironment& b) {
  return a.parameters == b.parameters && (a.depth == 0) == (b.depth == 0) &&
         (a.stiffness_hint == 0) == (b.stiffness_hint == 0);
}

std::size_t replace(std::size_t index, const OwnEnvironment& own) {
  Slot& slot = *slots().all.at(index);
  if (!same_kind(slot.own, own))
    refuse(own, "it is there already, with other parameters or functions; choose another name");
  if (own.state_bytes > kMaxPluginStateBytes)
    refuse(own, fmt::format("a state of {} bytes; it takes at most {}", own.state_bytes,
                            kMaxPluginStateBytes));
  slot.plugin.state_bytes = own.state_bytes;
  slot.own.takes_lock = own.takes_lock;
  functions.at(index) = functions_of(own);
  return slot.environment;
}

}  // namespace

std::size_t add_environment(const OwnEnvironment& own) {
  refuse_while_running();
  Slots& kept = slots();
  if (own.force == 0) refuse(own, "force has the address 0");
  for (std::size_t i = 0; i < kept.count; ++i) {
    if (kept.all.at(i)->own.name == own.name) return replace(i, own);
  }
  if (kept.count == kMaxOwnEnvironments)
    refuse(own, fmt::format("a process takes at most {} names", kMaxOwnEnvironments));
  auto slot = slot_of(own, kCalls.at(kept.count));
  const std::string problem = environment_problem(slot->plugin);
  if (!problem.empty()) refuse(own, problem);
  functions.at(kept.count) = functions_of(own);
  slot->environment = add_environment_plugin(slot->plugin);
  return (kept.all.at(kept.count++) = std::move(slot))->environment;
}

bool environment_takes_lock(std::size_t environment) {
  const Slots& kept = slots();
  for (std::size_t i = 0; i < kept.count; ++i) {
    if (kept.all.at(i)->environment == environment) return kept.all.at(i)->own.takes_lock;
  }
  return false;
}

void bind_environments(nb::module_& m) {
  m.def("add_environment", [](const std::vector<std::string>& texts, std::uint32_t state_bytes,
                              std::vector<LawParameter> parameters,
                              const std::vector<std::uintptr_t>& addresses, bool takes_lock) {
    return add_environment({{texts.at(0), texts.at(1), texts.at(2), texts.at(3), state_bytes,
                             std::move(parameters), takes_lock},
                            addresses.at(0),
                            addresses.at(1),
                            addresses.at(2),
                            addresses.at(3),
                            addresses.at(4),
                            addresses.at(5)});
  });
  // The name of the environment in a plug-in's file, which is loaded once.
  m.def("load_environment", [](const std::string& path) {
    refuse_while_running();
    return std::string(
        environments()[value_or_raise(file::load_environment(path))].description.name);
  });
  // Path and SHA-256 of an environment's file; empty for one without a file.
  m.def("environment_file", [](const std::string& name) {
    const auto index = find_environment(name);
    const file::PluginFile* const found = index ? file::environment_file(*index) : nullptr;
    return found == nullptr ? std::pair(std::string(), std::string())
                            : std::pair(found->path, found->sha256);
  });
  m.def("environment_names", [] { return file::names_of(environments()); });
  m.def("own_environment", [](const std::string& name) {
    const auto index = find_environment(name);
    return index && environments()[*index].plugin != nullptr;
  });
}

}  // namespace hapticwall::python
