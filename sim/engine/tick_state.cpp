#include "sim/engine/tick_state.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <glm/vec4.hpp>

#include "sim/base/hash.h"
#include "sim/engine/step.h"
#include "sim/engine/tick_state_fields.h"

namespace seldinger::engine {
namespace {

// Bytes are those of a little-endian machine, which every machine is that this is built for.
static_assert(std::endian::native == std::endian::little);

constexpr std::array<char, 8> kMark = {'S', 'e', 'l', 'd', 'T', 'i', 'c', 'k'};
constexpr std::uint32_t kFormat = 1;
constexpr std::size_t kHeadBytes = kMark.size() + 2 * sizeof(std::uint32_t), kChecksumBytes = sizeof(std::uint64_t);

template <typename T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

// Takes a value apart down to its numbers, each of which is handed to Leaf::number.
template <typename Leaf>
class Walk {
 public:
  explicit Walk(Leaf& leaf) : leaf_(leaf) {}
  template <typename... Fields>
  void operator()(Fields&... fields) {
    (value(fields), ...);
  }

 private:
  template <typename T>
  void value(T& field) {
    if constexpr (Number<T>)
      leaf_.number(field);
    else
      fields::visit(*this, field);
  }
  template <glm::length_t N, typename T>
  void value(glm::vec<N, T>& v) {
    for (glm::length_t i = 0; i < N; ++i) value(v[i]);
  }
  template <glm::length_t N, typename T>
  void value(const glm::vec<N, T>& v) {
    for (glm::length_t i = 0; i < N; ++i) value(v[i]);
  }
  template <typename T, std::size_t N>
  void value(std::array<T, N>& all) {
    for (T& one : all) value(one);
  }
  template <typename T, std::size_t N>
  void value(const std::array<T, N>& all) {
    for (const T& one : all) value(one);
  }
  template <typename T, std::size_t N>
  void value(T (&all)[N]) {
    for (T& one : all) value(one);
  }
  template <typename T>
  void value(std::optional<T>& maybe) {
    bool there = maybe.has_value();
    value(there);
    if (there && !maybe) maybe.emplace();
    if (!there) maybe.reset();
    if (maybe) value(*maybe);
  }
  template <typename T>
  void value(const std::optional<T>& maybe) {
    const bool there = maybe.has_value();
    value(there);
    if (maybe) value(*maybe);
  }

  Leaf& leaf_;
};

struct Writer {
  std::vector<std::byte> bytes;
  template <Number T>
  void number(const T& value) {
    const auto* from = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof(T));
  }
};

// What is not there, or no truth value, is read as 0 and remembered as bad.
struct Reader {
  std::span<const std::byte> left;
  bool bad = false;
  template <Number T>
  void number(T& value) {
    std::array<std::byte, sizeof(T)> raw{};
    bad = bad || left.size() < raw.size();
    if (!bad) {
      std::copy_n(left.begin(), raw.size(), raw.begin());
      left = left.subspan(raw.size());
    }
    if constexpr (std::is_same_v<T, bool>) {
      bad = bad || raw[0] > std::byte{1};
      value = raw[0] == std::byte{1};
    } else {
      value = std::bit_cast<T>(raw);
    }
  }
};

// By bits: what differs in a NaN's, or in the sign of a zero, differs.
struct Hasher {
  std::uint64_t hash = 0;
  template <Number T>
  void number(const T& value) noexcept {
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof(T));
    hash = base::hash_combine(hash, word);
  }
};

// What the laws take as an index must be one, whoever wrote the bytes.
bool usable(const TickState& now) noexcept {
  const auto known = [](cases::EventKind kind) {
    return kind == cases::EventKind::none || cases::find_event(kind) != nullptr;
  };
  for (const haptics::HandState& hand : now.hands) {
    const haptics::NeedlePath& path = hand.needle.path;
    if (path.count > path.layers.size() || hand.needle.track.opened > path.count) return false;
    if (hand.delay_ticks < 0 || hand.delay_ticks > haptics::kMostDelayTicks) return false;
    if (static_cast<int>(hand.tool) < 0 || static_cast<int>(hand.tool) >= haptics::kTools) return false;
    for (const volume::TissueClass tissue : path.tissues)
      if (static_cast<std::size_t>(tissue) >= volume::kTissueClasses) return false;
  }
  for (const cases::EventKind kind : now.patient.waiting)
    if (!known(kind)) return false;
  const tissue::Displacement& moved = now.displacement;
  if (moved.contact_end < 0 || moved.tip_end < moved.contact_end || moved.shaft_end < moved.tip_end ||
      moved.vein_end < moved.shaft_end || moved.breath_end < moved.vein_end ||
      moved.breath_end > shaders::kMostDisplacementSources)
    return false;
  const cases::FluoroscopyState& machine = now.state.fluoroscopy;
  const auto rates = static_cast<int>(cases::kPulseRateHz.size());
  const auto sizes = static_cast<int>(cases::Fluoroscope{}.field_side_mm.size());
  return known(now.reaction.kind) && known(now.event.kind) && machine.views.count >= 0 &&
         machine.views.count <= cases::kMaxViews && machine.pulse_rate >= 0 && machine.pulse_rate < rates &&
         machine.magnification >= 0 && machine.magnification < sizes;
}

}  // namespace

std::uint64_t tick_state_hash(const TickState& now) noexcept {
  Hasher hasher;
  Walk{hasher}(now);
  return hasher.hash;
}

std::vector<std::byte> saved(const TickState& now) {
  Writer writer;
  for (const char letter : kMark) writer.number(letter);
  writer.number(kFormat);
  writer.number(kStepVersion);
  Walk{writer}(now);
  writer.number(base::hash_bytes(writer.bytes));
  return std::move(writer.bytes);
}

base::Result<TickState> restored(std::span<const std::byte> bytes) {
  const base::Error damaged{"damaged", "these bytes are no saved state of an attempt, or not all of it"};
  if (bytes.size() < kHeadBytes + kChecksumBytes ||
      !std::equal(kMark.begin(), kMark.end(), bytes.begin(),
                  [](char letter, std::byte byte) { return static_cast<std::byte>(letter) == byte; }))
    return damaged;
  Reader checksum{bytes.last(kChecksumBytes)};
  std::uint64_t sum = 0;
  checksum.number(sum);
  const auto summed = bytes.first(bytes.size() - kChecksumBytes);
  if (sum != base::hash_bytes(summed)) return damaged;
  Reader reader{summed.subspan(kMark.size())};
  std::uint32_t format = 0, step_version = 0;
  reader.number(format);
  reader.number(step_version);
  if (format != kFormat || step_version != kStepVersion)
    return base::Error{"state_version", "the state was saved by another version of the simulation"};
  TickState now;
  Walk{reader}(now);
  if (reader.bad || !reader.left.empty() || !usable(now)) return damaged;
  return now;
}

}  // namespace seldinger::engine
