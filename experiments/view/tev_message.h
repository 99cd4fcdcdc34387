// What tev, an image viewer, takes over a connection.
//
// Little-endian: a 32-bit length of the whole message, a byte that says what to do, then what that
// needs: texts end with 0, truth is one byte, numbers have 32 bits and those of memory 64.
#pragma once

#include <string>

#include "core/image/image.h"

namespace restlab {

// A new image, black, in place of one of that name.
std::string tevCreateMessage(const std::string& name, uint32_t width, uint32_t height);

// The pixels of an image that is there, as floats.
std::string tevUpdateMessage(const std::string& name, const Image& image);

}  // namespace restlab
