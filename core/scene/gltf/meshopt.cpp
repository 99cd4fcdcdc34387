#include "core/scene/gltf/meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <cstring>
#include <string>
#include <utility>

#include "core/scene/gltf/json.h"

namespace restlab::gltf {
namespace {

using nlohmann::json;

constexpr const char* kMeshopt = "EXT_meshopt_compression";

// Limit on the decoded bytes of a stream and of all streams, as a multiple of the compressed ones:
// no stream of this format is denser (two bits for 16 bytes).
constexpr uint64_t kMaxMeshoptRatio = 64;
constexpr uint64_t kFreeMeshoptBytes = uint64_t(1) << 26;  // views may share a stream
constexpr int kTooLargeIndex = 1;  // beside the library's own results, 0 and negative ones

const json* meshoptOf(const json& object) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end()) return nullptr;
  const auto found = extensions->find(kMeshopt);
  return found == extensions->end() ? nullptr : &*found;
}

std::string placeOfStream(size_t view) {
  return fmt::format("bufferViews[{}].extensions.{}", view, kMeshopt);
}

// How the bytes of a view are compressed.
struct MeshoptStream {
  explicit MeshoptStream(const json& extension)
      : buffer(extension.at("buffer").get<uint64_t>()),
        offset(sizeOf(extension, "byteOffset", 0)),
        length(extension.at("byteLength").get<uint64_t>()),
        stride(extension.at("byteStride").get<uint64_t>()),
        count(extension.at("count").get<uint64_t>()),
        mode(extension.at("mode").get<std::string>()),
        filter(extension.contains("filter") ? extension.at("filter").get<std::string>() : "NONE") {}

  uint64_t decodedBytes() const { return stride * count; }  // below 2^62

  size_t buffer;
  uint64_t offset, length, stride, count;
  std::string mode, filter;
};

void checkMode(const MeshoptStream& stream, const std::string& place, Report& report) {
  const auto failStride = [&](const char* what, const char* expected) {
    report.fail(place + ".byteStride",
                fmt::format("{} is not valid for {}; {} expected", stream.stride, what, expected));
  };
  if (stream.mode == "ATTRIBUTES") {
    if (stream.stride % 4 != 0) failStride("mode ATTRIBUTES", "a multiple of 4 up to 256");
  } else {
    if (stream.stride != 2 && stream.stride != 4)
      failStride(("mode " + stream.mode).c_str(), "2 or 4");
    if (stream.mode == "TRIANGLES" && stream.count % 3 != 0) {
      report.fail(place + ".count", fmt::format("{} is not valid for mode TRIANGLES; a multiple of "
                                                "3 expected",
                                                stream.count));
    }
    if (stream.filter != "NONE") {
      report.fail(place + ".filter", fmt::format("{} is not valid for mode {}; NONE expected",
                                                 stream.filter, stream.mode));
    }
  }
  if (stream.filter == "OCTAHEDRAL" && stream.stride != 4 && stream.stride != 8)
    failStride("filter OCTAHEDRAL", "4 or 8");
  if (stream.filter == "QUATERNION" && stream.stride != 8) failStride("filter QUATERNION", "8");
}

void checkStream(const json& view, const MeshoptStream& stream, const json& buffers,
                 const std::string& place, const std::string& viewPlace, Report& report) {
  if (isMeshoptFallback(buffers[stream.buffer])) {
    report.fail(place + ".buffer",
                fmt::format("buffers[{}] is a fallback, which is not loaded; the buffer of the "
                            "compressed bytes expected",
                            stream.buffer));
  }
  const uint64_t available = buffers[stream.buffer].at("byteLength").get<uint64_t>();
  if (stream.offset > available || stream.length > available - stream.offset) {
    report.fail(place,
                fmt::format("bytes {} to {} reach beyond buffers[{}], which has {}", stream.offset,
                            stream.offset + stream.length, stream.buffer, byteCount(available)));
  }
  checkMode(stream, place, report);
  const uint64_t length = view.at("byteLength").get<uint64_t>();
  if (length != stream.decodedBytes()) {
    report.fail(viewPlace + ".byteLength",
                fmt::format("{}, but its compressed bytes are {} elements of {} bytes; {} expected",
                            length, stream.count, stream.stride, stream.decodedBytes()));
  }
  const uint64_t stride = sizeOf(view, "byteStride", stream.stride);
  if (stride != stream.stride) {
    report.fail(viewPlace + ".byteStride",
                fmt::format("{}, but its compressed elements have {} bytes; the same expected",
                            stride, stream.stride));
  }
  if (stream.decodedBytes() / kMaxMeshoptRatio > stream.length) {
    report.fail(place, fmt::format("{} decoded bytes of {} compressed ones; at most {} times as "
                                   "many fit into this format",
                                   stream.decodedBytes(), stream.length, kMaxMeshoptRatio));
  }
}

// Indices as 32 bits: the library would cut them to 16 without a word.
int decodeIndices(const MeshoptStream& stream, const uint8_t* bytes,
                  std::vector<uint8_t>& decoded) {
  std::vector<uint32_t> indices(stream.count);
  const int result =
      stream.mode == "TRIANGLES"
          ? meshopt_decodeIndexBuffer(indices.data(), stream.count, 4, bytes, stream.length)
          : meshopt_decodeIndexSequence(indices.data(), stream.count, 4, bytes, stream.length);
  if (result != 0) return result;
  for (size_t i = 0; i < indices.size(); ++i) {
    if (stream.stride == 2 && indices[i] > 0xffffu) return kTooLargeIndex;
    std::memcpy(decoded.data() + i * stream.stride, &indices[i], stream.stride);
  }
  return 0;
}

int decodeStream(const MeshoptStream& stream, const uint8_t* bytes, std::vector<uint8_t>& decoded) {
  const size_t count = stream.count, stride = stream.stride, length = stream.length;
  if (stream.mode != "ATTRIBUTES") return decodeIndices(stream, bytes, decoded);
  const int result = meshopt_decodeVertexBuffer(decoded.data(), count, stride, bytes, length);
  if (result != 0) return result;
  if (stream.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), count, stride);
  if (stream.filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), count, stride);
  if (stream.filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), count, stride);
  return 0;
}

// The first byte of a stream names its kind and the version of the format; the extension has one
// version of each, the library reads more.
void checkFirstByte(const MeshoptStream& stream, uint8_t found, const std::string& place,
                    Report& report) {
  const int expected = stream.mode == "ATTRIBUTES"  ? 0xa0
                       : stream.mode == "TRIANGLES" ? 0xe1
                                                    : 0xd1;
  if (found == expected) return;
  report.fail(place, fmt::format("the stream begins with the byte {:#04x}; {:#04x} expected for "
                                 "mode {}",
                                 int(found), expected, stream.mode));
}

}  // namespace

bool isMeshoptFallback(const json& buffer) {
  const json* extension = meshoptOf(buffer);
  if (!extension) return false;
  const auto fallback = extension->find("fallback");
  return fallback != extension->end() && fallback->get<bool>();
}

void checkMeshopt(const json& document, Report& report) {
  const json& buffers = arrayOf(document, "buffers");
  const json& views = arrayOf(document, "bufferViews");
  uint64_t loaded = 0, decoded = 0;
  for (const json& buffer : buffers)
    if (!isMeshoptFallback(buffer)) loaded += buffer.at("byteLength").get<uint64_t>();
  const uint64_t allowed = kMaxMeshoptRatio * loaded + kFreeMeshoptBytes;
  for (size_t i = 0; i < views.size(); ++i) {
    const std::string viewPlace = fmt::format("bufferViews[{}]", i);
    const json* extension = meshoptOf(views[i]);
    if (!extension) {
      const uint64_t buffer = views[i].at("buffer").get<uint64_t>();
      if (!isMeshoptFallback(buffers[buffer])) continue;
      report.fail(viewPlace,
                  fmt::format("lies in buffers[{}], a fallback, which is not loaded, but has no {}",
                              buffer, kMeshopt));
    }
    const MeshoptStream stream(*extension);
    checkStream(views[i], stream, buffers, placeOfStream(i), viewPlace, report);
    decoded += stream.decodedBytes();
    if (decoded > allowed) {
      report.fail(placeOfStream(i),
                  fmt::format("with those before it decodes to {} bytes, of {} in all buffers; at "
                              "most {} are decoded",
                              decoded, loaded, allowed));
    }
  }
}

void decodeMeshopt(json& document, std::vector<std::vector<uint8_t>>& buffers, Report& report) {
  const size_t viewCount = arrayOf(document, "bufferViews").size();
  for (size_t i = 0; i < viewCount; ++i) {
    json& view = document["bufferViews"][i];
    const json* extension = meshoptOf(view);
    if (!extension) continue;
    const MeshoptStream stream(*extension);
    const std::string place = placeOfStream(i);
    const uint8_t* bytes = buffers[stream.buffer].data() + stream.offset;
    checkFirstByte(stream, bytes[0], place, report);
    report.takeMemory(place, fmt::format("{} decoded bytes", stream.decodedBytes()),
                      stream.decodedBytes());
    std::vector<uint8_t> decoded(stream.decodedBytes());
    const int result = decodeStream(stream, bytes, decoded);
    if (result == kTooLargeIndex)
      report.fail(place, "holds an index above 65535, in elements of 2 bytes; 4 bytes expected");
    if (result != 0) {
      report.fail(place, fmt::format("{} bytes, which are not a stream of {} elements of {} bytes "
                                     "in mode {}; the file is damaged",
                                     stream.length, stream.count, stream.stride, stream.mode));
    }
    view["extensions"].erase(kMeshopt);
    view["buffer"] = buffers.size();
    view["byteOffset"] = uint64_t(0);
    document["buffers"].push_back({{"byteLength", stream.decodedBytes()}});
    buffers.push_back(std::move(decoded));
  }
}

}  // namespace restlab::gltf
