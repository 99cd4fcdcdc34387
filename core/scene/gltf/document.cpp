#include "core/scene/gltf/document.h"

#include <fmt/format.h>

#include "core/scene/content_hash.h"
#include "core/scene/gltf/draco.h"
#include "core/scene/gltf/files.h"
#include "core/scene/gltf/json.h"
#include "core/scene/gltf/meshopt.h"
#include "core/scene/gltf/uri.h"

namespace restlab::gltf {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr uint64_t kMaxImageBytes = 0x7fffffff;  // tinygltf passes image sizes as int

void checkMediaType(const std::string& found, const std::vector<std::string>& expected,
                    const std::string& place, Report& report) {
  for (const std::string& type : expected) {
    if (found == type) return;
  }
  report.warn("media type", place,
              fmt::format("media type '{}'; {} expected", found, fmt::join(expected, " or ")));
}

// Loads the bytes [0, byteLength) of buffer `index`. More bytes than declared are allowed and not
// read.
std::vector<uint8_t> loadBuffer(const json& buffer, size_t index, Container& container,
                                const fs::path& directory, Report& report) {
  const std::string place = fmt::format("buffers[{}]", index);
  const uint64_t length = buffer.at("byteLength").get<uint64_t>();
  const auto checkLength = [&](uint64_t available, const std::string& what) {
    if (available < length) {
      report.fail(place + ".byteLength",
                  fmt::format("{} declared, but {} holds {}", length, what, byteCount(available)));
    }
  };
  std::vector<uint8_t> bytes;
  const auto uri = buffer.find("uri");
  if (uri == buffer.end()) {
    if (index != 0 || !container.binary) {
      const std::string lost =
          container.missingBytes == 0
              ? ""
              : fmt::format("; the file ends {} before the length in its header",
                            byteCount(container.missingBytes));
      report.fail(place, container.binary
                             ? "has no uri; only buffers[0] may be the GLB's binary chunk"
                             : "has no uri, and there is no GLB binary chunk" + lost);
    }
    checkLength(container.binary->size(), "the GLB's binary chunk");
    bytes = std::move(*container.binary);
    container.binary.reset();
  } else if (isDataUri(uri->get_ref<const std::string&>())) {
    DataUri data = decodeDataUri(uri->get_ref<const std::string&>(), place + ".uri", report);
    checkMediaType(data.mediaType, {"application/octet-stream", "application/gltf-buffer"},
                   place + ".uri", report);
    checkLength(data.bytes.size(), "the data URI");
    bytes = std::move(data.bytes);
  } else {
    const fs::path file =
        resolveUri(uri->get_ref<const std::string&>(), directory, place + ".uri", report);
    std::error_code error;
    const uint64_t size = fs::file_size(file, error);
    checkLength(error ? 0 : size, fmt::format("file '{}'", file.filename().string()));
    return readFile(file, place, report, length);
  }
  bytes.resize(length);
  return bytes;
}

// Loads the bytes of images with a URI; images in buffer views arrive through tinygltf.
std::vector<EncodedImage> loadImages(const json& document, const fs::path& directory,
                                     Report& report) {
  const json& images = arrayOf(document, "images");
  std::vector<EncodedImage> encoded(images.size());
  for (size_t i = 0; i < images.size(); ++i) {
    const json& image = images[i];
    const std::string place = fmt::format("images[{}]", i);
    const auto uri = image.find("uri"), view = image.find("bufferView");
    if (view != image.end()) {
      encoded[i].source = fmt::format("bufferViews[{}]", view->get<uint64_t>());
      if (!image.contains("mimeType")) {
        report.warn("image type", place, "has a bufferView, but no mimeType");
      }
    } else if (isDataUri(uri->get_ref<const std::string&>())) {
      DataUri data = decodeDataUri(uri->get_ref<const std::string&>(), place + ".uri", report);
      encoded[i] = {"a data URI", std::move(data.mediaType), std::move(data.bytes)};
    } else {
      const fs::path file =
          resolveUri(uri->get_ref<const std::string&>(), directory, place + ".uri", report);
      encoded[i] = {fmt::format("file '{}'", file.filename().string()), "",
                    readFile(file, place, report, kMaxImageBytes)};
    }
    if (image.contains("mimeType")) encoded[i].mediaType = image.at("mimeType").get<std::string>();
    if (view == image.end() && encoded[i].bytes.empty()) {
      report.fail(place, fmt::format("{} is empty", encoded[i].source));
    }
  }
  return encoded;
}

// Resources under the generated names "buffer-N" and "image-N", each served once.
struct Served {
  std::map<std::string, std::vector<uint8_t>> files;
};

bool servedExists(const std::string& name, void* user) {
  return static_cast<Served*>(user)->files.count(name) != 0;
}

std::string servedPath(const std::string& name, void*) { return name; }

bool servedSize(size_t* bytes, std::string* error, const std::string& name, void* user) {
  const auto& files = static_cast<Served*>(user)->files;
  const auto it = files.find(name);
  if (it == files.end()) {
    if (error) *error += name + " is not a resource of this document";
    return false;
  }
  *bytes = it->second.size();
  return true;
}

bool servedRead(std::vector<unsigned char>* out, std::string* error, const std::string& name,
                void* user) {
  auto& files = static_cast<Served*>(user)->files;
  const auto it = files.find(name);
  if (it == files.end()) {
    if (error) *error += name + " is not a resource of this document";
    return false;
  }
  *out = std::move(it->second);
  files.erase(it);
  return true;
}

// Images stay encoded until a material asks for them.
bool keepEncoded(tinygltf::Image*, const int index, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void* user) {
  auto& images = *static_cast<std::vector<EncodedImage>*>(user);
  images[static_cast<size_t>(index)].bytes.assign(bytes, bytes + size);
  return true;
}

void removeExtras(json& value) {
  if (value.is_object()) value.erase("extras");
  if (value.is_structured()) {
    for (json& item : value) removeExtras(item);
  }
}

}  // namespace

Document loadDocument(Container container, const fs::path& directory, Report& report) {
  Document document;
  json& root = container.json;
  uint64_t hash = hashBytes(container.fileBytes.data(), container.fileBytes.size(), 0);
  container.fileBytes.clear();

  const size_t bufferCount = arrayOf(root, "buffers").size();
  std::vector<std::vector<uint8_t>> buffers;
  for (size_t i = 0; i < bufferCount; ++i) {
    json& buffer = root["buffers"][i];
    if (isMeshoptFallback(buffer)) {
      buffers.push_back({0});  // a byte that no view refers to, as tinygltf takes no empty buffer
      buffer["byteLength"] = buffers.back().size();
      continue;
    }
    buffers.push_back(loadBuffer(buffer, i, container, directory, report));
    hash = hashBytes(buffers.back().data(), buffers.back().size(), hash);
  }
  decodeMeshopt(root, buffers, report);
  Served served;
  for (size_t i = 0; i < buffers.size(); ++i) {
    const std::string name = fmt::format("buffer-{}", i);
    served.files[name] = std::move(buffers[i]);
    root["buffers"][i]["uri"] = name;
  }
  document.images = loadImages(root, directory, report);
  for (size_t i = 0; i < document.images.size(); ++i) {
    json& image = root["images"][i];
    if (image.contains("bufferView")) continue;
    const std::string name = fmt::format("image-{}", i);
    hash = hashBytes(document.images[i].bytes.data(), document.images[i].bytes.size(), hash);
    served.files[name] = std::move(document.images[i].bytes);
    image["uri"] = name;
  }
  document.contentHash = hash;

  root.erase("animations");
  root.erase("skins");
  removeExtras(root);
  hideDracoIndices(root);
  const std::string text = root.dump();
  root = json();

  tinygltf::TinyGLTF loader;
  if (!serveFiles(loader, {servedExists, servedPath, servedRead, servedSize, &served}))
    report.fail("", "cannot be read: tinygltf takes no files from memory");
  loader.SetImageLoader(keepEncoded, &document.images);
  std::string error, warning;
  if (!loader.LoadASCIIFromString(&document.model, &error, &warning, text.c_str(),
                                  static_cast<unsigned>(text.size()), "")) {
    report.fail("", "cannot be read: " + error);
  }
  return document;
}

}  // namespace restlab::gltf
