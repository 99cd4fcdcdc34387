// Names of bias classes in tables and lists.
#pragma once

#include "core/frame/part.h"

namespace restlab {

const char* biasName(BiasClass bias);

}  // namespace restlab
