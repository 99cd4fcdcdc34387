#include "core/scene/gltf/draco_mesh.h"

#include <draco/compression/config/compression_shared.h>
#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <stdexcept>

#include "core/scene/gltf/tinygltf.h"

namespace restlab::gltf {
namespace {

// Bytes that the connectivity of a mesh takes while it is decoded, for each corner and for each set
// of seams, and the traversal of a corner by each decoder of attributes: twice what was measured
// (docs/decisions/hostile-draco-streams.md).
constexpr uint64_t kBytesPerCorner = 16;
constexpr uint64_t kBytesPerTraversal = 8;

// Counts that a stream claims before its connectivity is decoded.
struct DracoClaim {
  uint64_t triangles = 0;
  uint64_t points = 0;    // 0: not known yet
  uint64_t seamSets = 0;  // connectivities of attributes
};

// Checks what a stream claims, as far as it is read, against the request and the budget.
class DracoBounds {
 public:
  DracoBounds(const DracoRequest& request, DracoBudget& budget, Report& report)
      : request_(request), budget_(budget), report_(report) {}

  void checkConnectivity(const DracoClaim& claim) {
    if (3 * claim.triangles != request_.indices.count) {
      report_.fail(
          request_.indices.place,
          fmt::format("{} has {} elements, but the Draco mesh has {} indices; the same "
                      "number expected",
                      request_.indices.accessor, request_.indices.count, 3 * claim.triangles));
    }
    if (claim.points != 0) checkPoints(claim.points);
    take(3 * claim.triangles * kBytesPerCorner * (1 + claim.seamSets));
  }

  void checkAttributes(const draco::PointCloud& cloud, uint64_t decoders) {
    checkPoints(cloud.num_points());
    uint64_t bytes = 0;  // of a point
    for (int i = 0; i < cloud.num_attributes(); ++i) {
      const uint64_t components = cloud.attribute(i)->num_components();
      const int value = draco::DataTypeLength(cloud.attribute(i)->data_type());
      // Quantised values, the values themselves, and the place of each.
      bytes += components * (sizeof(uint32_t) + (value > 0 ? uint64_t(value) : 1)) + 4;
    }
    take(cloud.num_points() * bytes + request_.indices.count * decoders * kBytesPerTraversal);
    for (const DracoTarget& target : request_.attributes) checkAttribute(cloud, target);
  }

  [[noreturn]] void failDamaged(const std::string& why) const {
    report_.fail(request_.place,
                 fmt::format("the Draco mesh in {} is damaged{}{}{}", request_.source,
                             why.empty() ? "" : " (", why, why.empty() ? "" : ")"));
  }

 private:
  void checkPoints(uint64_t points) const {
    for (const DracoTarget& target : request_.attributes) {
      if (target.count == points) continue;
      report_.fail(target.place,
                   fmt::format("{} has {} elements, but the Draco mesh has {} vertices; the same "
                               "number expected",
                               target.accessor, target.count, points));
    }
  }

  void checkAttribute(const draco::PointCloud& cloud, const DracoTarget& target) const {
    const draco::PointAttribute* attribute = cloud.GetAttributeByUniqueId(target.id);
    if (!attribute) {
      std::string ids;
      for (int i = 0; i < cloud.num_attributes() && i < 16; ++i)
        ids += fmt::format("{}{}", i == 0 ? "" : ", ", cloud.attribute(i)->unique_id());
      report_.fail(target.place,
                   fmt::format("{} is not the id of an attribute of the Draco mesh{}", target.id,
                               ids.empty() ? ", which has none" : "; one of " + ids + " expected"));
    }
    if (attribute->num_components() != target.components) {
      report_.fail(target.place,
                   fmt::format("{} has {} components, but attribute {} of the Draco mesh has {}",
                               target.accessor, target.components, target.id,
                               int(attribute->num_components())));
    }
    const draco::DataType type = attribute->data_type();
    const bool isFloat = type == draco::DT_FLOAT32;
    const bool isInteger = type >= draco::DT_INT8 && type <= draco::DT_UINT32;
    const bool wantsFloat = target.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    const bool sameWidth = size_t(draco::DataTypeLength(type)) == target.componentBytes;
    if (wantsFloat ? isFloat : isInteger && (sameWidth || !target.normalized)) return;
    report_.fail(
        target.place,
        fmt::format("{} cannot hold attribute {} of the Draco mesh, which has another "
                    "component type ({})",
                    target.accessor, target.id,
                    isFloat     ? "float"
                    : isInteger ? fmt::format("integer of {} bytes", draco::DataTypeLength(type))
                                : "none that glTF has"));
  }

  void take(uint64_t bytes) {
    if (bytes > budget_.left) {
      report_.fail(request_.place,
                   fmt::format("decoding the Draco mesh in {} takes {} more bytes, of {} that are "
                               "left for streams of this size",
                               request_.source, bytes, budget_.left));
    }
    budget_.left -= bytes;
    report_.takeMemory(request_.place, "the Draco mesh", bytes);
  }

  const DracoRequest& request_;
  DracoBudget& budget_;
  Report& report_;
};

bool peekClaim(draco::DecoderBuffer buffer, const draco::MeshSequentialDecoder&,
               DracoClaim& claim) {
  uint32_t triangles = 0, points = 0;
  if (!draco::DecodeVarint(&triangles, &buffer) || !draco::DecodeVarint(&points, &buffer))
    return false;
  claim.triangles = triangles;
  claim.points = points;
  return points != 0;
}

bool peekClaim(draco::DecoderBuffer buffer, const draco::MeshEdgebreakerDecoder&,
               DracoClaim& claim) {
  uint32_t vertices = 0, triangles = 0, symbols = 0, splits = 0;
  uint8_t seamSets = 0;
  if (!draco::DecodeVarint(&vertices, &buffer) || !draco::DecodeVarint(&triangles, &buffer) ||
      !buffer.Decode(&seamSets) || !draco::DecodeVarint(&symbols, &buffer) ||
      !draco::DecodeVarint(&splits, &buffer))
    return false;
  claim.triangles = triangles;
  claim.seamSets = seamSets;
  return vertices <= 3 * claim.triangles && symbols <= triangles && splits <= symbols;
}

// A decoder of Draco that stops where a stream claims more than it should, before it allocates.
template <class Decoder>
class BoundedDecoder : public Decoder {
 public:
  explicit BoundedDecoder(DracoBounds& bounds) : bounds_(bounds) {}

 protected:
  bool DecodeConnectivity() override {
    DracoClaim claim;
    if (!peekClaim(*this->buffer(), *this, claim)) return false;
    bounds_.checkConnectivity(claim);
    return Decoder::DecodeConnectivity();
  }

  bool DecodeAllAttributes() override {
    bounds_.checkAttributes(*this->point_cloud(), uint64_t(this->num_attributes_decoders()));
    return Decoder::DecodeAllAttributes();
  }

 private:
  DracoBounds& bounds_;
};

template <class Decoder>
void decodeBy(const DracoRequest& request, DracoBounds& bounds, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(request.bytes), request.size);
  BoundedDecoder<Decoder> decoder(bounds);
  const draco::DecoderOptions options;
  std::string problem;
  try {
    const draco::Status status = decoder.Decode(options, &buffer, &mesh);
    if (status.ok()) return;
    problem = status.error_msg_string();
  } catch (const std::length_error&) {  // a vector of Draco that no memory could hold
    problem = "a length that no memory holds";
  }
  while (!problem.empty() && problem.back() == '.') problem.pop_back();
  bounds.failDamaged(problem);
}

// Copies the elements of an attribute, point by point.
template <class T>
bool copyValues(const draco::PointAttribute& attribute, const DracoTarget& target, uint8_t* out) {
  constexpr size_t kMost = 16;
  if (target.components > kMost) return false;
  T element[kMost];
  for (uint32_t point = 0; point < target.count; ++point) {
    const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(point));
    if (value.value() >= attribute.size()) return false;
    if (!attribute.ConvertValue<T>(value, int8_t(target.components), element)) return false;
    std::memcpy(out + point * target.elementBytes(), element, target.elementBytes());
  }
  return true;
}

bool copyAttribute(const draco::PointAttribute& attribute, const DracoTarget& target,
                   uint8_t* out) {
  switch (target.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return copyValues<int8_t>(attribute, target, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return copyValues<uint8_t>(attribute, target, out);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return copyValues<int16_t>(attribute, target, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return copyValues<uint16_t>(attribute, target, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return copyValues<uint32_t>(attribute, target, out);
    default:
      return copyValues<float>(attribute, target, out);
  }
}

void copyIndices(const draco::Mesh& mesh, const DracoRequest& request, uint8_t* out,
                 Report& report) {
  const DracoTarget& target = request.indices;
  const uint64_t largest = (uint64_t(1) << (8 * target.componentBytes)) - 1;
  for (uint32_t triangle = 0; triangle < mesh.num_faces(); ++triangle) {
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(triangle))) {
      const uint32_t index = corner.value();
      if (index > largest) {
        report.fail(target.place,
                    fmt::format("{} cannot hold the index {} of the Draco mesh; integers of more "
                                "bytes expected",
                                target.accessor, index));
      }
      std::memcpy(out, &index, target.componentBytes);  // little-endian, as glTF
      out += target.componentBytes;
    }
  }
}

// Adds room for the elements of a target; returns where it begins.
size_t addRoom(const DracoTarget& target, size_t& bytes) {
  const size_t begin = (bytes + 3) / 4 * 4;
  bytes = begin + target.count * target.elementBytes();
  return begin;
}

void checkDracoHeader(const DracoRequest& request, const DracoBounds& bounds, Report& report,
                      draco::DracoHeader& header) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(request.bytes), request.size);
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok())
    bounds.failDamaged("it does not begin with a header");
  if (header.encoder_type != draco::TRIANGULAR_MESH) {
    report.fail(request.place,
                fmt::format("{} holds {}; a mesh expected", request.source,
                            header.encoder_type == draco::POINT_CLOUD ? "a Draco point cloud"
                                                                      : "no Draco mesh"));
  }
  if (header.version_major != 2 || header.version_minor != 2) {
    report.fail(request.place,
                fmt::format("the Draco mesh in {} has version {}.{} of the bitstream; 2.2 expected",
                            request.source, header.version_major, header.version_minor));
  }
}

}  // namespace

DracoElements decodeDracoMesh(const DracoRequest& request, DracoBudget& budget, Report& report) {
  DracoBounds bounds(request, budget, report);
  draco::DracoHeader header;
  checkDracoHeader(request, bounds, report, header);
  draco::Mesh mesh;
  if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
    decodeBy<draco::MeshSequentialDecoder>(request, bounds, mesh);
  } else if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    decodeBy<draco::MeshEdgebreakerDecoder>(request, bounds, mesh);
  } else {
    bounds.failDamaged("an encoding that does not exist");
  }
  if (3 * uint64_t(mesh.num_faces()) != request.indices.count)
    bounds.failDamaged("its triangles are fewer than it says");

  DracoElements elements;
  size_t bytes = 0;
  elements.indices = addRoom(request.indices, bytes);
  for (const DracoTarget& target : request.attributes)
    elements.attributes.push_back(addRoom(target, bytes));
  report.takeMemory(request.place, "the decoded mesh", bytes);
  elements.bytes.resize(bytes);
  copyIndices(mesh, request, elements.bytes.data() + elements.indices, report);
  for (size_t i = 0; i < request.attributes.size(); ++i) {
    const DracoTarget& target = request.attributes[i];
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(target.id);
    if (!attribute ||
        !copyAttribute(*attribute, target, elements.bytes.data() + elements.attributes[i])) {
      report.fail(target.place, fmt::format("{} cannot hold the values of attribute {} of the "
                                            "Draco mesh",
                                            target.accessor, target.id));
    }
  }
  return elements;
}

}  // namespace restlab::gltf
