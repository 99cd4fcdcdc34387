#include "core/scene/gltf_container.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <memory>
#include <set>

#include "core/file_reason.h"

namespace restlab::gltf {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little, "glTF data are little-endian");

constexpr uint32_t kMagic = 0x46546c67;      // "glTF"
constexpr uint32_t kChunkJson = 0x4e4f534a;  // "JSON"
constexpr uint32_t kChunkBin = 0x004e4942;   // "BIN\0"
constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr size_t kAlignment = 4;  // of chunks
// tinygltf takes a 32-bit length, and a document nested deeper than any glTF needs is an attack on
// recursive readers.
constexpr uint64_t kMaxJsonBytes = 0x7fffffff;
constexpr int kMaxJsonDepth = 128;

uint32_t readU32(const std::vector<uint8_t>& bytes, size_t offset) {
  uint32_t value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

void checkDepth(std::string_view text, const Report& report) {
  int depth = 0;
  bool inString = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxJsonDepth) {
        report.fail("", fmt::format("JSON is nested deeper than {} levels", kMaxJsonDepth));
      }
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

// Says which keys stand twice in an object; of such the parser keeps the last one.
class DuplicateKeys {
 public:
  explicit DuplicateKeys(Report& report) : report_(&report) {}

  bool operator()(int, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
    using Event = nlohmann::json::parse_event_t;
    if (event == Event::object_start) {
      open_->emplace_back();
    } else if (event == Event::object_end) {
      open_->pop_back();
    } else if (event == Event::key) {
      const auto& key = parsed.get_ref<const std::string&>();
      if (!open_->back().insert(key).second)
        report_->warn("duplicate keys", key.substr(0, kLongestKey),
                      "stands twice in one object; the last one counts");
    }
    return true;
  }

 private:
  static constexpr size_t kLongestKey = 100;
  Report* report_;
  // The keys of the objects that are open; shared, as the parser copies this.
  std::shared_ptr<std::vector<std::set<std::string>>> open_ =
      std::make_shared<std::vector<std::set<std::string>>>();
};

nlohmann::json parseJson(std::string_view text, Report& report) {
  if (text.size() > kMaxJsonBytes) {
    report.fail("", fmt::format("JSON of {} bytes is too large; at most {} are read", text.size(),
                                kMaxJsonBytes));
  }
  if (text.substr(0, 3) == "\xef\xbb\xbf") {
    report.warn("BOM", "",
                "begins with a byte order mark, which glTF does not allow; it is skipped");
    text.remove_prefix(3);
  }
  checkDepth(text, report);
  // A value of two characters, "0,", becomes a node of 16 bytes.
  report.takeMemory("", fmt::format("JSON of {} bytes", text.size()), text.size() * 8);
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text, DuplicateKeys(report));
  } catch (const nlohmann::json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 3, column 5: ..." without the label.
    std::string what = error.what();
    const size_t bracket = what.find("] ");
    if (bracket != std::string::npos) what.erase(0, bracket + 2);
    constexpr size_t kLongest = 300;
    if (what.size() > kLongest) what = what.substr(0, kLongest) + " ...";
    report.fail("", "not valid JSON: " + what);
  }
  if (!json.is_object()) {
    report.fail("", fmt::format("the document is a JSON {}; an object expected", json.type_name()));
  }
  return json;
}

// Zeros and blanks pad chunks.
bool isPadding(const std::vector<uint8_t>& bytes, size_t from) {
  return std::all_of(bytes.begin() + static_cast<ptrdiff_t>(from), bytes.end(),
                     [](uint8_t byte) { return byte == 0 || byte == ' '; });
}

// Does a chunk of a known type begin here, whole?
bool isChunk(const std::vector<uint8_t>& bytes, size_t offset) {
  if (offset > bytes.size() || bytes.size() - offset < kChunkHeaderBytes) return false;
  const uint32_t size = readU32(bytes, offset), type = readU32(bytes, offset + 4);
  return (type == kChunkJson || type == kChunkBin) &&
         size <= bytes.size() - offset - kChunkHeaderBytes;
}

// Finds the start of the chunk behind one that ends at `end`. Some writers leave out the padding of
// a chunk that is no multiple of 4 long, and some leave it out of the length.
size_t nextChunk(const std::vector<uint8_t>& bytes, size_t end) {
  const size_t aligned = (end + kAlignment - 1) / kAlignment * kAlignment;
  if (end == aligned || isChunk(bytes, end)) return end;
  return isChunk(bytes, aligned) ? aligned : end;
}

Container readGlb(std::vector<uint8_t> bytes, Report& report) {
  if (bytes.size() < kHeaderBytes) {
    report.fail(
        "", fmt::format("truncated: {} bytes, a GLB header has {}", bytes.size(), kHeaderBytes));
  }
  const uint32_t version = readU32(bytes, 4), length = readU32(bytes, 8);
  if (version != 2) report.fail("", fmt::format("GLB version {}; 2 expected", version));
  const bool lacksPadding = length > bytes.size() && length - bytes.size() < kAlignment;
  if (length > bytes.size() && !lacksPadding) {
    report.fail("", fmt::format("truncated: the GLB header declares {} bytes, the file has {}",
                                length, bytes.size()));
  }
  if (length <= kHeaderBytes) report.fail("", "the GLB holds no chunk; a JSON chunk expected");
  Container container;
  bool haveJson = false;
  std::vector<uint8_t> hashed(bytes.begin(), bytes.begin() + kHeaderBytes);
  size_t offset = kHeaderBytes;
  for (size_t chunk = 0; offset < std::min<size_t>(length, bytes.size()); ++chunk) {
    const std::string place = fmt::format("GLB chunk {}", chunk);
    if (bytes.size() - offset < kChunkHeaderBytes) {
      if (haveJson && isPadding(bytes, offset)) {
        report.warn(
            "GLB padding", "",
            fmt::format("{} bytes behind the last GLB chunk belong to none; they are skipped",
                        bytes.size() - offset));
        offset = bytes.size();
        break;
      }
      report.fail(place, fmt::format("truncated: {} bytes left, a chunk header has {}",
                                     bytes.size() - offset, kChunkHeaderBytes));
    }
    const uint32_t size = readU32(bytes, offset), type = readU32(bytes, offset + 4);
    offset += kChunkHeaderBytes;
    if (size > bytes.size() - offset) {
      report.fail(place, fmt::format("truncated: declares {} bytes, {} are left", size,
                                     bytes.size() - offset));
    }
    if (size % kAlignment != 0) {
      report.warn("GLB padding", place,
                  fmt::format("has {} bytes; a multiple of {} expected", size, kAlignment));
    }
    if (chunk == 0 && type != kChunkJson) {
      report.fail(place, fmt::format("is of type 0x{:08x}; the first chunk must be JSON", type));
    }
    const auto begin = bytes.begin() + static_cast<ptrdiff_t>(offset);
    const auto end = begin + static_cast<ptrdiff_t>(size);
    if (type == kChunkJson) {
      if (haveJson) report.fail(place, "is a second JSON chunk; one expected");
      if (size == 0) report.fail(place, "is an empty JSON chunk");
      haveJson = true;
      hashed.insert(hashed.end(), begin, end);
      container.json = parseJson(
          std::string_view(reinterpret_cast<const char*>(bytes.data()) + offset, size), report);
    } else if (type == kChunkBin) {
      if (container.binary) report.fail(place, "is a second BIN chunk; at most one expected");
      if (chunk != 1) report.fail(place, "is a BIN chunk; it must be the second chunk");
      container.binary.emplace(begin, end);
    } else {
      report.warn("GLB chunk", place, fmt::format("of unknown type 0x{:08x} is skipped", type));
    }
    offset = nextChunk(bytes, offset + size);
  }
  if (offset != length || length != bytes.size()) {
    report.warn(
        "GLB length", "",
        fmt::format("the GLB header declares {} bytes, the file has {}, {} of them in chunks; "
                    "nothing else is read",
                    length, bytes.size(), std::min(offset, bytes.size())));
  }
  container.fileBytes = std::move(hashed);
  return container;
}

}  // namespace

std::vector<uint8_t> readFile(const fs::path& file, const std::string& place, Report& report,
                              uint64_t bytes) {
  std::error_code error;
  const uint64_t size = fs::file_size(file, error);
  const auto named = [&](std::string_view text) {
    return place.empty() ? std::string(text)
                         : fmt::format("file '{}' {}", file.filename().string(), text);
  };
  if (error) report.fail(place, named(fmt::format("cannot be read: {}", error.message())));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) report.fail(place, named(unreadableReason(file)));
  report.takeMemory(place, fmt::format("file '{}'", file.filename().string()),
                    std::min(size, bytes));
  std::vector<uint8_t> content(std::min(size, bytes));
  stream.read(reinterpret_cast<char*>(content.data()),
              static_cast<std::streamsize>(content.size()));
  if (static_cast<uint64_t>(stream.gcount()) != content.size()) {
    report.fail(place,
                named(fmt::format("ended after {} of {} bytes", stream.gcount(), content.size())));
  }
  return content;
}

Container readContainer(const fs::path& file, Report& report) {
  std::error_code error;
  if (!fs::exists(file, error)) report.fail("", unreadableReason(file));
  if (!fs::is_regular_file(file, error)) report.fail("", "is not a regular file");
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".gltf" && extension != ".glb") {
    report.fail("", "not a scene file; .gltf or .glb expected");
  }
  constexpr uint64_t kMaxFileBytes = UINT32_MAX;  // what a GLB's header can say
  const uint64_t size = fs::file_size(file, error);
  if (!error && size > kMaxFileBytes) {
    report.fail("", fmt::format("{} bytes are too many; at most {} are read", size, kMaxFileBytes));
  }
  std::vector<uint8_t> bytes = readFile(file, "", report);
  if (bytes.empty()) report.fail("", "the file is empty");
  const bool isGlb = bytes.size() >= 4 && readU32(bytes, 0) == kMagic;
  if (isGlb) return readGlb(std::move(bytes), report);
  if (extension == ".glb") report.fail("", "does not begin with 'glTF'; not a GLB file");
  Container container;
  container.json = parseJson(
      std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), report);
  container.fileBytes = std::move(bytes);
  return container;
}

}  // namespace restlab::gltf
