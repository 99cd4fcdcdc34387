#include "experiments/runner/cluster/task_file.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "core/base/error.h"
#include "core/image/io/atomic_file.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kHead = "task.json";
constexpr size_t kBuffer = size_t(1) << 18;

struct Freer {
  void operator()(archive* of) const { archive_free(of); }
  void operator()(archive_entry* of) const { archive_entry_free(of); }
};
using Archive = std::unique_ptr<archive, Freer>;

std::string hashText(uint64_t hash) { return fmt::format("{:016x}", hash); }

std::string bytesOfFile(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in) failInput(fmt::format("{}: cannot be read", file.string()));
  return bytes;
}

// Returns the files below a folder by their relative names, sorted.
std::vector<std::string> namesBelow(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) names.push_back(fs::relative(entry.path(), folder).string());
  std::sort(names.begin(), names.end());
  return names;
}

void addMember(archive* to, const std::string& name, const std::string& bytes) {
  const std::unique_ptr<archive_entry, Freer> entry(archive_entry_new());
  archive_entry_set_pathname(entry.get(), name.c_str());
  archive_entry_set_size(entry.get(), int64_t(bytes.size()));
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), 0644);
  const bool isWritten =
      archive_write_header(to, entry.get()) == ARCHIVE_OK &&
      archive_write_data(to, bytes.data(), bytes.size()) == la_ssize_t(bytes.size());
  if (!isWritten) failInput(archive_error_string(to));
}

la_ssize_t writeToStream(archive*, void* stream, const void* bytes, size_t count) {
  auto& out = *static_cast<std::ofstream*>(stream);
  out.write(static_cast<const char*>(bytes), std::streamsize(count));
  return out ? la_ssize_t(count) : -1;
}

// Calls `take` with each member, in order, until it returns false. Throws Error (badInput) that
// begins with the file.
void forEachMember(const fs::path& file,
                   const std::function<bool(const std::string& name, std::string bytes)>& take) {
  const auto fail = [&](const std::string& what) {
    failInput(fmt::format("{}: {}", file.string(), what));
  };
  const Archive in(archive_read_new());
  archive_read_support_format_tar(in.get());
  const auto check = [&](int status) {
    if (status == ARCHIVE_OK || status == ARCHIVE_EOF) return;
    const char* reason = archive_error_string(in.get());
    fail(fmt::format("is damaged: {}", reason ? reason : "no tar"));
  };
  check(archive_read_open_filename(in.get(), file.c_str(), kBuffer));
  while (true) {
    archive_entry* entry = nullptr;
    const int status = archive_read_next_header(in.get(), &entry);
    check(status);
    if (status == ARCHIVE_EOF) return;
    const char* name = archive_entry_pathname(entry);
    const int64_t size = archive_entry_size(entry);
    std::error_code unknown;
    if (!name || size < 0 || uint64_t(size) > fs::file_size(file, unknown) || unknown)
      fail("is damaged: a member has no name or size");
    std::string bytes(size_t(size), '\0');
    const la_ssize_t got = archive_read_data(in.get(), bytes.data(), bytes.size());
    if (got != la_ssize_t(size)) fail(fmt::format("is damaged: {} is cut off", name));
    if (!take(name, std::move(bytes))) return;
  }
}

Json parseHead(const fs::path& file, const std::string& name, const std::string& bytes) {
  Json head = Json::parse(bytes, nullptr, false);
  if (name != kHead || !head.is_object() || !head.contains("files"))
    failInput(fmt::format("{}: is damaged: does not begin with {}", file.string(), kHead));
  return head;
}

// Calls `take` with each file of a job; throws unless all are as they were packed.
void forEachFile(const fs::path& file,
                 const std::function<void(const std::string& name, const std::string&)>& take) {
  std::map<std::string, std::string> expected;
  bool isFirst = true;
  forEachMember(file, [&](const std::string& name, const std::string& bytes) {
    if (isFirst) {
      const Json head = parseHead(file, name, bytes);
      for (const auto& [own, hash] : head.at("files").items())
        expected.emplace(own, hash.get<std::string>());
      isFirst = false;
      return true;
    }
    const auto found = expected.find(name);
    if (found == expected.end() ||
        found->second != hashText(XXH3_64bits(bytes.data(), bytes.size())))
      failInput(fmt::format("{}: is damaged: {} is not what was packed", file.string(), name));
    expected.erase(found);
    take(name, bytes);
    return true;
  });
  if (isFirst || !expected.empty())
    failInput(fmt::format("{}: is damaged: it ends too early", file.string()));
}

}  // namespace

void packTask(const fs::path& file, Json head, const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const std::string& name : namesBelow(folder)) {
    const std::string bytes = bytesOfFile(folder / name);
    files.emplace(name, hashText(XXH3_64bits(bytes.data(), bytes.size())));
  }
  head["files"] = files;
  AtomicFile out(file);
  try {
    const Archive to(archive_write_new());
    archive_write_set_format_pax_restricted(to.get());
    archive_write_set_bytes_per_block(to.get(), int(kBuffer));
    archive_write_set_bytes_in_last_block(to.get(), 1);
    if (archive_write_open(to.get(), &out.stream(), nullptr, writeToStream, nullptr) != ARCHIVE_OK)
      failInput(archive_error_string(to.get()));
    addMember(to.get(), kHead, head.dump(1) + "\n");
    for (const auto& [name, hash] : files) addMember(to.get(), name, bytesOfFile(folder / name));
    if (archive_write_close(to.get()) != ARCHIVE_OK) failInput("a write failed");
  } catch (const Error&) {
    if (out.stream()) throw;  // else commit() has the reason
  }
  if (!out.commitNew() && !whyDamaged(file).empty()) out.commit();
}

Json readTaskHead(const fs::path& file) {
  Json head;
  forEachMember(file, [&](const std::string& name, const std::string& bytes) {
    head = parseHead(file, name, bytes);
    return false;
  });
  if (head.is_null()) failInput(fmt::format("{}: is damaged: it is empty", file.string()));
  return head;
}

std::string whyDamaged(const fs::path& file) {
  try {
    forEachFile(file, [](const std::string&, const std::string&) {});
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

void unpackTask(const fs::path& file, const fs::path& folder) {
  forEachFile(file, [&](const std::string& name, const std::string& bytes) {
    const fs::path relative = fs::path(name).lexically_normal();
    if (relative.is_absolute() || relative.empty() || *relative.begin() == "..")
      failInput(fmt::format("{}: {} leads out of the folder", file.string(), name));
    const fs::path target = folder / relative;
    std::error_code status;
    fs::create_directories(target.parent_path(), status);
    std::ofstream out(target, std::ios::binary);
    out.write(bytes.data(), std::streamsize(bytes.size()));
    out.close();
    if (!out) failInput(fmt::format("{}: cannot be written (is the disk full?)", target.string()));
  });
}

}  // namespace restlab
