// References that are known, and not rendered of the scene that is measured.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/runner/reference/reference.h"

namespace restlab {

enum class Truth {
  rendered,  // of the scene itself, as everywhere
  exact,     // in closed form (experiments/truths)
  same,      // of the scene without `scale`, `radiance` and `move`, times its radiance
};

// The scene of a request without these three.
SceneRequest withoutRelations(SceneRequest request);
// What `radiance` in a scene's name multiplies its image by; 1 where the name has none.
double radianceFactor(const std::string& scene);

// Has it a `scale` or a `move`? Lengths of a camera path are then not those of the plain scene.
bool isElsewhere(const std::string& scene);

// Why `truth` cannot be had of this view, in words; "": it can. `plain`: prepared of
// withoutRelations().
std::string whyNoTruth(Truth truth, const SceneRequest& request, const PreparedScene& plain,
                       const ReferenceConfig& config);

// The exact image as a reference without noise: both halves are it.
Reference exactReference(const SceneRequest& request, const PreparedScene& plain,
                         const ReferenceConfig& config);
// `reference` times `factor`, with its noise.
Reference multiplied(Reference reference, double factor);

// The name, in a folder of results, of the file that is rendered for Truth::same, with the camera
// on the path of that name.
constexpr const char* kPlainReference = "-plain";
std::string plainLabel(const SceneRequest& request, const std::string& path,
                       const PreparedScene& plain, const ReferenceConfig& config);

// "in closed form", "of the scene without ..., 256 spp", "256 spp": where a reference comes from,
// for tables.
std::string originOf(const Reference& reference);

}  // namespace restlab
