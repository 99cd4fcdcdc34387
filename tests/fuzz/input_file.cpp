#include "tests/fuzz/input_file.h"

#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>

namespace restlab::fuzz {

namespace fs = std::filesystem;

namespace {

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "restlab-fuzz-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

fs::path inputFile(const char* name, const uint8_t* bytes, size_t count) {
  static const Folder folder;
  const fs::path file = folder.path() / name;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file.string());
  return file;
}

bool isRead(const fs::path& file, ExitCode refusal, const std::function<void()>& read) {
  try {
    read();
    return true;
  } catch (const Error& error) {
    const std::string line = error.what();
    if (error.code() != refusal) throw std::logic_error("wrong exit code: " + line);
    const std::string name = file.string();  // settings may stand behind it
    if (line.rfind(name + ":", 0) != 0 && line.rfind(name + "?", 0) != 0)
      throw std::logic_error("names no file: " + line);
    const bool plain = std::none_of(line.begin(), line.end(), [](unsigned char c) {
      return c < 0x20 || c == 0x7f;  // control characters: line breaks, terminal escapes
    });
    if (!plain) throw std::logic_error("more than a line of text: " + line);
    return false;
  }
}

}  // namespace restlab::fuzz
