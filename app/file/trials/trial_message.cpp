#include "app/file/trials/trial_message.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/file/text/text.h"
#include "core/text.h"

namespace hapticwall::file {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kProtocol = 1;  // a change that a peer must know of raises it

std::string text_line(const Json& message) {
  return message.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

// nullopt for an array or an object.
std::optional<std::string> text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "";
  if (value.is_structured()) return std::nullopt;
  return value.dump();
}

Result<TrialMessage> trial_of(const Json& object) {
  if (!object.is_object()) return usage_error("trial: it takes an object");
  TrialFields fields;
  for (const auto& [name, value] : object.items()) {
    std::optional<std::string> text = text_of(value);
    if (!text)
      return usage_error(fmt::format("trial: {}: it takes a text or a number", shown(name)));
    fields[name] = std::move(*text);
  }
  return TrialMessage(std::move(fields));
}

Result<TrialMessage> choice_of(const Json& value) {
  if (value == 1 || value == 2) return TrialMessage(Choice{value == 1});
  return usage_error("choose: it takes 1 or 2");
}

Json exposure_of(const ExposureRow& exposure) {
  return {{"contact_s", exposure.contact_s},
          {"mean_force_n", exposure.mean_force_n},
          {"max_force_n", exposure.max_force_n},
          {"energy_to_hand_j", exposure.energy_to_hand_j},
          {"touches", exposure.touches}};
}

}  // namespace

Result<TrialMessage> parse_trial_message(std::string_view line) {
  constexpr const char* kForms = "it takes {\"trial\": {...}}, {\"end\": true} or {\"choose\": 1}";
  if (line.size() > kMaxMessageBytes)
    return usage_error(fmt::format("a line is longer than {} bytes", kMaxMessageBytes));
  if (!is_utf8(line)) return usage_error("a line is not UTF-8");
  const Json message = Json::parse(line, nullptr, false);
  if (message.is_discarded()) return usage_error("a line is no JSON");
  if (!message.is_object() || message.size() != 1)
    return usage_error(fmt::format("a line has another form; {}", kForms));
  const auto first = message.begin();
  const std::string& name = first.key();
  const Json& value = *first;
  if (name == "trial") return trial_of(value);
  if (name == "choose") return choice_of(value);
  if (name == "end" && value == true) return TrialMessage(EndOfTrials{});
  return usage_error(fmt::format("{} is no message; {}", in_quotes(name), kForms));
}

std::string hello_line(const Answer& identity, std::size_t answers) {
  return text_line({{"hello",
                     {{"protocol", kProtocol},
                      {"program", identity.program},
                      {"participant", identity.participant},
                      {"session", identity.session},
                      {"answers", answers}}}});
}

std::string answer_message(const Answer& answer, const AnswerColumns& columns) {
  Json fields = Json::object();
  for (auto& [name, text] : answer_fields(answer, columns)) fields[name] = std::move(text);
  return text_line({{"answer", std::move(fields)}});
}

std::string next_line(std::uint64_t number) { return text_line({{"next", number}}); }

std::string error_line(std::string_view what) { return text_line({{"error", what}}); }

std::string end_line(std::string_view why) { return text_line({{"end", why}}); }

std::string felt_line(const FeltTrial& felt) {
  Json values = Json::object();
  for (std::size_t i = 0; i < felt.keys.size(); ++i) {
    values["a." + felt.keys[i]] = felt.values.at(2 * i);
    values["b." + felt.keys[i]] = felt.values.at(2 * i + 1);
  }
  return text_line({{"felt",
                     {{"trial", felt.number},
                      {"first", slot_name(felt.first)},
                      {"second", slot_name(other(felt.first))},
                      {"values", std::move(values)},
                      {"exposures", Json::array({exposure_of(felt.exposures[0]),
                                                 exposure_of(felt.exposures[1])})}}}});
}

}  // namespace hapticwall::file
