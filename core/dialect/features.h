// Feature bits of a scene. Kernels are specialised by a mask of these bits: a template argument on
// the CPU, a specialization constant on the GPU. core/scene/compiled/feature_scan.cpp sets them.
#ifndef RL_FEATURES_H
#define RL_FEATURES_H

#ifdef __cplusplus
#include "core/dialect/dialect.h"
#endif

RL_NAMESPACE_BEGIN

const uint RL_FEATURE_AREA_LIGHTS = 1u;      // emissive triangles
const uint RL_FEATURE_PUNCTUAL_LIGHTS = 2u;  // point, spot, directional
const uint RL_FEATURE_ENVIRONMENT = 4u;      // environment map
const uint RL_FEATURE_GLOSSY = 8u;           // any lobe that is not Lambert
const uint RL_FEATURE_TRANSMISSION = 16u;    // smooth or rough dielectric transmission
const uint RL_FEATURE_VOLUME = 32u;          // absorption inside dielectrics
const uint RL_FEATURE_TEXTURES = 64u;        // any texture but emission and normal maps
const uint RL_FEATURE_NORMAL_MAPS = 128u;
const uint RL_FEATURE_EMISSIVE_TEXTURES = 256u;
const uint RL_FEATURE_VERTEX_COLORS = 512u;
const uint RL_FEATURE_ALPHA = 1024u;           // mask or blend: rays ask the material
const uint RL_FEATURE_INSTANCES = 2048u;       // transformed instances (shared meshes)
const uint RL_FEATURE_SMOOTH_NORMALS = 4096u;  // vertex normals that differ from the face normal
const uint RL_FEATURE_MULTISCATTER = 8192u;    // multiple-scattering compensation of GGX
const uint RL_FEATURE_AMBIENT = 16384u;        // light from everywhere that nothing shadows
const uint RL_FEATURE_SCATTERING = 32768u;     // media that scatter inside bodies
const uint RL_FEATURE_LIGHT_TREE = 65536u;     // receivers choose lamps by a hierarchy
// From bit 17 on: RL_FEATURE_CLOSURE_*, a kind of closure each. They, RL_FEATURE_CLOSURES (all of
// them), RL_FEATURE_ALL and RL_FEATURE_BITS are made of closures.list.

RL_NAMESPACE_END

#include "closures/list.h"

#endif
