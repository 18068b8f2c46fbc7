#include "app/ui/page/identify_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/file/disk/atomic_file.h"
#include "app/ui/panel/arming_strip.h"
#include "app/ui/panel/identify_state.h"
#include "app/ui/state/export.h"
#include "app/ui/state/recording_wishes.h"
#include "app/ui/widget/parameter_rows.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

using session::IdentifyStage;

constexpr float kColumnEms = 36.0F;
constexpr float kChoiceEms = 22.0F;
constexpr float kMinFigureEms = 16.0F;
constexpr float kMinFigureHeightEms = 24.0F;

constexpr const char* kMeaning =
    "Moves the handle to and fro, and finds moving mass, viscous damping, Coulomb friction and the "
    "delay of the force, with 95 % intervals; as 'hapticwall identify'. The session begins anew "
    "afterwards.";

std::string why_not(const PanelContext& context) {
  if (context.shows.live == nullptr)
    return "This page moves the handle of a session, and a recording is shown. Go back to the "
           "scene.";
  if (context.shows.live->recording_status().state == session::RecordingState::kRecording)
    return "Stop the recording first: the experiment needs a session of its own.";
  const IdentifyState& identify = context.identify;
  return session::why_not_identified(identify.device, identify.description);
}

// `scale`: shown units per unit of the value.
void draw_number(const PanelContext& context, const ParameterText& text, std::string_view unit,
                 const ValueRange& range, double scale, double shown, double& value) {
  field_label(context, text.label, text.meaning, unit);
  const std::string id = "##" + text.key;
  const std::optional<double> typed = number_field(context, id.c_str(), shown * scale);
  unit_label(unit);
  if (typed && range.contains(*typed / scale)) {
    value = *typed / scale;
  } else if (typed) {
    const ValueRange shown_range{range.minimum * scale, range.maximum * scale};
    refuse(context, id, out_of_range_text(*typed, shown_range, unit));
  }
  draw_refusal(context, id);
}

// Returns the settings, if they are allowed.
Result<identify::ExperimentSettings> settings_of(const PanelContext& context) {
  const Scene& scene = context.session.scene();
  return session::experiment_settings(context.identify.choice,
                                      session::info_on(context.session.device_info(), scene),
                                      scene.sampling.rate_hz);
}

void draw_choice(const PanelContext& context) {
  session::IdentifyChoice& choice = context.identify.choice;
  ImGui::BeginChild("identify choice", ImVec2(ems(kChoiceEms), 0.0F), ImGuiChildFlags_AutoResizeY);
  const auto settings = settings_of(context);
  draw_number(context,
              {"identify limit", "force limit",
               "Largest force of the experiment. At first 20 % of the device's, at most 2 N"},
              "N", session::kIdentifyLimitN, 1.0,
              settings ? settings->force_limit_n : choice.limit_n, choice.limit_n);
  draw_number(
      context,
      {"identify travel", "travel", "Way to either side of the present position of the handle"},
      "mm", session::kIdentifyTravelM, kMillimetresPerMetre, choice.travel_m, choice.travel_m);
  draw_number(context, {"identify seconds", "duration", "Of the strokes; more give finer numbers"},
              "s", session::kIdentifySeconds, 1.0, choice.seconds, choice.seconds);
  ImGui::EndChild();
}

void draw_start(const PanelContext& context) {
  draw_choice(context);
  const auto settings = settings_of(context);
  const std::string why = why_not(context);
  if (button("Start###identify start", kMeaning, {.enabled = settings && why.empty()}))
    context.identify.wanted = true;
  if (!why.empty()) return muted_text(context, why);
  if (!settings)
    return draw::wrapped_text(context.theme.colour(draw::Tone::kBad), settings.error().message);
  const bool moves = !context.session.device_info().is_simulated;
  if (!context.identify.result) muted_text(context, kMeaning);
  muted_text(context, moves ? "Start disarms the device. Then " + session::let_go_text(*settings) +
                                  " once you arm it."
                            : "The simulated device of this scene, without its hand and walls.");
}

std::string progress_text(const session::IdentifyProgress& shown, double duration_s) {
  const std::string travel =
      fmt::format("{:+.1f} to {:+.1f} mm", shown.lowest_m * kMillimetresPerMetre,
                  shown.highest_m * kMillimetresPerMetre);
  switch (shown.stage) {
    case IdentifyStage::kWaits:
      return "waits for the whole force";
    case IdentifyStage::kRest:
      return "rest: the noise of the position";
    case IdentifyStage::kRamps:
      return "ramps: the force grows until the handle moves; " + travel;
    case IdentifyStage::kStrokes:
    case IdentifyStage::kOver:
      break;
  }
  return fmt::format("strokes: {:.1f} of {:.0f} s, {}", shown.strokes_s, duration_s, travel);
}

void draw_running(const PanelContext& context, session::IdentifyExperiment& experiment) {
  if (button("End###identify end", "Ends the experiment with the force off at once (Space)"))
    disarm(context);
  beside(ems(kMinFigureEms));
  const session::IdentifyProgress shown = experiment.progress();
  const double duration_s = experiment.settings().duration_s;
  progress_bar(context, std::min(1.0, shown.strokes_s / duration_s),
               progress_text(shown, duration_s));
  std::string text = "Now " + session::let_go_text(experiment.settings()) + ". ";
  if (shown.stage == IdentifyStage::kWaits) text += "Arm the device (A) when its way is clear. ";
  muted_text(context, text + "Space ends it with the force off, and so does leaving this page.");
}

void save_device(const PanelContext& context, const Identified& result) {
  std::string name = context.identify.name;
  if (name.empty()) name = result.by.device;
  if (name.ends_with(".toml")) name.resize(name.size() - std::string_view(".toml").size());
  const std::string path =
      unused_path(context.recording.folder, plain_file_name(std::move(name)), ".toml");
  tell(context.toasts, file::write_file(path, file::device_to_toml(result.device)),
       table::written_text(path));
}

void draw_save_device(const PanelContext& context, const Identified& result) {
  std::string& name = context.identify.name;
  ImGui::SetNextItemWidth(ems(kMinFigureEms));
  if (const auto typed =
          text_field(context, "##identify name", plain_file_name(result.by.device), name))
    name = *typed;
  explain("Name of the device file");
  ImGui::SameLine();
  if (button("Save###identify save",
             "Writes a device file, which scenes name and 'numbers of' takes, to the folder of "
             "recordings"))
    save_device(context, result);
}

void draw_result(const PanelContext& context, const Identified& result) {
  ImGui::Separator();
  if (result.found.fits) draw_save_device(context, result);
  digits_text(context, table::identify_text(result.by, result.found), draw::Tone::kText);
  if (!result.found.fits)
    draw::wrapped_text(context.theme.colour(draw::Tone::kBad), table::misfit_text(result.by));
}

void draw_left(const PanelContext& context) {
  IdentifyState& identify = context.identify;
  if (identify.experiment) return draw_running(context, *identify.experiment);
  draw_start(context);
  if (identify.fit.running()) muted_text(context, "Computing the numbers ...");
  if (!identify.problem.empty())
    draw::wrapped_text(context.theme.colour(draw::Tone::kBad), identify.problem);
  if (identify.result) draw_result(context, *identify.result);
}

}  // namespace

void draw_identify_page(const PanelContext& context) {
  ImGui::BeginChild("identify numbers", ImVec2(ems(kColumnEms), 0.0F), ImGuiChildFlags_AutoResizeY);
  draw_left(context);
  ImGui::EndChild();
  const IdentifyState& identify = context.identify;
  if (!identify.result) return;
  beside(ems(kMinFigureEms));
  const ImVec2 free = ImGui::GetContentRegionAvail();
  ImGui::BeginGroup();
  draw::draw_panels(context.theme, identify.result->panels,
                    ImVec2(free.x, std::max(free.y, ems(kMinFigureHeightEms))));
  ImGui::EndGroup();
}

void leave_identify_page(IdentifyState& identify) {
  if (identify.experiment) identify.experiment->stop("its page was left");
}

}  // namespace hapticwall::ui
