// Images with known errors for `restlab compare`.
#pragma once

#include <nlohmann/json.hpp>

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

class CompareTest : public ProgramTest {
 protected:
  void writeConstant(const std::string& name, float value, uint32_t side = 8) const {
    LayeredImage image;
    image.layers[""] = Image(side, side, glm::vec3(value));
    writeExr(path(name), image);
  }
  // Writes a reference of value 0.5 whose halves are 0.5 +- 0.1.
  void writeReferenceWithHalves() const {
    LayeredImage image;
    image.layers[""] = Image(8, 8, glm::vec3(0.5f));
    image.layers["half0"] = Image(8, 8, glm::vec3(0.6f));
    image.layers["half1"] = Image(8, 8, glm::vec3(0.4f));
    writeExr(path("ref.exr"), image);
  }
  nlohmann::json json(const std::string& arguments) const {
    const ProgramResult result = run("compare " + arguments + " --json");
    EXPECT_EQ(result.code, 0) << result.err;
    return nlohmann::json::parse(result.out);
  }
};

}  // namespace restlab::cli_test
