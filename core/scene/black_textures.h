// Textures that are 0 wherever their factor counts.
#pragma once

#include "core/scene/scene.h"

namespace restlab {

// Sets factors to 0, channel by channel, whose texture is 0 in every texel: factor x texture is 0
// then, and a kernel that reads no textures must not see the factor. A slot whose factors are all
// 0 loses its texture. Images stay as they were: 0 times a factor is exact, and so is filtering
// zeros. Base colours keep theirs, as alpha is in the same image.
void foldBlackTextures(Scene& scene);

}  // namespace restlab
