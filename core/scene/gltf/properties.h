// Values of an extension's object, and the textures that it names.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/gltf/texture.h"

namespace restlab::gltf {

// Numbers of an extension's object; absent numbers get the caller's default.
class Properties {
 public:
  Properties(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto it = extensions.find(name);
    if (it != extensions.end()) value_ = &it->second;
  }
  bool present() const { return value_ != nullptr; }
  double number(const char* name, double otherwise) const {
    return has(name) ? value_->Get(name).GetNumberAsDouble() : otherwise;
  }
  glm::dvec3 color(const char* name, glm::dvec3 otherwise) const {
    if (!has(name)) return otherwise;
    const tinygltf::Value& array = value_->Get(name);
    return {array.Get(0).GetNumberAsDouble(), array.Get(1).GetNumberAsDouble(),
            array.Get(2).GetNumberAsDouble()};
  }
  // A number of an object of the extension's.
  double numberOf(const char* object, const char* name, double otherwise) const {
    if (!has(object) || !value_->Get(object).Has(name)) return otherwise;
    return value_->Get(object).Get(name).GetNumberAsDouble();
  }
  bool has(const char* name) const { return value_ && value_->Has(name); }
  TextureReference texture(const char* name) const {
    TextureReference reference;
    if (!has(name)) return reference;
    const tinygltf::Value& info = value_->Get(name);
    reference.index = info.Get("index").GetNumberAsInt();
    if (info.Has("texCoord")) reference.texCoord = info.Get("texCoord").GetNumberAsInt();
    if (info.Has("extensions")) {
      reference.ownedExtensions = info.Get("extensions").Get<tinygltf::Value::Object>();
    }
    return reference;
  }

 private:
  const tinygltf::Value* value_ = nullptr;
};

}  // namespace restlab::gltf
