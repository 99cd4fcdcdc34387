#include "experiments/view/view_exposure.h"

#include <algorithm>
#include <vector>

#include "experiments/runner/tables/preview.h"

namespace restlab {

double exposureOf(const LiveView& view) {
  if (view.reference().hasImage()) return previewExposure(view.reference().mean());
  if (!view.hasScene() && !view.images().list.empty())
    return previewExposure(view.images().list.front().image);
  const Image* first = view.picture(0);
  return first != nullptr ? previewExposure(*first) : 1.0;
}

bool isNothingLit(const LiveView& view) {
  std::vector<const Image*> pictures;
  for (size_t i = 0; i < view.panes(); ++i) {
    // A pane that renders, and that no page shows, has the picture of an earlier camera.
    if (view.isSeen(i) || !view.renders(i)) pictures.push_back(view.picture(i));
  }
  if (view.reference().hasImage()) pictures.push_back(&view.reference().mean());
  std::erase(pictures, nullptr);
  return !pictures.empty() && std::all_of(pictures.begin(), pictures.end(), [](const Image* one) {
    return std::all_of(one->pixels.begin(), one->pixels.end(),
                       [](const glm::vec3& pixel) { return pixel == glm::vec3(0.0f); });
  });
}

}  // namespace restlab
