// `reverse_turns`: a scene that turns camera paths the other way.
#include <gtest/gtest.h>

#include <fstream>

#include "experiments/runner/suite/picture.h"
#include "experiments/runner/suite/suite.h"
#include "tests/runner/temporary_folder.h"

namespace restlab {
namespace {

class ReverseTurnsTest : public TemporaryFolder {
 protected:
  CameraMotion motion(const std::string& path, const std::string& scene) const {
    const std::filesystem::path file = folder() / "suite.toml";
    std::ofstream(file) << "[settings]\ncamera_path = \"turn\"\n[[camera_path]]\nname = \"turn\"\n"
                        << path << "[[scene]]\nscene = \"cornell-box\"\n"
                        << scene << "[[method]]\nname = \"path\"\n";
    const Suite suite = loadSuite(file, {});
    return *motionOf(suite, suite.scenes.front(), prepareScene(suite.scenes.front().request));
  }
};

TEST_F(ReverseTurnsTest, AnglesHaveTheOtherSign) {
  const auto path = [](const std::string& kind, int degrees) {
    const bool isBack = kind == "back";
    return "kind = \"" + kind + "\"\n" +
           (isBack ? "frame = 9\ndegrees = " : "degrees_per_frame = ") + std::to_string(degrees) +
           ".0\n";
  };
  for (const char* kind : {"orbit", "pan", "back"}) {
    const CameraMotion reversed = motion(path(kind, 3), "reverse_turns = true\n"),
                       other = motion(path(kind, -3), ""), plain = motion(path(kind, 3), "");
    EXPECT_EQ(cameraAt(reversed, 7).cameraToWorld, cameraAt(other, 7).cameraToWorld) << kind;
    EXPECT_NE(cameraAt(reversed, 7).cameraToWorld, cameraAt(plain, 7).cameraToWorld) << kind;
  }
}

}  // namespace
}  // namespace restlab
