// A recording that was cut off, in a folder of its own: its sidecar, a zero byte, its CSV.
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>

#include "app/file/recording/recording_reader.h"
#include "app/file/recording/recovery.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/text_promises.h"

namespace hapticwall::fuzz {
namespace {

namespace fs = std::filesystem;

// Folder in memory if there is such a place, because its contents need not last.
class Folder {
 public:
  Folder() {
    const fs::path memory = "/dev/shm";
    std::error_code ignored;
    const fs::path parent = fs::is_directory(memory, ignored) ? memory : fs::temp_directory_path();
    std::string name = parent / "hapticwall_fuzz_XXXXXX";
    require(mkdtemp(name.data()) != nullptr, "there is a folder to write into");
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  void clear() const {
    for (const auto& entry : fs::directory_iterator(path_)) fs::remove(entry);
  }
  [[nodiscard]] std::string file(const char* name) const { return path_ / name; }
  [[nodiscard]] bool has(const char* name) const { return fs::exists(path_ / name); }
  void put(const char* name, std::string_view text) const {
    std::ofstream(file(name), std::ios::binary) << text;
  }
  [[nodiscard]] std::string content(const char* name) const {
    std::ifstream in(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }

 private:
  fs::path path_;
};

void require_untouched(const Folder& folder, std::string_view sidecar, std::string_view csv) {
  require(!folder.has("a.csv") && !folder.has("a.toml"), "what is refused gets no name");
  require(folder.content("a.csv.partial") == csv && folder.content("a.toml.partial") == sidecar,
          "what is refused stays as it was");
}

void require_whole(const Folder& folder, const file::Recovered& recovered, std::string_view csv) {
  require(!folder.has("a.csv.partial") && !folder.has("a.toml.partial"),
          "what was recovered has its names");
  const std::string rows = folder.content("a.csv");
  require(csv.starts_with(rows) && rows.size() + recovered.cut_bytes == csv.size(),
          "nothing but a broken line is left out");
  const auto reader = file::RecordingReader::open(folder.file("a.csv"));
  require(reader.ok(), "what was recovered can be read");
  require((*reader)->rows() == recovered.rows && (*reader)->info().has_sidecar,
          "what was recovered has its rows and its sidecar");
  require((*reader)->info().notes.size() == (recovered.missing_rows > 0 ? 1 : 0),
          "what was recovered is what its sidecar was written for");
  for (const std::string& note : recovered.notes) require(!note.empty(), "a note says something");
}

Outcome fuzz_one(Bytes input) {
  static const Folder kFolder;
  const std::string_view text = text_of(input);
  const std::string_view sidecar = text.substr(0, text.find('\0'));
  const std::string_view csv = text.substr(std::min(text.size(), sidecar.size() + 1));
  kFolder.clear();
  kFolder.put("a.toml.partial", sidecar);
  kFolder.put("a.csv.partial", csv);
  const std::string path = kFolder.file("a.csv");
  const Result<file::Recovered> recovered = file::recover_recording(path);
  if (!recovered) {
    require_one_clean_line(recovered.error(), kFolder.file("a."));
    require_untouched(kFolder, sidecar, csv);
    return Outcome::kRefused;
  }
  require_whole(kFolder, *recovered, csv);
  require(!file::recover_recording(path), "what is whole is not recovered again");
  return Outcome::kTaken;
}

const Registered kRegistered({"recovery", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
