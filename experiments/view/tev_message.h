// Messages to tev, an image viewer, over a connection.
//
// Format, little-endian: a 32-bit length of the whole message, a byte with the operation, then its
// arguments. Texts end with a zero byte, booleans are one byte, numbers have 32 bits, sizes in
// memory 64 bits.
#pragma once

#include <string>

#include "core/image/image.h"

namespace restlab {

// Creates a black image, replacing one with the same name.
std::string tevCreateMessage(const std::string& name, uint32_t width, uint32_t height);

// Sets the pixels of an existing image, as floats.
std::string tevUpdateMessage(const std::string& name, const Image& image);

}  // namespace restlab
