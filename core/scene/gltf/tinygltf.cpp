#include <fstream>  // for tinygltf's writer, which uses file streams even without file access

#define TINYGLTF_IMPLEMENTATION
#include "core/scene/gltf/tinygltf.h"
