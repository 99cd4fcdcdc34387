// Types shared by host and kernels. Layout is `scalar` on the GPU and natural in C++: the sizes are
// asserted here and the offsets compared by tests/parity.
#ifndef RL_TYPES_H
#define RL_TYPES_H

#ifdef __cplusplus
#include "core/dialect/dialect.h"
#endif

RL_NAMESPACE_BEGIN

const uint RL_INVALID = 0xffffffffu;
// Row length of a pass over entries instead of pixels: kernelMain() gets entry i as (i % this,
// i / this). The last row may reach beyond the last entry.
const uint RL_ENTRY_ROW = 1024u;
const uint RL_MAX_UV_SETS = 4u;

// Ray modes of traceRay().
const uint RL_RAY_PATH =
    0u;  // closest hit; alpha decided by a hash of the sample and the primitive
const uint RL_RAY_SHADOW = 1u;  // any hit; alpha multiplies the transmittance
const uint RL_RAY_BODIES = 2u;  // the surface of a body in the interval (core/geometry/trace.glsl)
// Largest number of further bodies that are found at one point, besides the one that a ray hit
// first.
const uint RL_MEDIA_TOUCHING = 8u;

struct Ray {
  vec3 origin;
  float tMin;
  vec3 dir;  // unit length for path rays; shadow rays span origin to target with tMax <= 1
  float tMax;
};

struct Hit {
  uint instance;  // RL_INVALID: nothing hit
  uint primitive;
  vec2 bary;  // weights of the second and third corner
  float t;
};

// Barycentric weight up to which a hit counts as on the edge: some units of rounding.
const float RL_EDGE_BARY = 1.0e-6f;

// Partly transparent surfaces that a ray has passed.
const uint RL_ALPHA_EDGES = 4u;
struct AlphaPassed {
  float transmittance;
  uint count;     // edges and corners passed so far
  uint edges[4];  // hashes of the last edges and corners; 0: none
};

// One glTF mesh primitive or a shape: triangles [firstTriangle, +triangleCount) index vertices from
// firstVertex. An attribute offset of RL_INVALID means the attribute is absent.
struct Geometry {
  uint firstTriangle;
  uint triangleCount;
  uint firstVertex;
  uint normalOffset;
  uint tangentOffset;
  uint colorOffset;
  uint uvOffset[4];
  uint shape;           // RL_SHAPE_*; not RL_SHAPE_TRIANGLES: it has no triangles and attributes
  uint firstShapeWord;  // of its parameters, in SceneData::shapeWords
};
RL_STATIC_ASSERT_SIZE(Geometry, 48);

const uint RL_INSTANCE_IDENTITY = 1u;  // vertices are stored in world space
const uint RL_INSTANCE_FLIPPED = 2u;   // the transform mirrors: winding is reversed
const uint RL_INSTANCE_ALPHA = 4u;     // some part may be transparent: rays ask the material
const uint RL_INSTANCE_RANK_SHIFT =
    8u;  // above: rank of the body (core/scene/compiled/bodies.h), 0: none

struct Instance {
  vec4 objectToWorldRow0;  // rows of the affine 3x4 matrix
  vec4 objectToWorldRow1;
  vec4 objectToWorldRow2;
  vec4 worldToObjectRow0;
  vec4 worldToObjectRow1;
  vec4 worldToObjectRow2;
  uint geometry;
  uint material;
  uint firstLight;  // light-table index of primitive 0, RL_INVALID where the material does not emit
  uint flags;
};
RL_STATIC_ASSERT_SIZE(Instance, 112);

const uint RL_MATERIAL_DOUBLE_SIDED = 1u;
const uint RL_MATERIAL_UNLIT = 2u;  // KHR_materials_unlit: emits its base colour, scatters nothing
const uint RL_MATERIAL_ALPHA_MASK = 4u;    // alpha < alphaCutoff is a hole
const uint RL_MATERIAL_ALPHA_BLEND = 8u;   // alpha is coverage
const uint RL_MATERIAL_THIN = 16u;         // transmission without volume: no refraction
const uint RL_MATERIAL_BLACK = 32u;        // scatters nothing (a black body)
const uint RL_MATERIAL_ANISOTROPIC = 64u;  // a closure that looks at the tangent
// Layers of glTF's extensions: their values are parameters (RL_LAYER_*, core/shading/bsdf.h).
const uint RL_MATERIAL_CLEARCOAT = 128u;
const uint RL_MATERIAL_SHEEN = 256u;
const uint RL_MATERIAL_ANISOTROPY = 512u;
const uint RL_MATERIAL_IRIDESCENCE = 1024u;
const uint RL_MATERIAL_DIFFUSE_TRANSMISSION = 2048u;
const uint RL_MATERIAL_DISPERSION = 4096u;
const uint RL_MATERIAL_LAYERS = 8064u;  // any of them

// Texture slots of a material.
const uint RL_TEX_BASE_COLOR = 0u;
const uint RL_TEX_METALLIC_ROUGHNESS = 1u;
const uint RL_TEX_NORMAL = 2u;
const uint RL_TEX_EMISSIVE = 3u;
const uint RL_TEX_TRANSMISSION = 4u;
const uint RL_TEX_SPECULAR = 5u;
const uint RL_TEX_SPECULAR_COLOR = 6u;
const uint RL_TEX_COUNT = 7u;

// glTF metallic-roughness material with ior, specular, transmission and volume extensions, or a
// closure that takes the place of its lobes: emission, coverage and the normal map stay.
struct Material {
  vec3 baseColor;
  float alpha;
  vec3 emission;  // radiance, W sr^-1 m^-2 (emissiveFactor x emissiveStrength)
  float alphaCutoff;
  float metallic;
  float roughness;  // perceptual; alpha = roughness^2
  float ior;
  float transmission;
  vec3 specularColor;
  float specular;
  vec3 sigmaAbsorption;  // m^-1, Beer-Lambert inside a volume
  float normalScale;
  uint flags;
  uint textures[7];     // index into SceneData::textures, RL_INVALID where the slot is empty
  uint closure;         // RL_CLOSURE_*; 0: the lobes of glTF
  uint firstParameter;  // of the closure or the layers, in SceneData::closureParameters
  uint padding0;
  uint padding1;
};
RL_STATIC_ASSERT_SIZE(Material, 128);

// Last word of a closure's parameter: a texture, and the channel of a number above.
const uint RL_PARAMETER_TEXTURE = 0x3fffffffu;
const uint RL_PARAMETER_CHANNEL_SHIFT = 30u;

const uint RL_WRAP_REPEAT = 0u;
const uint RL_WRAP_CLAMP = 1u;
const uint RL_WRAP_MIRROR = 2u;

const uint RL_TEXTURE_NEAREST = 1u;  // texture flag: nearest instead of bilinear filtering
const uint RL_TEXTURE_SRGB = 2u;     // texture flag: RGB is sRGB-encoded, decoded before filtering

// A use of an image: sampler, KHR_texture_transform (uv' = rows x (u, v, 1)) and UV set.
struct Texture {
  vec3 uvRow0;
  vec3 uvRow1;
  uint firstTexel;  // into SceneData::texels, RGBA8 packed little-endian, row 0 on top
  uint width;
  uint height;
  uint wrapU;
  uint wrapV;
  uint flags;
  uint uvSet;
  uint padding0;
  uint padding1;
  uint padding2;
};
RL_STATIC_ASSERT_SIZE(Texture, 64);

// Kinds of entries in the light table.
const uint RL_LIGHT_AREA = 0u;  // a triangle, or a shape (RL_LIGHT_SHAPE)
const uint RL_LIGHT_POINT = 1u;
const uint RL_LIGHT_SPOT = 2u;
const uint RL_LIGHT_DIRECTIONAL = 3u;
const uint RL_LIGHT_ENVIRONMENT = 4u;

const uint RL_LIGHT_FLIPPED =
    2u;                          // Light::flags: a mirrored instance, the normal is -cross(e1, e2)
const uint RL_LIGHT_SHAPE = 4u;  // Light::flags: the whole shape of an instance

struct Light {
  vec3 p0;  // triangle corner, or position (world)
  uint kind;
  vec3 e1;    // triangle edge; of a shape: half of its box; or direction of light travel (unit)
  float pmf;  // probability of being selected
  vec3 e2;    // triangle edge; of a flat shape: its normal (else 0); spot: angle scale and offset;
              // point: attenuation
  float areaInverse;  // 1/m^2 of a triangle
  vec3 radiance;      // triangle: W sr^-1 m^-2; point, spot: W/sr; directional: W/m^2
  uint instance;      // triangles and shapes only
  uint primitive;
  uint flags;       // RL_MATERIAL_DOUBLE_SIDED, RL_LIGHT_FLIPPED
  float magnitude;  // metres; largest coordinate of the corners and within their transform
  uint padding;
};
RL_STATIC_ASSERT_SIZE(Light, 80);

// Hierarchy of lamps (core/scene/compiled/light_tree.h). A node has four parts: a uvec4 with a word
// of each for the box (low x, y, z, high x, y, z), the power (as the probability that the alias
// table gives a lamp of the part; 0: there is no such part), the axis of the cone of normals (x, y,
// z), its angle and how far from a normal lamps emit (cosines of 16 bits), and the node of the
// part, or one of:
const uint RL_LIGHT_NODE_LEAF = 0x80000000u;     // | lamp
const uint RL_LIGHT_NODE_CLUSTER = 0xc0000000u;  // | uvec4 of a cluster; both bits
// A cluster is chosen from by power: a uvec4 with the number of its lamps, then for each one that
// of an alias table: the bits below which the column gives its own lamp, that lamp, and the other
// one.
const uint RL_LIGHT_NODE_WHERE = 0x3fffffffu;  // mask
const uint RL_LIGHT_NODE_UVEC4S = 12u;
const uint RL_LIGHT_TREE_DEPTH = 16u;  // nodes between the root and a lamp, at most

// Vose alias method: column i keeps i if 32 random bits are below `keep`, otherwise gives `other`.
struct AliasEntry {
  uint keep;
  uint other;
  float pmf;  // probability that i is drawn, over all columns
};
RL_STATIC_ASSERT_SIZE(AliasEntry, 12);

// The project's own bounding volume hierarchy (core/scene/compiled/bvh.h): four children per node,
// read as uvec4s. A child is the record of a node, RL_INVALID (none), or one of:
const uint RL_BVH_LEAF = 0x40000000u;      // count << 26 | record of its first triangle
const uint RL_BVH_INSTANCE = 0x80000000u;  // | number of the instance
const uint RL_BVH_KIND = 0xc0000000u;      // mask of the two; both: an instance of a shape
const uint RL_BVH_LEAF_COUNT_SHIFT = 26u;
const uint RL_BVH_LEAF_FIRST = 0x03ffffffu;  // mask
const uint RL_BVH_RECORD_UVEC4S = 4u;        // per node or triangle
// Largest number of nodes between a root and a leaf, in each of the two levels.
const uint RL_BVH_MAX_DEPTH = 26u;
const uint RL_BVH_STACK = 160u;  // 3 deferred children at every node of both levels

const uint RL_CAMERA_PERSPECTIVE = 0u;
const uint RL_CAMERA_ORTHOGRAPHIC = 1u;

struct Camera {
  vec3 posW;
  uint kind;
  vec3 rightW;
  float halfWidth;  // tangent of the half angle, or half extent in metres (orthographic)
  vec3 upW;
  float halfHeight;
  vec3 forwardW;
  // The film's centre, to the right and up, in the unit of halfWidth: other than 0 where the film
  // is a part of a larger one.
  float shiftX;
  float shiftY;
  float padding0;
  float padding1;
  float padding2;
};
RL_STATIC_ASSERT_SIZE(Camera, 80);

RL_REF(FloatRef, float)
RL_REF(UintRef, uint)
RL_REF(Vec2Ref, vec2)
RL_REF(Vec3Ref, vec3)
RL_REF(Vec4Ref, vec4)
RL_REF(UVec3Ref, uvec3)
RL_REF(GeometryRef, Geometry)
RL_REF(InstanceRef, Instance)
RL_REF(MaterialRef, Material)
RL_REF(TextureRef, Texture)
RL_REF(LightRef, Light)
RL_REF(AliasRef, AliasEntry)
RL_REF(Uvec4Ref, uvec4)

// Everything a kernel reads of the scene, by address; through core/dialect/records.glsl. Geometry,
// Instance, Material, Texture and Light are read as uvec4s: their sizes are multiples
// of 16.
struct SceneData {
  Vec3Ref positions;
  Vec3Ref normals;
  Vec4Ref tangents;
  Vec4Ref colors;
  Vec2Ref uvs;
  UVec3Ref triangles;  // indices relative to Geometry::firstVertex
  GeometryRef geometries;
  InstanceRef instances;
  MaterialRef materials;
  TextureRef textures;
  UintRef texels;
  FloatRef srgbToLinear;  // 256 entries
  LightRef lights;
  AliasRef lightAlias;
  Uvec4Ref lightTree;  // hierarchy of lamps; null unless a session chooses by it
  // Two words a light: its part of each node from the root on, two bits a node, the lowest first;
  // its probability in its cluster (a float; 1 outside of clusters).
  UintRef lightTrails;
  Vec3Ref environment;        // radiance per texel, already scaled, row 0 on top
  AliasRef environmentAlias;  // pmf per texel
  // A value each: three floats and the texture that they are multiplied with (RL_INVALID: none; the
  // channel of a number in the upper two bits).
  Uvec4Ref closureParameters;
  Uvec4Ref shapeWords;  // parameters of shapes, as their files say
  // Two by rank: extinction (m^-1) and index of refraction; scattering (m^-1) and the mean cosine
  // of its angles. Rank 0 is air.
  Vec4Ref bodies;
  Vec2Ref ggxAlbedo;  // core/scene/compiled/ggx_albedo.h; null if no session compensates GGX
  // The project's own hierarchy: null unless a session traces it. The world's root is record 0.
  Uvec4Ref bvh;                 // RL_BVH_RECORD_UVEC4S per record
  UintRef bvhRoots;             // record of the root of each geometry that is shared by instances
  uvec2 accelerationStructure;  // device address if rays are traced by ray queries; else 0
  uint lightCount;
  uint environmentWidth;  // 0: no environment
  uint environmentHeight;
  uint environmentLight;      // index in the light table, or RL_INVALID
  float environmentRotation;  // radians about +Y
  uint instanceCount;
  uint bodiesMeet;     // 1: some bodies touch or overlap
  vec3 ambient;        // radiance that every surface gets from everywhere, without shadows
  vec3 background;     // radiance that the camera sees where it sees nothing
  uint hasBackground;  // 0: it sees the environment
  float lampShare;     // probability that lightAlias gives a lamp; 1: there is nothing else
  uint hasMedia;       // 1: some bodies absorb, scatter, touch or overlap (RL_FEATURE_VOLUME)
};

const uint RL_COMPONENT_DIRECT =
    1u;  // at most one scattering event, emission seen directly included
const uint RL_COMPONENT_INDIRECT = 2u;  // two or more scattering events
const uint RL_COMPONENT_ALL = 3u;

// First scattering event after which Russian roulette may end a path. restir_gi stores
// contributions up to the third vertex without a survival probability, so 3 is the smallest value
// it supports.
const uint RL_ROULETTE_EARLIEST = 3u;

// Flags: the camera of this frame or of the last one is inside an absorbing body. Light on its way
// to x1 and from x1 to the camera is then absorbed, which shifts do not account for: reservoirs
// hold no paths of such views.
const uint RL_CAMERA_ABSORBS_NOW = 1u;
const uint RL_CAMERA_ABSORBS_BEFORE = 2u;

const uint RL_FILTER_BOX = 0u;
const uint RL_FILTER_CENTER = 1u;

// Everything a kernel reads of the frame.
struct FrameData {
  Camera camera;
  Camera previousCamera;
  uvec4 cameraMedia;  // ranks of the bodies that the camera is in, the greatest first; 0: none
  uint width;
  uint height;
  uint frame;  // counts from 0 since the history was reset
  uint seed;
  uint pixelFilter;
  uint maxBounces;  // scattering events
  uint components;
  uint rouletteStart;    // first scattering event that may end a path by Russian roulette;
                         // RL_INVALID: off
  uint multiscatter;     // 1: GGX lobes are compensated, and the scene has ggxAlbedo; 0: off
  uint stillFrames;      // frames directly before this one with the same camera and parameters
  float radianceFrames;  // frames averaged by the integrator's radiance once its history is old
  uint cameraAbsorbs;    // RL_CAMERA_ABSORBS_*
  uint lightTree;        // 1: lamps are chosen by the hierarchy, 0: by the alias table
  uint sharesFilm;       // 1: all pixels of a frame have one film sample
  UintRef drawnLights;   // a word a light: 1 once a light sample was drawn from it; or null
};
RL_STATIC_ASSERT_SIZE(FrameData, 240);

// Numerical health: counters that every kernel adds to; names in core/frame/session.cpp.
const uint RL_HEALTH_NONFINITE = 0u;          // non-finite sample values set to zero
const uint RL_HEALTH_REJECTED_JACOBIAN = 1u;  // shifts outside the declared Jacobian domain
const uint RL_HEALTH_CAPPED_CONFIDENCE = 2u;
const uint RL_HEALTH_DELTA_LOBES = 3u;        // roughness below the floor, rendered as a delta lobe
const uint RL_HEALTH_UNREUSABLE_PIXELS = 4u;  // pixels whose x1 cannot be reused: own light alone
const uint RL_HEALTH_NEGATIVE = 5u;           // negative radiance left by control variates
const uint RL_HEALTH_DROPPED_WEIGHTS = 6u;    // negative, infinite or NaN resampling weights
const uint RL_HEALTH_CACHE_FULL = 7u;         // pixels whose cell found no slot in the cache
const uint RL_HEALTH_LIGHT_CHANGED = 8u;      // radiance cells reset because their light changed
const uint RL_HEALTH_NEW_HISTORY = 9u;        // pixels for whose surface a denoiser had no history
const uint RL_HEALTH_FIREFLIES = 10u;         // pixels that a denoiser darkened to match neighbours
const uint RL_HEALTH_LONG_WALKS = 11u;        // paths that RL_MOST_STRETCHES in media ended
const uint RL_HEALTH_SEGMENTS = 12u;          // rays that RL_FIELD_SEGMENTS stopped on a field
const uint RL_HEALTH_LOOPS_CUT = 13u;         // pixels whose loops the driver may have ended
const uint RL_HEALTH_COUNT = 14u;

RL_NAMESPACE_END

#endif
