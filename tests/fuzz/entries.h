// What reads files of others, as functions of bytes: fuzzed with libFuzzer (CMakeLists.txt) and, by
// any compiler, fed with the committed seeds (seeds_test.cpp).
#pragma once

#include <cstddef>
#include <cstdint>

namespace restlab::fuzz {

// True where the bytes were read, false where they were refused as the manual promises: an Error of
// the right exit code, one line of text. Anything else is thrown: libFuzzer ends on it, a test
// fails.
using Entry = bool (*)(const uint8_t* bytes, size_t count);

bool readGltf(const uint8_t* bytes, size_t count);     // .gltf or .glb, up to the compiled scene
bool readSuite(const uint8_t* bytes, size_t count);    // .toml
bool readHdr(const uint8_t* bytes, size_t count);      // an environment, .hdr
bool readExr(const uint8_t* bytes, size_t count);      // .exr
bool readCommand(const uint8_t* bytes, size_t count);  // of a page to the viewer
bool readTexture(const uint8_t* bytes, size_t count);  // PNG or JPEG

}  // namespace restlab::fuzz
