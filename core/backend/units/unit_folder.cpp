#include "core/backend/units/unit_folder.h"

#include <dlfcn.h>
#include <elf.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <thread>
#include <vector>

#include "core/backend/embree.h"
#include "core/backend/units/unit_source.h"
#include "core/base/cache_folder.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

constexpr const char* kWorkPrefix = "work-";
constexpr auto kWorkAge = std::chrono::hours(24);

// Follows the shared object in its file: number of its bytes, and hash of them and the key.
struct Check {
  char magic[8] = {'r', 'l', 'u', 'n', 'i', 't', '1', '\n'};
  uint64_t count = 0;
  uint64_t hashLow = 0, hashHigh = 0;
};

Check checkOf(const char* bytes, size_t count, const std::string& key) {
  const XXH128_hash_t hash =
      XXH3_128bits_withSeed(bytes, count, XXH3_64bits(key.data(), key.size()));
  Check check;
  check.count = count;
  check.hashLow = hash.low64;
  check.hashHigh = hash.high64;
  return check;
}

bool isWritableByOthers(mode_t mode) { return (mode & (S_IWGRP | S_IWOTH)) != 0; }

std::string systemReason(const fs::path& path) {
  return fmt::format("{}: {}", path.string(), std::strerror(errno));
}

// RAII: a descriptor that is closed.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) close(number);
  }
};

std::string bytesOf(int descriptor) {
  std::string bytes;
  char part[1 << 16];
  for (ssize_t count = 0; (count = read(descriptor, part, sizeof part)) > 0;)
    bytes.append(part, size_t(count));
  return bytes;
}

// Size of what a shared object can execute; 0 if its header is damaged.
size_t codeBytesOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  Elf64_Ehdr header = {};
  stream.read(reinterpret_cast<char*>(&header), sizeof header);
  size_t bytes = 0;
  for (unsigned i = 0; stream && i < header.e_phnum; ++i) {
    Elf64_Phdr part = {};
    stream.seekg(std::streamoff(header.e_phoff + i * sizeof part));
    stream.read(reinterpret_cast<char*>(&part), sizeof part);
    if (stream && part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0) bytes += part.p_memsz;
  }
  return bytes;
}

// Units call Embree by name. Where this code is in a library that a program has loaded later, such
// as a Python module, Embree is known to that library alone until it is opened for all.
void showEmbree() {
  static const bool isShown = [] {
    Dl_info embree;
    return dladdr(reinterpret_cast<void*>(&rtcIntersect1), &embree) != 0 &&
           dlopen(embree.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD) != nullptr;
  }();
  static_cast<void>(isShown);
}

}  // namespace

fs::path UnitFolder::defaultFolder() { return cacheFolder("units"); }

std::string UnitFolder::open() const {
  if (folder_.empty()) return "neither XDG_CACHE_HOME nor HOME names a folder to keep them in";
  std::error_code status;
  fs::create_directories(folder_.parent_path(), status);
  if (mkdir(folder_.c_str(), S_IRWXU) != 0 && errno != EEXIST) return systemReason(folder_);
  struct stat info = {};
  if (stat(folder_.c_str(), &info) != 0) return systemReason(folder_);
  if (!S_ISDIR(info.st_mode)) return fmt::format("{}: is not a folder", folder_.string());
  if (info.st_uid != geteuid()) return fmt::format("{}: belongs to another user", folder_.string());
  if (isWritableByOthers(info.st_mode))
    return fmt::format("{}: others can write to it (chmod go-w would help)", folder_.string());
  if (access(folder_.c_str(), W_OK | X_OK) != 0) return systemReason(folder_);
  return "";
}

// Returns why a file is not loaded; "" if it may be.
std::string UnitFolder::whyNotLoaded(const std::string& key, const fs::path& file) const {
  const Descriptor descriptor{::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC)};
  struct stat info = {};
  if (descriptor.number < 0 || fstat(descriptor.number, &info) != 0) return std::strerror(errno);
  if (!S_ISREG(info.st_mode)) return "is no file";
  if (info.st_uid != geteuid()) return "belongs to another user";
  if (isWritableByOthers(info.st_mode)) return "others can write to it";
  const std::string bytes = bytesOf(descriptor.number);
  Check stored;
  if (bytes.size() < sizeof stored) return "is damaged";
  const size_t count = bytes.size() - sizeof stored;
  std::memcpy(&stored, bytes.data() + count, sizeof stored);
  const Check right = checkOf(bytes.data(), count, key);
  if (std::memcmp(&stored, &right, sizeof right) != 0) return "is damaged, or of another key";
  futimens(descriptor.number, nullptr);  // used now: prune() keeps it
  return "";
}

UnitFolder::Loaded UnitFolder::load(const std::string& key) const {
  const fs::path file = fileOf(key);
  struct stat info = {};
  if (lstat(file.c_str(), &info) != 0 && errno == ENOENT) return {};
  const std::string why = whyNotLoaded(key, file);
  if (!why.empty()) return {nullptr, 0, fmt::format("{}: {}", file.string(), why), false};
  showEmbree();
  void* unit = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  const void* entry = unit == nullptr ? nullptr : dlsym(unit, kUnitEntry);
  if (entry == nullptr)
    return {nullptr, 0, fmt::format("{}: does not load ({})", file.string(), dlerror()), true};
  Loaded loaded;
  loaded.isRight = true;
  loaded.codeBytes = codeBytesOf(file);
  std::memcpy(&loaded.entry, entry, sizeof loaded.entry);
  return loaded;
}

std::string UnitFolder::keep(const std::string& key, const fs::path& object) const {
  std::ifstream in(object, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in || bytes.empty()) return fmt::format("{}: cannot be read", object.string());
  const Check check = checkOf(bytes.data(), bytes.size(), key);
  std::ofstream out(object, std::ios::binary | std::ios::app);
  out.write(reinterpret_cast<const char*>(&check), sizeof check);
  out.close();
  if (!out) return systemReason(folder_);
  chmod(object.c_str(), S_IRUSR | S_IWUSR);
  if (std::rename(object.c_str(), fileOf(key).c_str()) != 0) return systemReason(fileOf(key));
  return "";
}

UnitFolder::Turn::~Turn() { close(descriptor_); }

std::unique_ptr<UnitFolder::Turn> UnitFolder::waitForTurn(
    const std::string& key, const std::function<bool()>& isStopped) const {
  const int descriptor =
      ::open((folder_ / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR);
  auto turn = std::make_unique<Turn>(descriptor);
  // One byte of the file for each key. The system frees it when its holder ends, however that is.
  struct flock byte = {};
  byte.l_type = F_WRLCK;
  byte.l_whence = SEEK_SET;
  byte.l_start = off_t(XXH3_64bits(key.data(), key.size()) >> 2);
  byte.l_len = 1;
  while (descriptor >= 0 && fcntl(descriptor, F_OFD_SETLK, &byte) != 0) {
    // A file system without locks: processes may make the same unit, and the last one stays.
    if (errno != EAGAIN && errno != EACCES && errno != EINTR) break;
    if (isStopped()) return nullptr;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return turn;
}

fs::path UnitFolder::makeWorkFolder() const {
  std::string path = (folder_ / (std::string(kWorkPrefix) + "XXXXXX")).string();
  return mkdtemp(path.data()) == nullptr ? fs::path() : fs::path(path);
}

void UnitFolder::prune(uint64_t most) const {
  struct Unit {
    fs::file_time_type used;
    uint64_t bytes;
    fs::path file;
  };
  std::vector<Unit> units;
  uint64_t total = 0;
  const auto now = fs::file_time_type::clock::now();
  std::error_code status;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, status)) {
    const auto used = entry.last_write_time(status);
    if (status) continue;
    if (entry.path().filename().string().rfind(kWorkPrefix, 0) == 0) {
      if (now - used > kWorkAge) fs::remove_all(entry.path(), status);
      continue;
    }
    if (entry.path().extension() != ".so") continue;
    const uint64_t bytes = entry.file_size(status);
    if (status) continue;
    total += bytes;
    units.push_back({used, bytes, entry.path()});
  }
  if (total <= most) return;
  std::sort(units.begin(), units.end(),
            [](const Unit& a, const Unit& b) { return a.used < b.used; });
  for (const Unit& unit : units) {
    if (total <= most / 2) return;
    fs::remove(unit.file, status);
    total -= unit.bytes;
  }
}

}  // namespace restlab
