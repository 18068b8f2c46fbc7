// RtAudio 5 throws, RtAudio 6 returns.
#include <RtAudio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "app/sound/live/card.h"

namespace hapticwall::sound {
namespace {

constexpr unsigned kChannels = 2;  // both channels get the same samples
constexpr unsigned kWantedFrames = 128;
constexpr unsigned kBuffers = 2;
constexpr std::array kRatesHz{48000U, 44100U};

#if defined(RTAUDIO_VERSION_MAJOR) && RTAUDIO_VERSION_MAJOR >= 6
std::unique_ptr<RtAudio> audio_of(RtAudio::Api api) {
  return std::make_unique<RtAudio>(api, [](RtAudioErrorType, const std::string&) {});
}
// The error of the call; empty if it succeeded.
template <typename Call>
std::string problem_of(RtAudio& audio, Call call) {
  return call() == RTAUDIO_NO_ERROR ? "" : audio.getErrorText();
}
#else
std::unique_ptr<RtAudio> audio_of(RtAudio::Api api) { return std::make_unique<RtAudio>(api); }
template <typename Call>
std::string problem_of(RtAudio& /*audio*/, Call call) {
  try {
    call();
    return "";
  } catch (const RtAudioError& error) {
    return error.getMessage();
  }
}
#endif

class RtAudioCard final : public Card {
 public:
  RtAudioCard(RtAudio::Api api, FillSound fill) : fill_(std::move(fill)), audio_(audio_of(api)) {
    audio_->showWarnings(false);
  }
  RtAudioCard(const RtAudioCard&) = delete;
  RtAudioCard& operator=(const RtAudioCard&) = delete;
  ~RtAudioCard() override {
    if (audio_->isStreamOpen()) audio_->closeStream();
  }

  [[nodiscard]] std::string open();
  [[nodiscard]] CardFacts facts() const override { return facts_; }

 private:
  auto open_stream(unsigned rate_hz) {
    RtAudio::StreamParameters output;
    output.deviceId = audio_->getDefaultOutputDevice();
    output.nChannels = kChannels;
    RtAudio::StreamOptions options;
    options.flags = RTAUDIO_MINIMIZE_LATENCY | RTAUDIO_ALSA_USE_DEFAULT;
    options.numberOfBuffers = kBuffers;
    options.streamName = "Haptic Wall";
    frames_ = kWantedFrames;
    return audio_->openStream(&output, nullptr, RTAUDIO_FLOAT32, rate_hz, &frames_, call_back, this,
                              &options);
  }

  auto start(unsigned rate_hz) {
    // Some cards report no latency to RtAudio: the buffers then give it.
    const double told = static_cast<double>(audio_->getStreamLatency());
    const double buffers = static_cast<double>(kBuffers * frames_);
    facts_ = {RtAudio::getApiDisplayName(audio_->getCurrentApi()), static_cast<double>(rate_hz),
              frames_, std::max(told, buffers) / static_cast<double>(rate_hz)};
    mono_.resize(frames_);
    return audio_->startStream();
  }

  static int call_back(void* out, void* /*in*/, unsigned frames, double /*time_s*/,
                       RtAudioStreamStatus /*status*/, void* user) {
    static_cast<RtAudioCard*>(user)->fill(static_cast<float*>(out), frames);
    return 0;
  }

  void fill(float* out, std::size_t frames) {
    const std::span mono = std::span(mono_).first(std::min(frames, mono_.size()));
    fill_(mono);
    std::fill_n(out, frames * kChannels, 0.0F);
    for (std::size_t i = 0; i < mono.size(); ++i)
      std::fill_n(out + i * kChannels, kChannels, mono[i]);
  }

  FillSound fill_;
  unsigned frames_ = kWantedFrames;
  std::vector<float> mono_;
  CardFacts facts_;
  std::unique_ptr<RtAudio> audio_;  // last member: its thread ends before the members that it uses
};

// Returns the problem; empty if the card plays.
std::string RtAudioCard::open() {
  if (audio_->getDeviceCount() == 0) return "no sound card";
  std::string problem;
  for (const unsigned rate_hz : kRatesHz) {
    problem = problem_of(*audio_, [&] { return open_stream(rate_hz); });
    if (problem.empty()) return problem_of(*audio_, [&] { return start(rate_hz); });
  }
  return problem;
}

}  // namespace

Result<std::unique_ptr<Card>> open_usual_card(const FillSound& fill) {
  std::vector<RtAudio::Api> built;
  RtAudio::getCompiledApi(built);
  std::string problem = "no sound card";
  for (const RtAudio::Api api : {RtAudio::LINUX_ALSA, RtAudio::UNIX_JACK}) {
    if (std::ranges::find(built, api) == built.end()) continue;
    auto card = std::make_unique<RtAudioCard>(api, fill);
    const std::string of_this = card->open();
    if (of_this.empty()) return std::unique_ptr<Card>(std::move(card));
    if (problem == "no sound card") problem = of_this;
  }
  return Error{ErrorKind::kDevice, std::move(problem)};
}

bool may_have_card() {
  std::error_code error;
  if (std::filesystem::exists("/proc/asound/card0", error)) return true;
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");  // NOLINT(concurrency-mt-unsafe)
  if (runtime == nullptr) return false;
  const std::filesystem::path folder(runtime);
  return std::filesystem::exists(folder / "pipewire-0", error) ||
         std::filesystem::exists(folder / "pulse" / "native", error);
}

}  // namespace hapticwall::sound
