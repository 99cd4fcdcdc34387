#include "core/scene/gltf/container.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <set>

#include "core/base/file_reason.h"

namespace restlab::gltf {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little, "glTF data are little-endian");

constexpr uint32_t kMagic = 0x46546c67;      // "glTF"
constexpr uint32_t kChunkJson = 0x4e4f534a;  // "JSON"
constexpr uint32_t kChunkBin = 0x004e4942;   // "BIN\0"
constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr size_t kAlignment = 4;  // bytes, for chunks
// tinygltf takes a 32-bit length. A document nested deeper than any glTF needs is an attack on
// recursive readers.
constexpr uint64_t kMaxJsonBytes = 0x7fffffff;
constexpr int kMaxJsonDepth = 128;

uint32_t readU32(const std::vector<uint8_t>& bytes, size_t offset) {
  uint32_t value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

// Calls visit(i) for every character outside of strings and for the quotes that begin them.
template <class Visit>
void visitStructure(std::string_view text, Visit visit) {
  bool inString = false;
  for (size_t i = 0; i < text.size(); ++i) {
    if (inString) {
      if (text[i] == '\\')
        ++i;
      else if (text[i] == '"')
        inString = false;
    } else {
      inString = text[i] == '"';
      visit(i);
    }
  }
}

void checkDepth(std::string_view text, const Report& report) {
  int depth = 0;
  visitStructure(text, [&](size_t i) {
    if (text[i] == '{' || text[i] == '[') {
      if (++depth > kMaxJsonDepth)
        report.fail("", fmt::format("JSON is nested deeper than {} levels", kMaxJsonDepth));
    } else if (text[i] == '}' || text[i] == ']') {
      --depth;
    }
  });
}

bool isNumberOfJson(std::string_view text) {
  const auto take = [&](std::string_view any) {
    const bool isFound = !text.empty() && any.find(text[0]) != std::string_view::npos;
    text.remove_prefix(isFound ? 1 : 0);
    return isFound;
  };
  const auto takeDigits = [&] {
    const size_t count = std::min(text.find_first_not_of("0123456789"), text.size());
    text.remove_prefix(count);
    return count;
  };
  take("-");
  const bool isZero = text.starts_with('0');
  const size_t whole = takeDigits();
  if (whole == 0 || (isZero && whole > 1)) return false;
  if (take(".") && takeDigits() == 0) return false;
  if (take("eE")) {
    take("+-");
    if (takeDigits() == 0) return false;
  }
  return text.empty();
}

// Returns whether the token is a JSON number too large for a double. Without an exponent such a
// number has 309 digits or more.
bool overflows(std::string_view token) {
  constexpr size_t kFewestDigits = 309;
  if (token.size() < kFewestDigits && token.find_first_of("eE") == std::string_view::npos)
    return false;
  if (!isNumberOfJson(token)) return false;  // the parser reports the error
  try {
    return !nlohmann::json::parse(token).is_number();
  } catch (const nlohmann::json::out_of_range&) {
    return true;
  }
}

// Returns the text with 1e308 in place of numbers too large for a double, or "" if there are none.
// The parser would refuse the whole file, even if nothing reads these numbers; the validator
// refuses them where they are read.
std::string boundNumbers(std::string_view text) {
  std::string bounded;
  size_t copied = 0, start = std::string_view::npos;
  visitStructure(text, [&](size_t i) {
    const bool isOfNumber =
        std::string_view("0123456789+-.eE").find(text[i]) != std::string_view::npos;
    if (isOfNumber) {
      start = std::min(start, i);
      return;
    }
    if (start != std::string_view::npos && overflows(text.substr(start, i - start))) {
      bounded += text.substr(copied, start - copied);
      bounded += text[start] == '-' ? "-1e308" : "1e308";
      copied = i;
    }
    start = std::string_view::npos;
  });
  if (copied != 0) bounded += text.substr(copied);
  return bounded;
}

// Reports keys that stand twice in an object; the parser keeps the last one.
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
  // Keys of the open objects; shared, as the parser copies this callback.
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
  // Worst case: a value of two characters, "0,", becomes a node of 16 bytes.
  report.takeMemory("", fmt::format("JSON of {} bytes", text.size()), text.size() * 8);
  const std::string bounded = boundNumbers(text);
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(bounded.empty() ? text : bounded, DuplicateKeys(report));
  } catch (const nlohmann::json::exception& error) {
    // Remove the label from "[json.exception.parse_error.101] parse error at line 3, column 5:
    // ...".
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

// Header of a chunk, and whether the chunk is complete.
struct ChunkHeader {
  uint32_t size = 0, type = 0;
  bool isWhole = false;
  bool isKnown() const { return type == kChunkJson || type == kChunkBin; }
};

// Returns nullopt if the bytes end before the header does.
std::optional<ChunkHeader> chunkAt(const std::vector<uint8_t>& bytes, size_t offset) {
  if (offset > bytes.size() || bytes.size() - offset < kChunkHeaderBytes) return {};
  const uint32_t size = readU32(bytes, offset);
  return ChunkHeader{size, readU32(bytes, offset + 4),
                     size <= bytes.size() - offset - kChunkHeaderBytes};
}

// Returns whether a complete chunk of a known type begins here.
bool isChunk(const std::vector<uint8_t>& bytes, size_t offset) {
  const auto header = chunkAt(bytes, offset);
  return header && header->isKnown() && header->isWhole;
}

// Finds the start of the chunk after one that ends at `end`. Some writers omit the padding of a
// chunk whose length is not a multiple of 4, and some do not count it in the length.
size_t nextChunk(const std::vector<uint8_t>& bytes, size_t end) {
  const size_t aligned = (end + kAlignment - 1) / kAlignment * kAlignment;
  if (end == aligned || isChunk(bytes, end)) return end;
  return isChunk(bytes, aligned) ? aligned : end;
}

Container readGlb(std::vector<uint8_t> bytes, Report& report) {
  if (bytes.size() < kHeaderBytes) {
    report.fail("", fmt::format("truncated: {}, a GLB header has {}", byteCount(bytes.size()),
                                kHeaderBytes));
  }
  const uint32_t version = readU32(bytes, 4), length = readU32(bytes, 8);
  if (version != 2) report.fail("", fmt::format("GLB version {}; 2 expected", version));
  Container container;
  bool haveJson = false;
  std::vector<uint8_t> hashed(bytes.begin(), bytes.begin() + kHeaderBytes);
  size_t offset = kHeaderBytes;
  // Stop where the header or the file ends, but not before the JSON and BIN chunks.
  const auto goesOn = [&](size_t chunk) {
    if (offset < std::min<size_t>(length, bytes.size())) return true;
    const auto header = chunkAt(bytes, offset);
    return chunk < 2 && header && header->isWhole &&
           header->type == (chunk == 0 ? kChunkJson : kChunkBin);
  };
  const auto failTruncated = [&](const std::string& place, const std::string& text) {
    report.fail(place,
                length > bytes.size()
                    ? fmt::format("truncated: the GLB header declares {} bytes, the file has "
                                  "{}; {}",
                                  length, bytes.size(), text)
                    : "truncated: " + text);
  };
  for (size_t chunk = 0; goesOn(chunk); ++chunk) {
    const std::string place = fmt::format("GLB chunk {}", chunk);
    const size_t left = bytes.size() - offset;
    const auto header = chunkAt(bytes, offset);
    // The JSON chunk is read, so nothing is missing: skip the bytes left.
    if (haveJson && (!header || (!header->isKnown() && !header->isWhole))) {
      report.warn("GLB padding", "",
                  fmt::format("{} behind the last GLB chunk {} skipped", byteCount(left),
                              left == 1 ? "is" : "are"));
      offset = bytes.size();
      break;
    }
    if (!header) {
      failTruncated(
          place, fmt::format("{} left, a chunk header has {}", byteCount(left), kChunkHeaderBytes));
    }
    const auto [size, type, isWhole] = *header;
    offset += kChunkHeaderBytes;
    if (!isWhole) {
      failTruncated(place,
                    fmt::format("declares {}, {} left", byteCount(size), bytes.size() - offset));
    }
    if (size % kAlignment != 0) {
      report.warn("GLB padding", place,
                  fmt::format("has {}; a multiple of {} expected", byteCount(size), kAlignment));
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
  if (!haveJson) report.fail("", "the GLB holds no chunk; a JSON chunk expected");
  if (offset != length || length != bytes.size()) {
    report.warn(
        "GLB length", "",
        fmt::format("the GLB header declares {} bytes, the file has {}, {} of them in chunks; "
                    "nothing else is read",
                    length, bytes.size(), std::min(offset, bytes.size())));
  }
  if (length > bytes.size()) container.missingBytes = length - bytes.size();
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
    report.fail("", "not a scene file; .gltf, .glb, .scene.toml or .xml expected");
  }
  constexpr uint64_t kMaxFileBytes = UINT32_MAX;  // limit of a GLB header
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
