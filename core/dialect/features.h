// Feature bits of a scene. Kernels are specialised by a mask of these bits: a template argument on
// the CPU, two constants in the text on the GPU. core/scene/compiled/feature_scan.cpp sets them.
#ifndef RL_FEATURES_H
#define RL_FEATURES_H

#ifdef __cplusplus
#include "core/dialect/dialect.h"
#endif

RL_NAMESPACE_BEGIN

const FeatureMask RL_FEATURE_AREA_LIGHTS = 1u;      // emissive triangles
const FeatureMask RL_FEATURE_PUNCTUAL_LIGHTS = 2u;  // point, spot, directional
const FeatureMask RL_FEATURE_ENVIRONMENT = 4u;      // environment map
const FeatureMask RL_FEATURE_GLOSSY = 8u;           // any lobe that is not Lambert
const FeatureMask RL_FEATURE_TRANSMISSION = 16u;    // smooth or rough dielectric transmission
const FeatureMask RL_FEATURE_VOLUME = 32u;          // absorption inside dielectrics
const FeatureMask RL_FEATURE_TEXTURES = 64u;        // any texture but emission and normal maps
const FeatureMask RL_FEATURE_NORMAL_MAPS = 128u;
const FeatureMask RL_FEATURE_EMISSIVE_TEXTURES = 256u;
const FeatureMask RL_FEATURE_VERTEX_COLORS = 512u;
const FeatureMask RL_FEATURE_ALPHA = 1024u;           // mask or blend: rays ask the material
const FeatureMask RL_FEATURE_INSTANCES = 2048u;       // transformed instances (shared meshes)
const FeatureMask RL_FEATURE_SMOOTH_NORMALS = 4096u;  // normals of vertices unlike the face's
const FeatureMask RL_FEATURE_MULTISCATTER = 8192u;    // multiple-scattering compensation of GGX
const FeatureMask RL_FEATURE_AMBIENT = 16384u;        // light from everywhere that nothing shadows
const FeatureMask RL_FEATURE_SCATTERING = 32768u;     // media that scatter inside bodies
const FeatureMask RL_FEATURE_LIGHT_TREE = 65536u;     // receivers choose lamps by a hierarchy
const FeatureMask RL_FEATURE_CLEARCOAT = 131072u;     // layers of glTF's extensions
const FeatureMask RL_FEATURE_SHEEN = 262144u;
const FeatureMask RL_FEATURE_ANISOTROPY = 524288u;
const FeatureMask RL_FEATURE_IRIDESCENCE = 1048576u;
const FeatureMask RL_FEATURE_DIFFUSE_TRANSMISSION = 2097152u;
const FeatureMask RL_FEATURE_DISPERSION = 4194304u;
// Any of these layers; in hexadecimal, as cmake/kernels.cmake reads single bits alone.
const FeatureMask RL_FEATURE_LAYERS = 0x7e0000u;
// From bit 33 on: RL_FEATURE_CLOSURE_*, a kind of closure each. They, RL_FEATURE_CLOSURES (all of
// them), RL_FEATURE_GLTF and RL_FEATURE_ALL are made of closures.list. Kernels ask for kinds by
// RL_HAS_CLOSURE: on the GPU they have a word of their own. From bit 49 on: RL_FEATURE_SHAPE_*, a
// kind of shape each, of shapes.list (RL_FEATURE_SHAPES, RL_HAS_SHAPE).

RL_NAMESPACE_END

#include "closures/list.h"

#endif
