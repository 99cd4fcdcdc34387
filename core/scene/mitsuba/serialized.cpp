#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/scene/mitsuba/mesh_files.h"

namespace restlab::mitsuba {
namespace {

constexpr uint16_t kMagic = 0x041c;
constexpr uint32_t kHasNormals = 1u, kHasUvs = 2u, kHasColors = 8u, kFaceNormals = 16u,
                   kIsDouble = 0x2000u;
// No stream of deflate becomes longer than this many times its bytes.
constexpr uint64_t kMostExpansion = 1032;
constexpr size_t kMostNameBytes = 65536;

// Inflates a stream piece by piece: nothing is allocated by what it claims.
class Inflated {
 public:
  Inflated(const uint8_t* bytes, size_t count, const std::string& place, const Report& report)
      : place_(place), report_(report), count_(count) {
    stream_.next_in = const_cast<Bytef*>(bytes);
    stream_.avail_in = uInt(std::min<size_t>(count, 0xffffffffu));
    if (inflateInit(&stream_) != Z_OK) report_.fail(place_, "zlib does not start");
  }
  ~Inflated() { inflateEnd(&stream_); }
  Inflated(const Inflated&) = delete;
  Inflated& operator=(const Inflated&) = delete;

  void read(void* into, size_t count) {
    stream_.next_out = static_cast<Bytef*>(into);
    stream_.avail_out = uInt(count);
    while (stream_.avail_out > 0) {
      const int result = inflate(&stream_, Z_NO_FLUSH);
      if (result == Z_STREAM_END && stream_.avail_out == 0) break;
      if (result != Z_OK) {
        report_.fail(place_, result == Z_STREAM_END || result == Z_BUF_ERROR
                                 ? "the compressed data end early"
                                 : "the compressed data are damaged");
      }
    }
    taken_ += count;
  }
  template <class T>
  T one() {
    T value;
    read(&value, sizeof value);
    return value;
  }
  // The most bytes that may still come.
  uint64_t left() const {
    return kMostExpansion * count_ + 65536 - std::min(taken_, kMostExpansion * count_);
  }

 private:
  z_stream stream_{};
  const std::string& place_;
  const Report& report_;
  size_t count_;
  uint64_t taken_ = 0;
};

class SerializedReader {
 public:
  SerializedReader(const Bytes& bytes, size_t shape, const std::string& file, Report& report)
      : bytes_(bytes),
        shape_(shape),
        place_(fmt::format("{}: shape {}", file, shape)),
        report_(report) {}

  MeshGeometry read() {
    const auto [begin, end] = range();
    uint16_t head[2];
    if (end - begin < sizeof head) report_.fail(place_, "ends within its header");
    std::memcpy(head, bytes_.data() + begin, sizeof head);
    if (head[0] != kMagic)
      report_.fail(place_, fmt::format("begins with {:#06x}; {:#06x} expected", head[0], kMagic));
    if (head[1] != 3 && head[1] != 4)
      report_.fail(place_, fmt::format("version {}; 3 or 4 expected", head[1]));
    Inflated data(bytes_.data() + begin + sizeof head, end - begin - sizeof head, place_, report_);
    return readMesh(data, head[1]);
  }

 private:
  template <class T>
  T at(size_t offset) const {
    T value;
    std::memcpy(&value, bytes_.data() + offset, sizeof value);
    return value;
  }

  // The bytes of the shape, by the table at the end: an offset of each shape, then their number.
  std::pair<size_t, size_t> range() const {
    if (bytes_.size() < 8) report_.fail(place_, "the file ends within its header");
    const bool isWide = at<uint16_t>(2) == 4;
    const size_t width = isWide ? 8 : 4;
    const uint64_t count = at<uint32_t>(bytes_.size() - 4);
    if (count == 0 || count > (bytes_.size() - 4) / width)
      report_.fail(place_,
                   fmt::format("the file claims {} shapes in {} bytes", count, bytes_.size()));
    if (shape_ >= count)
      report_.fail(place_, fmt::format("does not exist; the file has {}", count));
    const size_t table = bytes_.size() - 4 - size_t(count) * width;
    const auto offset = [&](uint64_t i) {
      if (i == count) return uint64_t(table);
      const size_t entry = table + size_t(i) * width;
      return isWide ? at<uint64_t>(entry) : uint64_t(at<uint32_t>(entry));
    };
    const uint64_t begin = offset(shape_), end = offset(shape_ + 1);
    if (!(begin < end && end <= table))
      report_.fail(place_, fmt::format("its offsets {} to {} do not lie in the file", begin, end));
    return {size_t(begin), size_t(end)};
  }

  template <class T, class V>
  void readVectors(Inflated& data, uint64_t count, std::vector<V>& into) {
    constexpr int kLength = V::length();
    constexpr size_t kBlock = 4096;
    std::vector<T> block(kBlock * size_t(kLength));
    for (uint64_t done = 0; done < count;) {
      const size_t now = size_t(std::min<uint64_t>(kBlock, count - done));
      data.read(block.data(), now * kLength * sizeof(T));
      for (size_t i = 0; i < now; ++i) {
        V v;
        for (int c = 0; c < kLength; ++c)
          v[c] = static_cast<typename V::value_type>(block[i * kLength + size_t(c)]);
        into.push_back(v);
      }
      done += now;
    }
  }
  template <class V>
  void readFloats(Inflated& data, uint64_t count, bool isDouble, std::vector<V>& into) {
    if (isDouble) return readVectors<double>(data, count, into);
    readVectors<float>(data, count, into);
  }

  void readIndices(Inflated& data, uint64_t count, uint64_t vertices, MeshGeometry& mesh) {
    for (uint64_t i = 0; i < count; ++i) {
      const glm::uvec3 t = data.one<glm::uvec3>();
      for (int c = 0; c < 3; ++c)
        if (t[c] >= vertices)
          report_.fail(place_,
                       fmt::format("triangle {} names vertex {}; there are {}", i, t[c], vertices));
      mesh.triangles.push_back(t);
    }
  }

  void readName(Inflated& data, std::string& name) {
    for (char c = data.one<char>(); c != '\0'; c = data.one<char>()) {
      if (name.size() >= kMostNameBytes)
        report_.fail(place_, fmt::format("its name has more than {} bytes", kMostNameBytes));
      name += c;
    }
  }

  MeshGeometry readMesh(Inflated& data, uint16_t version) {
    const uint32_t flags = data.one<uint32_t>();
    MeshGeometry mesh;
    if (version == 4) readName(data, mesh.name);
    const uint64_t vertices = data.one<uint64_t>(), triangles = data.one<uint64_t>();
    const bool isDouble = (flags & kIsDouble) != 0;
    const uint64_t bytesOfVertex =
        (isDouble ? 8u : 4u) *
        (3u + ((flags & kHasNormals) != 0 ? 3u : 0u) + ((flags & kHasUvs) != 0 ? 2u : 0u) +
         ((flags & kHasColors) != 0 ? 3u : 0u));
    const uint64_t left = data.left();
    if (vertices >= rl::RL_INVALID || vertices > left / bytesOfVertex || triangles > left / 12)
      report_.fail(place_,
                   fmt::format("claims {} vertices and {} triangles, more than its bytes can "
                               "hold",
                               vertices, triangles));
    report_.takeMemory(place_, 64 * vertices + 12 * triangles);
    readFloats(data, vertices, isDouble, mesh.positions);
    if ((flags & kHasNormals) != 0) readFloats(data, vertices, isDouble, mesh.normals);
    if ((flags & kHasUvs) != 0) readFloats(data, vertices, isDouble, mesh.uvs[0]);
    std::vector<glm::vec3> colors;
    if ((flags & kHasColors) != 0) readFloats(data, vertices, isDouble, colors);
    readIndices(data, triangles, vertices, mesh);
    if ((flags & kFaceNormals) != 0) mesh.normals.clear();
    checkMesh(mesh, place_, report_);
    return mesh;
  }

  const Bytes& bytes_;
  size_t shape_;
  std::string place_;
  Report& report_;
};

}  // namespace

MeshGeometry readSerialized(const Bytes& bytes, size_t shape, const std::string& file,
                            Report& report) {
  return SerializedReader(bytes, shape, file, report).read();
}

}  // namespace restlab::mitsuba
