// Removal of textures that are 0 in every channel that matters.
#pragma once

#include "core/scene/scene.h"

namespace restlab {

// Sets a factor to 0, channel by channel, if its texture is 0 in every texel: factor x texture is 0
// then, and a kernel that reads no textures must not see the factor. A slot whose factors are all 0
// loses its texture. The image stays the same: 0 times a factor is exact, and so is filtering
// zeros. Base colour textures stay, as the same image holds alpha.
void foldBlackTextures(Scene& scene);

}  // namespace restlab
