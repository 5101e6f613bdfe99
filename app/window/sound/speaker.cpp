#include "app/window/sound/speaker.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "app/window/sound/sound_waves.h"
#include "sim/base/check.h"

namespace seldinger::app {
namespace {

constexpr std::size_t kMostAsked = 32;  // while a device is being opened
constexpr double kLittleS = 0.15;       // the same sound again, sooner than this, is one sound
// What OpenAL Soft calls a device that is none.
constexpr std::string_view kNoOutput = "No Output";

using Device = std::unique_ptr<ALCdevice, decltype([](ALCdevice* device) { alcCloseDevice(device); })>;
using Context = std::unique_ptr<ALCcontext, decltype([](ALCcontext* context) {
                                  alcMakeContextCurrent(nullptr);
                                  alcDestroyContext(context);
                                })>;

// An extension's function; null where OpenAL has none.
template <typename Function>
Function extension(ALCdevice* device, const char* name) {
  return reinterpret_cast<Function>(alcGetProcAddress(device, name));
}

ALCdevice* in_memory_device() {
  const auto open = extension<LPALCLOOPBACKOPENDEVICESOFT>(nullptr, "alcLoopbackOpenDeviceSOFT");
  return open != nullptr ? open(nullptr) : nullptr;
}

}  // namespace

// A source for the patient's voice, one for alarms, some for what hands do.
class Speaker::Voices {
 public:
  // Nothing, where there is no device.
  static std::unique_ptr<Voices> open(Output output) {
    Device device(output == Output::memory ? in_memory_device() : alcOpenDevice(nullptr));
    if (!device || alcGetString(device.get(), ALC_DEVICE_SPECIFIER) == kNoOutput) return nullptr;
    constexpr std::array<ALCint, 7> kRendered = {
        ALC_FORMAT_CHANNELS_SOFT, ALC_MONO_SOFT, ALC_FORMAT_TYPE_SOFT, ALC_FLOAT_SOFT, ALC_FREQUENCY, kSoundHz, 0};
    Context context(alcCreateContext(device.get(), output == Output::memory ? kRendered.data() : nullptr));
    if (!context || alcMakeContextCurrent(context.get()) != ALC_TRUE) return nullptr;
    return std::unique_ptr<Voices>(new Voices(std::move(device), std::move(context)));
  }
  ~Voices() {
    alSourceStopv(static_cast<ALsizei>(sources_.size()), sources_.data());
    alDeleteSources(static_cast<ALsizei>(sources_.size()), sources_.data());
    alDeleteBuffers(static_cast<ALsizei>(buffers_.size()), buffers_.data());
  }
  Voices(const Voices&) = delete;
  Voices& operator=(const Voices&) = delete;

  void set_gain(double gain) { alListenerf(AL_GAIN, static_cast<float>(gain)); }

  void play(const Sounding& sounding) {
    const auto place = static_cast<std::size_t>(sounding.sound);
    const SoundInfo& info = info_of(sounding.sound);
    for (const ALuint source : sources_)
      if (state_of(source) == AL_PLAYING && buffer_of(source) == buffers_[place] && played_s(source) < kLittleS)
        return;
    const ALuint source = source_for(info.voice);
    alSourceStop(source);
    alSourcei(source, AL_BUFFER, static_cast<ALint>(buffers_[place]));
    alSourcef(source, AL_GAIN, static_cast<float>(info.level * std::clamp(sounding.loudness, 0.0, 1.0)));
    alSourcePlay(source);
  }

  std::vector<float> render(int samples) {
    std::vector<float> heard(static_cast<std::size_t>(samples));
    render_(device_.get(), heard.data(), samples);
    return heard;
  }

 private:
  Voices(Device device, Context context) : device_(std::move(device)), context_(std::move(context)) {
    render_ = extension<LPALCRENDERSAMPLESSOFT>(device_.get(), "alcRenderSamplesSOFT");
    alGenSources(static_cast<ALsizei>(sources_.size()), sources_.data());
    alGenBuffers(static_cast<ALsizei>(buffers_.size()), buffers_.data());
    for (const SoundInfo& info : sound_infos()) {
      const std::vector<float> wave = wave_of(info.sound);
      std::vector<std::int16_t> samples(wave.size());
      std::transform(wave.begin(), wave.end(), samples.begin(),
                     [](float value) { return static_cast<std::int16_t>(std::lround(32767.0F * value)); });
      alBufferData(buffers_[static_cast<std::size_t>(info.sound)], AL_FORMAT_MONO16, samples.data(),
                   static_cast<ALsizei>(samples.size() * sizeof(std::int16_t)), kSoundHz);
    }
    for (const ALuint source : sources_) {  // in the middle of the listener's head: all round
      alSourcei(source, AL_SOURCE_RELATIVE, AL_TRUE);
      alSourcef(source, AL_ROLLOFF_FACTOR, 0.0F);
    }
  }

  static ALint state_of(ALuint source) {
    ALint state = AL_STOPPED;
    alGetSourcei(source, AL_SOURCE_STATE, &state);
    return state;
  }
  static ALuint buffer_of(ALuint source) {
    ALint buffer = 0;
    alGetSourcei(source, AL_BUFFER, &buffer);
    return static_cast<ALuint>(buffer);
  }
  static double played_s(ALuint source) {
    float played = 0.0F;
    alGetSourcef(source, AL_SEC_OFFSET, &played);
    return played;
  }
  // Of the hands', one that is quiet, or else they take turns.
  ALuint source_for(Voice voice) {
    if (voice == Voice::patient) return sources_[0];
    if (voice == Voice::alarm) return sources_[1];
    for (std::size_t i = 2; i < sources_.size(); ++i)
      if (state_of(sources_[i]) != AL_PLAYING) return sources_[i];
    turn_ = (turn_ + 1) % (sources_.size() - 2);
    return sources_[2 + turn_];
  }

  Device device_;
  Context context_;  // after the device, which it is closed before
  std::array<ALuint, 6> sources_{};
  std::array<ALuint, kSounds> buffers_{};
  LPALCRENDERSAMPLESSOFT render_ = nullptr;
  std::size_t turn_ = 0;
};

Speaker::Speaker(const Settings& settings)
    : muted_(settings.muted), volume_(std::clamp(settings.volume, 0.0, 1.0)) {
  if (settings.output == Output::memory) {
    in_memory_ = Voices::open(Output::memory);
    state_ = in_memory_ ? State::open : State::none;
  } else {
    thread_ = std::thread([this] { run(); });
  }
}

Speaker::~Speaker() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  woken_.notify_all();
  thread_.join();
}

void Speaker::play(std::span<const Sounding> sounds) {
  for (const Sounding& sounding : sounds) played_.push_back(sounding.sound);
  if (sounds.empty() || muted_ || state_ == State::none) return;
  {
    const std::lock_guard lock(mutex_);
    for (const Sounding& sounding : sounds)
      if (asked_.size() < kMostAsked) asked_.push_back(sounding);
    changed_ = true;
  }
  woken_.notify_all();
}

void Speaker::set_muted(bool muted) {
  muted_ = muted;
  if (!muted && state_ == State::none) state_ = State::unasked;  // perhaps there is one by now
  {
    const std::lock_guard lock(mutex_);
    changed_ = true;
  }
  woken_.notify_all();
}

void Speaker::set_volume(double share) {
  volume_ = std::clamp(share, 0.0, 1.0);
  {
    const std::lock_guard lock(mutex_);
    changed_ = true;
  }
  woken_.notify_all();
}

void Speaker::serve(Voices& voices) {
  std::vector<Sounding> sounds;
  {
    const std::lock_guard lock(mutex_);
    sounds.swap(asked_);
  }
  voices.set_gain(muted_ ? 0.0 : volume_.load());
  for (const Sounding& sounding : sounds) voices.play(sounding);
}

void Speaker::run() {
  std::unique_ptr<Voices> voices;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      woken_.wait(lock, [this] { return stopping_ || changed_; });
      if (stopping_) return;
      changed_ = false;
    }
    if (!voices && !muted_ && state_ == State::unasked) {
      voices = Voices::open(Output::device);
      state_ = voices ? State::open : State::none;
    }
    if (voices) serve(*voices);
  }
}

std::vector<float> Speaker::render(int samples) {
  CHECK(in_memory_ != nullptr);
  serve(*in_memory_);
  return in_memory_->render(samples);
}

}  // namespace seldinger::app
