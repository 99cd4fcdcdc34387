// URIs of buffers and images name only files below the scene's folder, however they are written.
#include <gtest/gtest.h>

#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

namespace fs = std::filesystem;
using test::GltfBuilder;

constexpr const char* kBytes = "thirty-six bytes of corners, or more";

// Error of loading a scene in the folder `inside` whose buffer or image has this URI. Files outside
// the folder exist, valid as a buffer and as an image.
std::string errorOf(const char* array, const std::string& uri) {
  GltfBuilder file;
  file.fileName = "inside/test.gltf";
  for (const char* name : {"file", "inside/file", "inside/sub/file", "inside/a b"}) {
    file.directory().write(name, std::string(array) == "images" ? test::tinyPng() : kBytes);
  }
  if (std::string(array) == "images") {
    file.add("images", {{"uri", uri}});
  } else {
    file.add("buffers", {{"uri", uri}, {"byteLength", 8}});
  }
  return file.error();
}

class GltfUri : public testing::TestWithParam<const char*> {};

TEST_P(GltfUri, LeavingTheFolderIsRefused) {
  const std::string place = std::string(GetParam()) + "[0].uri: ";
  const std::string outside = (fs::temp_directory_path() / "file").string();
  for (const std::string uri :
       {"../file", "sub/../../file", "./../file", "sub/./.././../file", "%2e%2e/file",
        "%2E%2E%2Ffile", "..%2ffile", "sub%2f..%2f..%2ffile", "..", "/etc/passwd", "%2fetc/passwd",
        "//host/file", ".", "sub/.."}) {
    const std::string error = errorOf(GetParam(), uri);
    EXPECT_EQ(error.find(place), 0u) << uri << ": " << error;
    const bool isFolder = uri == "." || uri == "sub/..";
    EXPECT_NE(error.find(isFolder ? "is a directory" : "leaves the scene's directory"),
              std::string::npos)
        << uri << ": " << error;
  }
  EXPECT_NE(errorOf(GetParam(), outside).find("leaves the scene's directory"), std::string::npos);
}

TEST_P(GltfUri, SchemesAreRefused) {
  for (const std::string uri :
       {"http://example.com/file", "HTTPS://example.com/file", "file:///etc/passwd", "file:file",
        "FILE:file", "c:file", "x-y+z.1:f"}) {
    const std::string error = errorOf(GetParam(), uri);
    EXPECT_NE(error.find("is not a relative path"), std::string::npos) << uri << ": " << error;
  }
}

TEST_P(GltfUri, MalformedIsRefused) {
  EXPECT_NE(errorOf(GetParam(), "").find("empty URI"), std::string::npos);
  EXPECT_NE(errorOf(GetParam(), "file%00").find("zero character"), std::string::npos);
  EXPECT_NE(errorOf(GetParam(), "file%2").find("file 'file%2' does not exist"), std::string::npos);
  EXPECT_NE(errorOf(GetParam(), "sub\\file").find("separate folders by '/'"), std::string::npos);
  EXPECT_NE(errorOf(GetParam(), "data:image/png;base64,!!").find("invalid base64"),
            std::string::npos);
}

TEST_P(GltfUri, InsideIsRead) {
  for (const char* uri :
       {"file", "./file", "sub/file", "sub/../file", "sub%2ffile", "a%20b", "a b"}) {
    EXPECT_EQ(errorOf(GetParam(), uri), "") << uri;
  }
}

TEST_P(GltfUri, LinksAreFollowed) {
  GltfBuilder file;
  file.fileName = "inside/test.gltf";
  file.directory().write("file", kBytes);
  fs::create_directory(file.directory().path() / "inside");
  fs::create_symlink("../file", file.directory().path() / "inside/link");
  fs::create_symlink("nothing", file.directory().path() / "inside/dangling");
  file.add("buffers", {{"uri", "link"}, {"byteLength", 8}});
  EXPECT_EQ(file.error(), "");
  file.doc["buffers"][0]["uri"] = "dangling";
  EXPECT_NE(file.error().find("does not exist"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(All, GltfUri, testing::Values("buffers", "images"),
                         [](const auto& target) { return std::string(target.param); });

}  // namespace
}  // namespace restlab
