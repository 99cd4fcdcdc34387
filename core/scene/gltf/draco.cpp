#include "core/scene/gltf/draco.h"

#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>

#include "core/scene/gltf/accessor.h"
#include "core/scene/gltf/draco_mesh.h"
#include "core/scene/gltf/json.h"

namespace restlab::gltf {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";

// Limit on the memory that Draco's streams may ask for, in all: so many bytes for each byte
// of the buffers, and some more. Flat and regular meshes take next to no bytes, so that the factor
// is large.
constexpr uint64_t kDracoBytesPerByte = 4096;
constexpr uint64_t kFreeDracoBytes = uint64_t(1) << 28;

class DracoDecoder {
 public:
  DracoDecoder(tinygltf::Model& model, Report& report) : model_(model), report_(report) {
    for (const tinygltf::Mesh& mesh : model.meshes) {
      for (const tinygltf::Primitive& primitive : mesh.primitives) {
        if (dracoOf(primitive)) continue;
        for (const auto& [name, accessor] : primitive.attributes) shared_.insert(accessor);
        shared_.insert(primitive.indices);
      }
    }
    budget_.left = kFreeDracoBytes;
    for (const tinygltf::Buffer& buffer : model.buffers)
      budget_.left += kDracoBytesPerByte * buffer.data.size();
  }

  void decodeAll() {
    for (size_t m = 0; m < model_.meshes.size(); ++m) {
      for (size_t p = 0; p < model_.meshes[m].primitives.size(); ++p) {
        tinygltf::Primitive& primitive = model_.meshes[m].primitives[p];
        if (const tinygltf::Value* extension = dracoOf(primitive))
          decode(primitive, *extension, fmt::format("meshes[{}].primitives[{}]", m, p));
      }
    }
  }

 private:
  // View, indices, and accessor and id of each attribute: what determines the decoded accessors.
  using Key = std::tuple<int, int, std::map<std::string, std::pair<int, int>>>;
  struct Accessors {
    int indices = -1;
    std::map<std::string, int> attributes;
  };

  static const tinygltf::Value* dracoOf(const tinygltf::Primitive& primitive) {
    const auto found = primitive.extensions.find(kDraco);
    return found == primitive.extensions.end() ? nullptr : &found->second;
  }

  static int viewOf(const tinygltf::Value& extension) {
    return extension.Get("bufferView").GetNumberAsInt();
  }

  DracoTarget targetOf(int accessorIndex, const std::string& place) const {
    const tinygltf::Accessor& accessor = model_.accessors[static_cast<size_t>(accessorIndex)];
    DracoTarget target;
    target.place = place;
    target.accessor = fmt::format("accessors[{}]", accessorIndex);
    target.componentType = accessor.componentType;
    target.componentBytes = static_cast<size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor.componentType)));
    target.components =
        static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)));
    target.count = accessor.count;
    target.normalized = accessor.normalized;
    return target;
  }

  void decode(tinygltf::Primitive& primitive, const tinygltf::Value& extension,
              const std::string& place) {
    const std::string extensionPlace = fmt::format("{}.extensions.{}", place, kDraco);
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES) {
      report_.fail(place + ".mode", fmt::format("{} is not read beside {}; 4, a list of triangles, "
                                                "expected",
                                                primitive.mode, kDraco));
    }
    if (extension.Has("indices")) primitive.indices = extension.Get("indices").GetNumberAsInt();
    if (primitive.indices < 0) {
      report_.fail(place,
                   fmt::format("has no indices; an accessor for those of {} expected", kDraco));
    }
    const tinygltf::Value& ids = extension.Get("attributes");
    std::map<std::string, std::pair<int, int>> accessorAndId;
    for (const std::string& name : ids.Keys()) {
      const auto found = primitive.attributes.find(name);
      if (found == primitive.attributes.end()) {
        report_.fail(extensionPlace + ".attributes." + name,
                     "is not an attribute of the primitive; an accessor for it expected there");
      }
      accessorAndId[name] = {found->second, ids.Get(name).GetNumberAsInt()};
    }
    if (accessorAndId.empty()) {
      report_.fail(extensionPlace + ".attributes", "is empty; at least POSITION expected");
    }
    const Key key(viewOf(extension), primitive.indices, accessorAndId);
    auto known = decoded_.find(key);
    if (known == decoded_.end())
      known = decoded_.emplace(key, decodeNew(key, place, extensionPlace)).first;
    primitive.indices = known->second.indices;
    for (const auto& [name, accessor] : known->second.attributes)
      primitive.attributes[name] = accessor;
  }

  Accessors decodeNew(const Key& key, const std::string& place, const std::string& extensionPlace) {
    const auto& [viewIndex, indices, accessorAndId] = key;
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<size_t>(viewIndex)];
    const tinygltf::Buffer& buffer = model_.buffers[static_cast<size_t>(view.buffer)];
    DracoRequest request;
    request.bytes = buffer.data.data() + view.byteOffset;
    request.size = view.byteLength;
    request.place = extensionPlace;
    request.source = fmt::format("bufferViews[{}]", viewIndex);
    request.indices = targetOf(indices, place + ".indices");
    if (request.indices.components != 1 ||
        request.indices.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) {
      report_.fail(request.indices.place,
                   fmt::format("accessors[{}] is {}; unsigned integer scalars expected", indices,
                               formatOf(model_.accessors[static_cast<size_t>(indices)])));
    }
    for (const auto& [name, one] : accessorAndId) {
      request.attributes.push_back(targetOf(one.first, extensionPlace + ".attributes." + name));
      request.attributes.back().id = static_cast<uint32_t>(one.second);
    }
    DracoElements elements = decodeDracoMesh(request, budget_, report_);

    const int newBuffer = static_cast<int>(model_.buffers.size());
    Accessors accessors;
    accessors.indices = pointTo(indices, request.indices, newBuffer, elements.indices);
    size_t i = 0;
    for (const auto& [name, one] : accessorAndId) {
      accessors.attributes[name] =
          pointTo(one.first, request.attributes[i], newBuffer, elements.attributes[i]);
      ++i;
    }
    model_.buffers.emplace_back();
    model_.buffers.back().data = std::move(elements.bytes);
    return accessors;
  }

  // Makes the accessor, or a copy of it, refer to decoded elements; returns its index.
  int pointTo(int accessorIndex, const DracoTarget& target, int buffer, size_t offset) {
    tinygltf::BufferView view;
    view.buffer = buffer;
    view.byteOffset = offset;
    view.byteLength = target.count * target.elementBytes();
    model_.bufferViews.push_back(view);
    int used = accessorIndex;
    if (!shared_.insert(accessorIndex).second) {
      used = static_cast<int>(model_.accessors.size());
      model_.accessors.push_back(model_.accessors[static_cast<size_t>(accessorIndex)]);
    }
    tinygltf::Accessor& accessor = model_.accessors[static_cast<size_t>(used)];
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    accessor.byteOffset = 0;
    return used;
  }

  tinygltf::Model& model_;
  Report& report_;
  DracoBudget budget_;
  std::set<int> shared_;  // accessors that hold something else, or are decoded already
  std::map<Key, Accessors> decoded_;
};

}  // namespace

void hideDracoIndices(nlohmann::json& document) {
  const size_t meshes = arrayOf(document, "meshes").size();
  for (size_t m = 0; m < meshes; ++m) {
    for (nlohmann::json& primitive : document["meshes"][m]["primitives"]) {
      const auto extensions = primitive.find("extensions");
      if (extensions == primitive.end() || !extensions->contains(kDraco)) continue;
      nlohmann::json& draco = (*extensions)[kDraco];
      draco.erase("indices");  // no property of the extension
      if (!primitive.contains("indices")) continue;
      draco["indices"] = primitive["indices"];
      primitive.erase("indices");
    }
  }
}

void decodeDraco(tinygltf::Model& model, Report& report) {
  DracoDecoder(model, report).decodeAll();
}

}  // namespace restlab::gltf
