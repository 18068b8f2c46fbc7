#include "app/ui/application.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "app/ui/arming_strip.h"
#include "app/ui/control_panel.h"
#include "app/ui/magnifier.h"
#include "app/ui/plots_panel.h"
#include "app/ui/status_line.h"
#include "app/ui/toolbar.h"
#include "app/ui/wall_view.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::ui {
namespace {

constexpr double kHistoryS = 30.0;  // kept for looking back
constexpr std::size_t kSamplesAtATime = 4096;
constexpr int kMostBatches = 64;        // a frame ends even where the loop were faster than we are
constexpr float kPanelEms = 21.5F;      // width of the control panel
constexpr float kViewShare = 0.40F;     // height of the wall view, of what is there
constexpr float kPictureShare = 0.62F;  // width of the wall's picture, of the view

std::size_t history_capacity(const Scene& scene) {
  return static_cast<std::size_t>(std::ceil(kHistoryS * scene.sampling.rate_hz));
}

// Nobody knows the true place of a real handle.
void draw_where_measured(Sample& sample) {
  sample.truth.position_m = sample.position_m;
  sample.truth.velocity_m_per_s = sample.velocity_m_per_s;
  sample.truth.hand_path_m = sample.position_m;
}

}  // namespace

Result<std::unique_ptr<Application>> Application::create(const Scene& scene,
                                                         const std::string& recording_folder,
                                                         const Theme& theme, Sessions sessions) {
  Result<std::unique_ptr<WallRenderer>> renderer = WallRenderer::create();
  if (!renderer) return renderer.error();
  Result<std::unique_ptr<runtime::Session>> session =
      sessions.start_on_device ? sessions.start_on_device(scene) : sessions.simulate(scene);
  if (!session) return session.error();
  return std::unique_ptr<Application>(new Application(
      std::move(sessions), std::move(*session), std::move(*renderer), theme, recording_folder));
}

Application::Application(Sessions sessions, std::unique_ptr<runtime::Session> session,
                         std::unique_ptr<WallRenderer> renderer, const Theme& theme,
                         const std::string& recording_folder)
    : sessions_(std::move(sessions)),
      session_(std::move(session)),
      renderer_(std::move(renderer)),
      theme_(theme),
      history_(history_capacity(session_->scene())),
      incoming_(kSamplesAtATime) {
  state_.transient.recording_folder = recording_folder;
  state_.transient.loaded_scene = session_->scene();
}

void Application::take_samples() {
  const bool measured = !session_->device_info().is_simulated;
  for (int batch = 0; batch < kMostBatches; ++batch) {
    const std::size_t count = session_->take_samples(incoming_);
    if (measured) {
      for (Sample& sample : std::span(incoming_).first(count)) draw_where_measured(sample);
    }
    history_.push(std::span<const Sample>(incoming_).first(count));
    if (count < incoming_.size()) break;
  }
}

void Application::frame() {
  take_samples();
  runtime::Snapshot snapshot = session_->snapshot();
  if (!session_->device_info().is_simulated) draw_where_measured(snapshot.sample);
  const PanelContext context{*session_, snapshot, theme_, state_};
  state_.transient.items.clear();
  handle_keys(context);
  draw_layout(context);
  // Last: the panels hold references to the session that this replaces.
  start_wanted_scene();
}

void Application::handle_keys(const PanelContext& context) {
  const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(key, false); };
  // Whatever else is being typed: nobody looks for the right field while a handle runs away.
  if (pressed(ImGuiKey_Space)) disarm(context);
  if (ImGui::GetIO().WantTextInput) return;
  constexpr std::size_t kDigitKeys = 9;
  for (std::size_t i = 0; i < std::min(kDigitKeys, algorithms().size()); ++i) {
    const int offset = static_cast<int>(i);
    if (pressed(static_cast<ImGuiKey>(ImGuiKey_1 + offset)) ||
        pressed(static_cast<ImGuiKey>(ImGuiKey_Keypad1 + offset))) {
      choose_algorithm(context, i);
    }
  }
  if (pressed(ImGuiKey_A)) ask_to_arm(context);
  if (pressed(ImGuiKey_P)) toggle_pause(context);
  if (pressed(ImGuiKey_R)) reset_session(context);
  // Held down, the step repeats.
  if (ImGui::IsKeyPressed(ImGuiKey_S) || ImGui::IsKeyPressed(ImGuiKey_RightArrow))
    single_step(context);
}

void Application::draw_layout(const PanelContext& context) {
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->WorkPos);
  ImGui::SetNextWindowSize(viewport->WorkSize);
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoBringToFrontOnFocus |
                                      ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoScrollWithMouse |
                                      ImGuiWindowFlags_NoBackground;  // the window is cleared to it
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(style.ItemSpacing.x, style.ItemSpacing.x));
  ImGui::Begin("Haptic Wall", nullptr, kFlags);
  ImGui::PopStyleVar();
  const float status_height =
      2.0F * (kSmallFontSize * style.FontScaleMain + style.ItemSpacing.y) + style.ItemSpacing.y;
  const float height = std::max(1.0F, ImGui::GetContentRegionAvail().y - status_height);
  draw_left(context, height);
  ImGui::SameLine();
  draw_right(context, height);
  ImGui::PushFont(nullptr, kSmallFontSize);
  draw_message_row(context);
  draw_status_row(context);
  ImGui::PopFont();
  ImGui::End();
}

void Application::draw_left(const PanelContext& context, float height) {
  const ImVec2 size(kPanelEms * ImGui::GetFontSize(), height);
  ImGui::BeginChild("controls", size, ImGuiChildFlags_Borders | ImGuiChildFlags_ResizeX);
  ImGui::PushFont(theme_.fonts.strong, kTitleFontSize);
  ImGui::TextUnformatted("Haptic Wall");
  ImGui::PopFont();
  draw_scene_section(context);
  draw_algorithm_section(context);
  draw_wall_section(context);
  draw_hand_section(context);
  draw_device_section(context);
  draw_loop_section(context);
  ImGui::EndChild();
}

void Application::draw_right(const PanelContext& context, float height) {
  ImGui::BeginChild("right", ImVec2(0.0F, height), ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoBackground);
  draw_arming_strip(context);
  draw_toolbar(context);
  draw_views(context);
  ImGui::BeginChild("plots", ImVec2(0.0F, 0.0F), ImGuiChildFlags_Borders);
  draw_plots_panel(context, history_);
  ImGui::EndChild();
  ImGui::EndChild();
}

void Application::draw_views(const PanelContext& context) {
  const ImVec2 free = ImGui::GetContentRegionAvail();
  ImGui::BeginChild("views", ImVec2(0.0F, std::floor(kViewShare * free.y)), ImGuiChildFlags_ResizeY,
                    ImGuiWindowFlags_NoBackground);
  const ImVec2 inside = ImGui::GetContentRegionAvail();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(1.0F, 1.0F));
  ImGui::BeginChild("wall", ImVec2(std::floor(kPictureShare * inside.x), 0.0F),
                    ImGuiChildFlags_Borders | ImGuiChildFlags_ResizeX,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  const WallCamera camera = wall_view_camera(session_->scene(), ImGui::GetContentRegionAvail());
  draw_wall_view(context, *renderer_);
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("contact", ImVec2(0.0F, 0.0F), ImGuiChildFlags_Borders,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  double view_pixels_per_m = 1.0;
  if (!session_->scene().walls.empty()) {
    constexpr double kProbeM = 1e-3;
    const double face_m = session_->scene().walls.front().position_m;
    const glm::vec2 face = camera.pixel_of({camera.x_of(face_m), 0.0F, 0.0F});
    const glm::vec2 beside = camera.pixel_of({camera.x_of(face_m + kProbeM), 0.0F, 0.0F});
    view_pixels_per_m = static_cast<double>(glm::distance(face, beside)) / kProbeM;
  }
  draw_magnifier(context, history_, view_pixels_per_m);
  ImGui::EndChild();
  ImGui::EndChild();
}

void Application::start_wanted_scene() {
  if (!state_.transient.wanted_scene) return;
  const auto [scene, loaded] = *std::exchange(state_.transient.wanted_scene, std::nullopt);
  if (const auto problem = validate(scene)) {
    tell(state_, *problem);
    return;
  }
  if (!start_anew(scene)) return;
  history_ = SampleHistory(history_capacity(scene));
  if (loaded) {
    state_.transient.loaded_scene = scene;
    state_.transient.switched_off.clear();
  }
  state_.transient.refusal.reset();
  state_.transient.hand_m.reset();
  state_.transient.dragging_hand = false;
  state_.transient.follow = true;
}

// There is one device: the session that has it ends before the next one begins. Where the next one
// cannot, the window goes on with the simulator and says so. False: the session is the old one.
bool Application::start_anew(const Scene& scene) {
  Message& message = state_.transient.message;
  const bool on_device = !session_->device_info().is_simulated;
  if (on_device) {
    const SessionStarter starter = std::exchange(sessions_.start_on_device, nullptr);
    session_.reset();
    Result<std::unique_ptr<runtime::Session>> started = starter(scene);
    if (started) {
      session_ = std::move(*started);
      sessions_.start_on_device = starter;
      return true;
    }
    tell(state_, MessageKind::kProblem,
         started.error().message +
             "; this is the simulator now: start the program again for the device");
  }
  Result<std::unique_ptr<runtime::Session>> started = sessions_.simulate(scene);
  if (!started) {
    if (on_device) throw std::runtime_error(started.error().message);  // nothing is left to show
    tell(state_, MessageKind::kProblem, started.error().message);
    return false;
  }
  session_ = std::move(*started);
  if (!on_device && message.kind == MessageKind::kProblem) message = {};
  return true;
}

}  // namespace hapticwall::ui
