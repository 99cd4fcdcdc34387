#include "core/scene/gltf/schema.h"

namespace restlab::gltf {
namespace {

constexpr double kMax = std::numeric_limits<double>::max();
constexpr double kMaxInt = 2147483647.0;         // limit of properties that tinygltf holds as int
constexpr double kMaxSize = 9007199254740991.0;  // 2^53 - 1: exact in JSON

Field required(Field field) {
  field.required = true;
  return field;
}

Field dispensable(Field field) {
  field.isDispensable = true;
  return field;
}

Field unreadBeside(const char* other, Field field) {
  field.unreadBeside = other;
  return field;
}

Field enabledIf(const char* name, const char* word, Field field) {
  field.enabledIf = {name, word};
  return field;
}

Field integer(const char* name, double low = 0, double high = kMaxInt) {
  return {.name = name, .kind = Kind::integer, .low = low, .high = high};
}

Field size(const char* name, double low = 0) { return integer(name, low, kMaxSize); }

Field choice(const char* name, std::vector<int> values) {
  return {.name = name, .kind = Kind::integer, .integers = std::move(values)};
}

Field number(const char* name, double low = -kMax, double high = kMax,
             OutOfRange outOfRange = OutOfRange::fails) {
  return {.name = name, .kind = Kind::number, .low = low, .high = high, .outOfRange = outOfRange};
}

Field positive(const char* name) {
  return {.name = name, .kind = Kind::number, .low = 0, .lowExcluded = true};
}

Field numbers(const char* name, size_t count, double low = -kMax, double high = kMax,
              OutOfRange outOfRange = OutOfRange::fails) {
  return {.name = name,
          .kind = Kind::numbers,
          .low = low,
          .high = high,
          .outOfRange = outOfRange,
          .count = count};
}

Field boolean(const char* name) { return {.name = name, .kind = Kind::boolean}; }
Field text(const char* name) { return {.name = name, .kind = Kind::text}; }
Field texts(const char* name) { return {.name = name, .kind = Kind::texts}; }
Field ignored(const char* name) { return {.name = name, .kind = Kind::ignored}; }

// Text that only messages show.
Field label(const char* name) { return dispensable(text(name)); }

Field word(const char* name, std::vector<const char*> words) {
  return {.name = name, .kind = Kind::text, .words = std::move(words)};
}

Field object(const char* name, const Schema& schema) {
  return {.name = name, .kind = Kind::object, .schema = &schema};
}

Field objects(const char* name, const Schema& schema) {
  return {.name = name, .kind = Kind::objects, .schema = &schema};
}

Field reference(const char* name, const char* target) {
  return {.name = name, .kind = Kind::reference, .target = target};
}

Field references(const char* name, const char* target) {
  return {.name = name, .kind = Kind::references, .target = target};
}

Field referenceMap(const char* name, const char* target) {
  return {.name = name, .kind = Kind::referenceMap, .target = target};
}

Field integerMap(const char* name) {
  return {.name = name, .kind = Kind::integerMap, .low = 0, .high = kMaxInt};
}

// The top-level array that KHR_lights_punctual adds.
constexpr const char* kLights = "extensions.KHR_lights_punctual.lights";
constexpr OutOfRange kClamps = OutOfRange::clamps;

struct Tables {
  // Data.
  Schema meshoptBuffer{{boolean("fallback")}};
  Schema buffer{{label("name"), text("uri"), required(size("byteLength", 1))},
                {{"EXT_meshopt_compression", &meshoptBuffer}}};
  Schema meshoptView{{required(reference("buffer", "buffers")), size("byteOffset"),
                      required(size("byteLength", 1)), required(integer("byteStride", 1, 256)),
                      required(size("count", 1)),
                      required(word("mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"})),
                      word("filter", {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"})}};
  Schema bufferView{{label("name"), required(reference("buffer", "buffers")), size("byteOffset"),
                     required(size("byteLength", 1)), integer("byteStride", 4, 252),
                     dispensable(choice("target", {34962, 34963}))},
                    {{"EXT_meshopt_compression", &meshoptView}}};
  Schema sparseIndices{{required(reference("bufferView", "bufferViews")), integer("byteOffset"),
                        required(choice("componentType", {5121, 5123, 5125}))}};
  Schema sparseValues{{required(reference("bufferView", "bufferViews")), integer("byteOffset")}};
  Schema sparse{{required(integer("count", 1)), required(object("indices", sparseIndices)),
                 required(object("values", sparseValues))}};
  Schema accessor{
      {label("name"), reference("bufferView", "bufferViews"), size("byteOffset"),
       required(choice("componentType", {5120, 5121, 5122, 5123, 5125, 5126})),
       boolean("normalized"), required(size("count")),
       required(word("type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"})),
       dispensable(numbers("max", 0)), dispensable(numbers("min", 0)), object("sparse", sparse)}};

  // Textures. A texture's source and sampler are checked only if a material uses it: files with
  // unused dangling references are common.
  Schema image{
      {label("name"), text("uri"), text("mimeType"), reference("bufferView", "bufferViews")}};
  Schema sampler{{label("name"), choice("magFilter", {9728, 9729}),
                  dispensable(choice("minFilter", {9728, 9729, 9984, 9985, 9986, 9987})),
                  choice("wrapS", {33071, 33648, 10497}), choice("wrapT", {33071, 33648, 10497})}};
  Schema texture{{label("name"), integer("sampler"), integer("source")}};
  Schema textureTransform{
      {numbers("offset", 2), number("rotation"), numbers("scale", 2), integer("texCoord")}};
  Schema textureInfo{{required(reference("index", "textures")), integer("texCoord")},
                     {{"KHR_texture_transform", &textureTransform}}};
  Schema normalTextureInfo{
      {required(reference("index", "textures")), integer("texCoord"), number("scale")},
      {{"KHR_texture_transform", &textureTransform}}};
  Schema occlusionTextureInfo{
      {required(reference("index", "textures")), integer("texCoord"), ignored("strength")},
      {{"KHR_texture_transform", &textureTransform}}};

  // Materials.
  Schema metallicRoughness{
      {numbers("baseColorFactor", 4, 0, 1, kClamps), object("baseColorTexture", textureInfo),
       number("metallicFactor", 0, 1, kClamps), number("roughnessFactor", 0, 1, kClamps),
       object("metallicRoughnessTexture", textureInfo)}};
  Schema emissiveStrength{{number("emissiveStrength", 0, kMax, kClamps)}};
  Schema ior{{number("ior", 0, kMax, kClamps)}};
  Schema specular{{number("specularFactor", 0, 1, kClamps), object("specularTexture", textureInfo),
                   numbers("specularColorFactor", 3, 0, kMax, kClamps),
                   object("specularColorTexture", textureInfo)}};
  Schema transmission{
      {number("transmissionFactor", 0, 1, kClamps), object("transmissionTexture", textureInfo)}};
  Schema volume{{number("thicknessFactor", 0, kMax, kClamps),
                 dispensable(object("thicknessTexture", textureInfo)),
                 positive("attenuationDistance"), numbers("attenuationColor", 3, 0, 1, kClamps)}};
  Schema clearcoat{{number("clearcoatFactor", 0, 1, kClamps),
                    object("clearcoatTexture", textureInfo),
                    number("clearcoatRoughnessFactor", 0, 1, kClamps),
                    object("clearcoatRoughnessTexture", textureInfo),
                    object("clearcoatNormalTexture", normalTextureInfo)}};
  Schema sheen{{numbers("sheenColorFactor", 3, 0, 1, kClamps),
                object("sheenColorTexture", textureInfo),
                number("sheenRoughnessFactor", 0, 1, kClamps),
                object("sheenRoughnessTexture", textureInfo)}};
  Schema anisotropy{{number("anisotropyStrength", 0, 1, kClamps), number("anisotropyRotation"),
                     object("anisotropyTexture", textureInfo)}};
  Schema iridescence{{number("iridescenceFactor", 0, 1, kClamps),
                      object("iridescenceTexture", textureInfo),
                      number("iridescenceIor", 1, kMax, kClamps),
                      number("iridescenceThicknessMinimum", 0, kMax, kClamps),
                      number("iridescenceThicknessMaximum", 0, kMax, kClamps),
                      object("iridescenceThicknessTexture", textureInfo)}};
  Schema diffuseTransmission{{number("diffuseTransmissionFactor", 0, 1, kClamps),
                              object("diffuseTransmissionTexture", textureInfo),
                              numbers("diffuseTransmissionColorFactor", 3, 0, 1, kClamps),
                              object("diffuseTransmissionColorTexture", textureInfo)}};
  Schema dispersion{{number("dispersion", 0, kMax, kClamps)}};
  Schema unlit{};
  Schema specularGlossiness{
      {numbers("diffuseFactor", 4, 0, 1, kClamps), object("diffuseTexture", textureInfo),
       numbers("specularFactor", 3, 0, 1, kClamps), number("glossinessFactor", 0, 1, kClamps),
       object("specularGlossinessTexture", textureInfo)}};
  Schema material{
      {label("name"), object("pbrMetallicRoughness", metallicRoughness),
       object("normalTexture", normalTextureInfo),
       dispensable(object("occlusionTexture", occlusionTextureInfo)),
       object("emissiveTexture", textureInfo), numbers("emissiveFactor", 3, 0, kMax, kClamps),
       word("alphaMode", {"OPAQUE", "MASK", "BLEND"}),
       enabledIf("alphaMode", "MASK", number("alphaCutoff", 0, kMax, kClamps)),
       boolean("doubleSided")},
      {{"KHR_materials_anisotropy", &anisotropy},
       {"KHR_materials_clearcoat", &clearcoat},
       {"KHR_materials_diffuse_transmission", &diffuseTransmission},
       {"KHR_materials_dispersion", &dispersion},
       {"KHR_materials_emissive_strength", &emissiveStrength},
       {"KHR_materials_iridescence", &iridescence},
       {"KHR_materials_sheen", &sheen},
       {"KHR_materials_ior", &ior},
       {"KHR_materials_specular", &specular},
       {"KHR_materials_transmission", &transmission},
       {"KHR_materials_volume", &volume},
       {"KHR_materials_pbrSpecularGlossiness", &specularGlossiness},
       {"KHR_materials_unlit", &unlit}}};

  // Geometry. core/scene/gltf/variants.cpp checks the content of KHR_materials_variants.
  Schema draco{
      {required(reference("bufferView", "bufferViews")), required(integerMap("attributes"))}};
  Schema variants{{ignored("mappings"), ignored("variants")}};
  Schema primitive{{required(referenceMap("attributes", "accessors")),
                    reference("indices", "accessors"), reference("material", "materials"),
                    choice("mode", {0, 1, 2, 3, 4, 5, 6}), ignored("targets")},
                   {{"KHR_materials_variants", &variants}, {"KHR_draco_mesh_compression", &draco}}};
  Schema mesh{{label("name"), required(objects("primitives", primitive)), ignored("weights")}};

  // Cameras and lights.
  // A path tracer has no clipping planes, and an image may have any shape.
  Schema perspective{{dispensable(positive("aspectRatio")), required(positive("yfov")),
                      dispensable(positive("zfar")), dispensable(required(positive("znear")))}};
  Schema orthographic{{required(number("xmag")), required(number("ymag")),
                       dispensable(required(positive("zfar"))),
                       dispensable(required(number("znear", 0)))}};
  Schema camera{{label("name"), object("perspective", perspective),
                 object("orthographic", orthographic),
                 required(word("type", {"perspective", "orthographic"}))}};
  Schema spot{
      {number("innerConeAngle", 0), number("outerConeAngle", 0, 1.5707963267948966, kClamps)}};
  Schema light{{label("name"), numbers("color", 3, 0, kMax, kClamps),
                number("intensity", 0, kMax, kClamps),
                required(word("type", {"directional", "point", "spot"})),
                dispensable(positive("range")), enabledIf("type", "spot", object("spot", spot))}};
  Schema lights{{required(objects("lights", light))}};

  // Hierarchy.
  Schema lightReference{{required(reference("light", kLights))}};
  Schema gpuInstancing{{required(referenceMap("attributes", "accessors"))}};
  Schema node{
      {label("name"), reference("camera", "cameras"), references("children", "nodes"),
       dispensable(reference("skin", "skins")), numbers("matrix", 16), reference("mesh", "meshes"),
       unreadBeside("matrix", numbers("rotation", 4)), unreadBeside("matrix", numbers("scale", 3)),
       unreadBeside("matrix", numbers("translation", 3)), ignored("weights")},
      {{"KHR_lights_punctual", &lightReference}, {"EXT_mesh_gpu_instancing", &gpuInstancing}}};
  Schema scene{{label("name"), references("nodes", "nodes")}};
  Schema asset{
      {label("copyright"), label("generator"), required(text("version")), text("minVersion")}};

  Schema document{
      {required(object("asset", asset)), texts("extensionsUsed"), texts("extensionsRequired"),
       objects("buffers", buffer), objects("bufferViews", bufferView),
       objects("accessors", accessor), objects("images", image), objects("samplers", sampler),
       objects("textures", texture), objects("materials", material), objects("meshes", mesh),
       objects("cameras", camera), objects("nodes", node), objects("scenes", scene),
       reference("scene", "scenes"), ignored("animations"), ignored("skins")},
      {{"KHR_lights_punctual", &lights}, {"KHR_materials_variants", &variants}}};
};

}  // namespace

const Schema& documentSchema() {
  static const Tables tables;
  return tables.document;
}

const std::vector<std::string>& supportedExtensions() {
  static const std::vector<std::string> names = {"EXT_mesh_gpu_instancing",
                                                 "EXT_meshopt_compression",
                                                 "KHR_draco_mesh_compression",
                                                 "KHR_lights_punctual",
                                                 "KHR_materials_anisotropy",
                                                 "KHR_materials_clearcoat",
                                                 "KHR_materials_diffuse_transmission",
                                                 "KHR_materials_dispersion",
                                                 "KHR_materials_emissive_strength",
                                                 "KHR_materials_ior",
                                                 "KHR_materials_iridescence",
                                                 "KHR_materials_pbrSpecularGlossiness",
                                                 "KHR_materials_sheen",
                                                 "KHR_materials_specular",
                                                 "KHR_materials_transmission",
                                                 "KHR_materials_unlit",
                                                 "KHR_materials_variants",
                                                 "KHR_materials_volume",
                                                 "KHR_mesh_quantization",
                                                 "KHR_texture_transform"};
  return names;
}

}  // namespace restlab::gltf
