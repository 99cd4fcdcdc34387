// Size and component of images, as command lines, suites and records name them.
#pragma once

#include <cstdint>
#include <string>

namespace restlab {

constexpr uint32_t kMaxSide = 16384;  // pixels

// Parses the sides of "640x360". Throws badUsage with `place` on bad syntax or a side outside
// 1..kMaxSide.
void parseResolution(const std::string& text, const std::string& place, uint32_t& width,
                     uint32_t& height);

std::string componentName(uint32_t components);
// Throws badUsage with the nearest name; `place` names the option or the file position.
uint32_t parseComponent(const std::string& name, const std::string& place);

}  // namespace restlab
