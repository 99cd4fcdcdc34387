#include <fstream>  // tinygltf's writer names file streams even where it has no file access

#define TINYGLTF_IMPLEMENTATION
#include "core/scene/tinygltf.h"
