#include "app/sound/signal/wav.h"

#include <sndfile.h>

#include <algorithm>
#include <cstring>
#include <memory>

namespace hapticwall::sound {
namespace {

// A file in memory, for libsndfile.
struct Memory {
  std::string bytes;
  std::size_t place = 0;
};

Memory& memory_of(void* user) { return *static_cast<Memory*>(user); }
sf_count_t signed_size(std::size_t size) { return static_cast<sf_count_t>(size); }

sf_count_t length(void* user) { return signed_size(memory_of(user).bytes.size()); }

sf_count_t seek(sf_count_t offset, int whence, void* user) {
  Memory& memory = memory_of(user);
  if (whence == SEEK_CUR) offset += signed_size(memory.place);
  if (whence == SEEK_END) offset += signed_size(memory.bytes.size());
  memory.place = static_cast<std::size_t>(std::max<sf_count_t>(offset, 0));
  return signed_size(memory.place);
}

sf_count_t read(void* to, sf_count_t count, void* user) {
  Memory& memory = memory_of(user);
  const std::size_t begin = std::min(memory.place, memory.bytes.size());
  const std::size_t size = std::min(static_cast<std::size_t>(count), memory.bytes.size() - begin);
  std::memcpy(to, memory.bytes.data() + begin, size);
  memory.place = begin + size;
  return signed_size(size);
}

sf_count_t write(const void* from, sf_count_t count, void* user) {
  Memory& memory = memory_of(user);
  const auto size = static_cast<std::size_t>(count);
  if (memory.bytes.size() < memory.place + size) memory.bytes.resize(memory.place + size);
  std::memcpy(memory.bytes.data() + memory.place, from, size);
  memory.place += size;
  return count;
}

sf_count_t tell(void* user) { return signed_size(memory_of(user).place); }

struct Close {
  void operator()(SNDFILE* file) const { sf_close(file); }
};

}  // namespace

Result<std::string> encode_wav(std::span<const float> samples) {
  Memory memory;
  SF_VIRTUAL_IO io{length, seek, read, write, tell};
  SF_INFO info{};
  info.samplerate = kFileRateHz;
  info.channels = 1;
  info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_24;
  std::unique_ptr<SNDFILE, Close> file(sf_open_virtual(&io, SFM_WRITE, &info, &memory));
  const auto count = static_cast<sf_count_t>(samples.size());
  if (!file || sf_write_float(file.get(), samples.data(), count) != count) {
    return file_error(std::string("the sound cannot be encoded: ") + sf_strerror(file.get()));
  }
  file.reset();  // completes the header
  return std::move(memory.bytes);
}

}  // namespace hapticwall::sound
