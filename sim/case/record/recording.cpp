#include "sim/case/record/recording.h"

#include <cmath>
#include <cstring>

#include "sim/base/codec.h"
#include "sim/base/hash.h"
#include "sim/case/record/recording_rows.h"

namespace seldinger::cases {
namespace {

constexpr std::uint32_t kMagic = 0x524c4453;  // "SDLR"
constexpr std::uint32_t kFormat = 9, kFormatWithoutSteering = 8, kFormatWithoutColour = 7, kFormatWithoutPauses = 6,
                        kFormatWithoutConsole = 5, kFormatWithoutEvents = 4, kFormatWithoutForces = 3,
                        kFormatWithoutNearPlane = 2, kFormatWithoutFluoroscope = 1;
constexpr std::uint32_t kMaxRows = 50'000;  // per chunk, 25 kHz: bounds what damaged bytes can make us allocate

constexpr std::uint32_t kNotListened = 0xffff'ffff;

struct Header {
  std::uint32_t magic = kMagic, format = kFormat;
  std::uint32_t step_version = 0, inputs = 0, poses = 0, frames = 0, has_endpoint = 0;
  std::uint32_t used = 0;  // UsedBit, or-ed; before format 5: of the fluoroscope alone
  double dt_s = 0.0;
  double endpoint[7] = {};
  std::uint32_t forces = 0;             // from here on since format 4
  std::uint32_t events = kNotListened;  // since format 5; 0 before
};
static_assert(sizeof(Header) == 104);
constexpr std::size_t kHeaderWithoutForces = 96;

enum UsedBit : std::uint32_t {
  kFluoroscope = 1,
  kMoves = 2,
  kConsole = 4,
  kPauses = 8,
  kColour = 16,
  kSteered = 32
};

struct Piece {
  Rows inputs, poses, forces, frames, events;
  bool with_endpoint = false;
};

// Whether a chunk holds anything of a fluoroscope.
bool uses_fluoroscope(const Recording& recording, const Piece& piece) {
  for (std::size_t i = piece.inputs.first; i < piece.inputs.end; ++i)
    if (!(recording.inputs[i].fluoroscope == FluoroscopeInputs{} &&
          recording.inputs[i].exposure == ExposureReport{}))
      return true;
  for (std::size_t i = piece.frames.first; i < piece.frames.end; ++i)
    if (recording.frames[i].beam) return true;
  return false;
}

// Whether the console was touched in a chunk, or was before.
bool turns_console(const Recording& recording, const Piece& piece) {
  for (std::size_t i = piece.inputs.first; i < piece.inputs.end; ++i)
    if (!(recording.inputs[i].console == ConsoleSetting{})) return true;
  return false;
}

// Whether flow was shown in colour in a chunk.
bool shows_colour(const Recording& recording, const Piece& piece) {
  for (std::size_t i = piece.inputs.first; i < piece.inputs.end; ++i)
    if (recording.inputs[i].console.colour_mm_s != 0.0) return true;
  return false;
}

// Whether the console looked aside in a chunk, or colour's box was moved.
bool is_steered(const Recording& recording, const Piece& piece) {
  for (std::size_t i = piece.inputs.first; i < piece.inputs.end; ++i)
    if (steering_of(recording.inputs[i].console) != std::array<double, 4>{}) return true;
  return false;
}

// Whether an event of a chunk says how long by the wall's clock.
bool pauses(const Recording& recording, const Piece& piece) {
  for (std::size_t i = piece.events.first; i < piece.events.end; ++i)
    if ((*recording.events)[i].wall_s != 0.0) return true;
  return false;
}

// Whether the patient moves in a chunk: then every tip has a place at rest of its own.
bool moves(const Recording& recording, const Piece& piece) {
  for (std::size_t i = piece.poses.first; i < piece.poses.end; ++i)
    if (recording.poses[i].rest_tip_lps_mm) return true;
  return piece.with_endpoint && recording.endpoint->rest_tip_lps_mm;
}

Header header_of(const Recording& recording, const Piece& piece, const ChunkLayout& layout) {
  Header header;
  header.step_version = recording.step_version;
  header.dt_s = recording.dt_s;
  header.inputs = piece.inputs.count();
  header.poses = piece.poses.count();
  header.forces = piece.forces.count();
  header.frames = piece.frames.count();
  if (recording.events) header.events = piece.events.count();
  if (piece.with_endpoint) {
    const Endpoint& endpoint = *recording.endpoint;
    header.has_endpoint = 1;
    header.endpoint[0] = endpoint.t_s;
    for (int axis = 0; axis < 3; ++axis) {
      header.endpoint[1 + axis] = endpoint.tip_lps_mm[axis];
      header.endpoint[4 + axis] = endpoint.direction[axis];
    }
  }
  header.used = (layout.fluoroscope ? kFluoroscope : 0U) | (layout.moving ? kMoves : 0U) |
                (layout.console ? kConsole : 0U) | (layout.pauses ? kPauses : 0U) | (layout.colour ? kColour : 0U) |
                (layout.steered ? kSteered : 0U);
  return header;
}

RecordingChunk make_chunk(const Recording& recording, std::uint32_t sequence, const Piece& piece) {
  ChunkLayout layout;
  layout.fluoroscope = uses_fluoroscope(recording, piece);
  layout.moving = moves(recording, piece);
  layout.console = turns_console(recording, piece);
  layout.pauses = pauses(recording, piece);
  layout.colour = shows_colour(recording, piece);
  layout.steered = is_steered(recording, piece);
  const Header header = header_of(recording, piece, layout);
  std::vector<std::byte> raw(sizeof header);
  std::memcpy(raw.data(), &header, sizeof header);
  append_inputs(recording, piece.inputs, layout, raw);
  append_poses(recording, piece.poses, layout, raw);
  append_forces(recording, piece.forces, raw);
  append_frames(recording, piece.frames, layout, raw);
  append_events(recording, piece.events, layout, raw);
  if (layout.moving && piece.with_endpoint) append_endpoint_at_rest(recording, raw);

  RecordingChunk chunk;
  chunk.sequence = sequence;
  chunk.data = base::compress(raw);
  chunk.checksum = base::hash_bytes(chunk.data);
  return chunk;
}

std::size_t size_of_header(std::uint32_t format) {
  return format > kFormatWithoutForces ? sizeof(Header) : kHeaderWithoutForces;
}

// The bits of `used` that a format knows.
std::uint32_t used_bits(std::uint32_t format) {
  if (format == kFormatWithoutFluoroscope) return 0;
  if (format <= kFormatWithoutEvents) return kFluoroscope;
  if (format <= kFormatWithoutConsole) return kFluoroscope | kMoves;
  return kFluoroscope | kMoves | kConsole | (format > kFormatWithoutPauses ? kPauses : 0U) |
         (format > kFormatWithoutColour ? kColour : 0U) | (format > kFormatWithoutSteering ? kSteered : 0U);
}

// The header of a chunk in any known format, its later fields as the newest format would have them.
base::Result<Header> read_header(const std::vector<std::byte>& raw, const std::string& where) {
  const base::Error unreadable{"damaged", where + " cannot be read"};
  if (raw.size() < kHeaderWithoutForces) return unreadable;
  Header header;
  std::memcpy(static_cast<void*>(&header), raw.data(), kHeaderWithoutForces);
  const std::size_t size = size_of_header(header.format);
  if (raw.size() < size) return unreadable;
  std::memcpy(static_cast<void*>(&header), raw.data(), size);
  if (header.magic != kMagic) return unreadable;
  if (header.format < kFormatWithoutFluoroscope || header.format > kFormat)
    return base::Error{"recording_version", where + " has an unknown format"};
  if (header.used > used_bits(header.format)) return unreadable;
  if (header.format <= kFormatWithoutEvents) header.events = kNotListened;
  return header;
}

ChunkLayout layout_of(const Header& header) {
  ChunkLayout layout;
  layout.fluoroscope = (header.used & kFluoroscope) != 0;
  layout.moving = (header.used & kMoves) != 0;
  layout.console = (header.used & kConsole) != 0;
  layout.pauses = (header.used & kPauses) != 0;
  layout.colour = (header.used & kColour) != 0;
  layout.steered = (header.used & kSteered) != 0;
  layout.listened = header.events != kNotListened;
  layout.near_plane = header.format > kFormatWithoutNearPlane;
  return layout;
}

// Whether the chunk's bytes are exactly the rows that its header counts.
bool has_its_size(const Header& header, const ChunkLayout& layout, std::size_t bytes) {
  const std::uint32_t events = layout.listened ? header.events : 0;
  for (const std::uint32_t rows : {header.inputs, header.poses, header.frames, header.forces, events})
    if (rows > kMaxRows) return false;
  const std::size_t words = header.inputs * layout.input_columns() + header.poses * layout.pose_columns() +
                            header.forces * kForceColumns + header.frames * layout.frame_columns() +
                            events * layout.event_columns() +
                            (layout.moving && header.has_endpoint != 0 ? kRestColumns : 0);
  return bytes == size_of_header(header.format) + 8 * words;
}

// Room for all rows of a recording that goes on as its first chunk begins, so that they are not moved as they come:
// that cost a page of an attempt a fifth of its time.
void make_room(const Header& first, std::size_t chunks, Recording& recording) {
  constexpr std::size_t kMostRoom = 300'000;  // rows: five minutes at 1 kHz
  const auto room = [&](std::uint32_t rows) { return std::min(rows * chunks, kMostRoom); };
  recording.inputs.reserve(room(first.inputs));
  recording.hashes.reserve(room(first.inputs));
  recording.poses.reserve(room(first.poses));
  recording.forces.reserve(room(first.forces));
  recording.frames.reserve(room(first.frames));
}

// Adds what a chunk of so many holds. `first`: nothing was added before it.
base::Result<void> add_chunk(const RecordingChunk& chunk, std::size_t chunks, const std::string& where, bool first,
                             Recording& recording) {
  const auto raw = base::decompress(chunk.data, std::size_t{kMaxRows} * 8 * (kMaxInputColumns + kMaxPoseColumns));
  if (!raw) return base::Error{"damaged", where + " cannot be read"};
  const auto header = read_header(*raw, where);
  if (!header) return header.error();
  const ChunkLayout layout = layout_of(*header);
  if (!has_its_size(*header, layout, raw->size())) return base::Error{"damaged", where + " has a wrong size"};

  if (first) make_room(*header, chunks, recording);
  // What all chunks of a recording share.
  if (!first && (header->step_version != recording.step_version || header->dt_s != recording.dt_s ||
                 layout.listened != recording.events.has_value()))
    return base::Error{"damaged", where + " belongs to another recording"};
  if (!(header->dt_s > 0.0 && header->dt_s <= 1.0))
    return base::Error{"damaged", where + " has no sound time step"};
  recording.step_version = header->step_version;
  recording.dt_s = header->dt_s;
  if (layout.listened && !recording.events) recording.events.emplace();

  const auto& fired = header->endpoint;
  if (header->has_endpoint != 0)
    recording.endpoint = Endpoint{fired[0], {fired[1], fired[2], fired[3]}, {fired[4], fired[5], fired[6]}, {}};

  // The tables, in the order in which make_chunk writes them.
  const std::byte* from = raw->data() + size_of_header(header->format);
  const auto inputs = read_inputs(from, header->inputs, layout, recording);
  if (!inputs) return base::Error{inputs.error().code, where + " " + inputs.error().text};
  read_poses(from, header->poses, layout, recording);
  read_forces(from, header->forces, recording);
  read_frames(from, header->frames, layout, recording);
  const auto events = read_events(from, layout.listened ? header->events : 0, layout, recording);
  if (!events) return base::Error{events.error().code, where + " " + events.error().text};
  if (layout.moving && header->has_endpoint != 0) read_endpoint_at_rest(from, recording);
  return {};
}

}  // namespace

std::vector<RecordingChunk> chunks_from_recording(const Recording& recording) {
  CHECK(recording.hashes.size() == recording.inputs.size());
  CHECK(recording.dt_s > 0.0);
  const auto ticks_per_chunk = static_cast<std::size_t>(std::ceil(kChunkSeconds / recording.dt_s));
  CHECK(ticks_per_chunk <= kMaxRows);
  std::vector<RecordingChunk> chunks;
  Piece piece;
  bool endpoint_left = recording.endpoint.has_value(), last = false;
  while (!last) {
    piece.inputs = {piece.inputs.end, std::min(recording.inputs.size(), piece.inputs.end + ticks_per_chunk)};
    last = piece.inputs.end == recording.inputs.size();
    const double end_s = static_cast<double>(piece.inputs.end) * recording.dt_s;
    const auto advance = [&](Rows& rows, const auto& table) {
      rows.first = rows.end;
      while (rows.end < table.size() && (last || table[rows.end].t_s < end_s)) ++rows.end;
    };
    advance(piece.poses, recording.poses);
    advance(piece.forces, recording.forces);
    advance(piece.frames, recording.frames);
    if (recording.events) advance(piece.events, *recording.events);
    piece.with_endpoint = endpoint_left && (last || recording.endpoint->t_s < end_s);
    if (piece.with_endpoint) endpoint_left = false;
    chunks.push_back(make_chunk(recording, static_cast<std::uint32_t>(chunks.size()), piece));
  }
  return chunks;
}

RecordingChunk chunk_of(const Recording& piece, std::uint32_t sequence) {
  CHECK(piece.hashes.size() == piece.inputs.size());
  CHECK(piece.dt_s > 0.0);
  CHECK(piece.inputs.size() <= kMaxRows && piece.frames.size() <= kMaxRows);
  const std::size_t events = piece.events ? piece.events->size() : 0;
  CHECK(events <= kMaxRows);
  return make_chunk(piece, sequence,
                    {{0, piece.inputs.size()},
                     {0, piece.poses.size()},
                     {0, piece.forces.size()},
                     {0, piece.frames.size()},
                     {0, events},
                     piece.endpoint.has_value()});
}

base::Result<Recording> recording_from_chunks(std::span<const RecordingChunk> chunks) {
  if (chunks.empty()) return base::Error{"incomplete", "the recording has no chunks"};
  Recording recording;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    const std::string where = "recording chunk " + std::to_string(i);
    if (chunks[i].sequence != i) return base::Error{"incomplete", where + " is missing"};
    if (chunks[i].checksum != base::hash_bytes(chunks[i].data))
      return base::Error{"damaged", where + " does not have its checksum"};
    const auto added = add_chunk(chunks[i], chunks.size(), where, i == 0, recording);
    if (!added) return added.error();
  }
  return recording;
}

}  // namespace seldinger::cases
