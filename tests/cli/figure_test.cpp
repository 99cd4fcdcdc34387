// restlab figure: crop strips, and one-line errors.
#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

class FigureTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    writeConstant("ref.exr", 0.5f, 32, 24);
    writeConstant("a.exr", 0.4f, 32, 24);
    writeConstant("b.exr", 0.7f, 32, 24);
    writeConstant("small.exr", 0.7f, 8, 8);
  }
  void writeConstant(const std::string& name, float value, uint32_t width, uint32_t height) const {
    LayeredImage image;
    image.layers[""] = Image(width, height, glm::vec3(value));
    writeExr(path(name), image);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
};

TEST_F(FigureTest, OneCommandMakesTheStrip) {
  const ProgramResult result =
      run("figure --ref ref.exr a.exr b.exr --crop 2,2,8,6 --crop 20,10,8,6 --labels mine,theirs "
          "--metric mse --crop-errors -o strip.svg");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  const std::string svg = read("strip.svg");
  for (const char* text : {">mine<", ">theirs<", ">reference<", ">mse<", ">0.01<", ">0.04<"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
  // The better error is bold.
  EXPECT_NE(svg.find("font-weight=\"bold\">0.01<"), std::string::npos);
  EXPECT_EQ(svg.find("font-weight=\"bold\">0.04<"), std::string::npos);
}

TEST_F(FigureTest, FilesNameTheColumns) {
  ASSERT_EQ(run("figure -r ref.exr a.exr --crop 0,0,32,24 -o strip.svg").code, 0);
  EXPECT_NE(read("strip.svg").find(">a<"), std::string::npos);
}

TEST_F(FigureTest, LabelsAreWhatTellsTheNamesApart) {
  const auto labels = [&](const std::string& reference, const std::vector<std::string>& images) {
    std::string line = "figure -r " + reference;
    for (const std::string& image : images) {
      writeConstant(image, 0.4f, 32, 24);
      line += " " + image;
    }
    EXPECT_EQ(run(line + " --crop 0,0,32,24 --scale 8 -o strip.svg").code, 0);
    return read("strip.svg");
  };
  const auto expectAll = [](const std::string& svg, const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
      EXPECT_NE(svg.find(">" + text + "<"), std::string::npos) << text;
  };
  expectAll(labels("ref.exr", {"box-all-path.exr", "box-all-gi-unbiased.exr"}),
            {"path", "gi-unbiased"});
  // A common prefix ends at a '-', not inside a word.
  expectAll(labels("ref.exr", {"box-pairs.exr", "box-path.exr"}), {"pairs", "path"});
  expectAll(labels("ref.exr", {"pairs.exr", "path.exr"}), {"pairs", "path"});
  // The prefix would leave nothing of the first name.
  expectAll(labels("ref.exr", {"box-.exr", "box-path.exr"}), {"box-", "box-path"});
  // A single image: the prefix that it shares with its reference.
  expectAll(labels("ref.exr", {"box-all-path.exr"}), {"box-all-path"});
  writeConstant("box-all-reference.exr", 0.5f, 32, 24);
  expectAll(labels("box-all-reference.exr", {"box-all-gi-biased.exr"}), {"gi-biased"});
}

TEST_F(FigureTest, PngToo) {
  const ProgramResult result = run("figure -r ref.exr a.exr --crop 0,0,8,8 --scale 4 -o strip.png");
  ASSERT_EQ(result.code, 0);
  EXPECT_EQ(read("strip.png").substr(1, 3), "PNG");
  EXPECT_NE(result.err.find("exposure 0.36"), std::string::npos)
      << "makes the reference, 0.5, mid grey: " << result.err;
}

TEST_F(FigureTest, HalvesAreUsedAsByCompare) {
  LayeredImage reference;
  reference.layers[""] = Image(16, 16, glm::vec3(0.5f));
  reference.layers["half0"] = Image(16, 16, glm::vec3(0.6f));
  reference.layers["half1"] = Image(16, 16, glm::vec3(0.4f));
  writeExr(path("halves.exr"), reference);
  writeConstant("c.exr", 0.8f, 16, 16);
  ASSERT_EQ(run("figure -r halves.exr c.exr --crop 0,0,8,8 -o strip.svg").code, 0);
  // (0.8 - 0.6)(0.8 - 0.4)
  EXPECT_NE(read("strip.svg").find(">0.08<"), std::string::npos);
}

TEST_F(FigureTest, MistakesAreOneLine) {
  struct Mistake {
    const char* arguments;
    int code;
    std::vector<std::string> fragments;
  };
  const Mistake mistakes[] = {
      {"-r ref.exr a.exr --crop 0,0,8,8", 2, {"--output"}},
      {"-r ref.exr a.exr -o x.svg", 2, {"--crop"}},
      {"a.exr --crop 0,0,8,8 -o x.svg", 2, {"--ref"}},
      {"-r ref.exr a.exr --crop 0,0,8,8 -o x.pdf", 2, {"x.pdf", "*.svg or *.png"}},
      {"-r ref.exr a.exr --crop 0,0,8 -o x.svg", 2, {"0,0,8", "X,Y,W,H"}},
      {"-r ref.exr a.exr --crop 0,0,8,8,8 -o x.svg", 2, {"0,0,8,8,8", "X,Y,W,H"}},
      {"-r ref.exr a.exr --crop=-1,0,8,8 -o x.svg", 2, {"-1,0,8,8", "X,Y,W,H"}},
      {"-r ref.exr a.exr --crop 0,0,0,8 -o x.svg", 2, {"0,0,0,8", "empty"}},
      {"-r ref.exr a.exr --crop 0,0,8,8 --crop 0,0,8,9 -o x.svg", 2, {"0,0,8,9", "8x8"}},
      {"-r ref.exr a.exr --crop 30,0,8,8 -o x.svg", 2, {"30,0,8,8", "32x24"}},
      {"-r ref.exr a.exr --crop 4294967295,0,8,8 -o x.svg", 2, {"32x24"}},
      {"-r ref.exr a.exr --crop 0,0,8,8 --labels x,y,z -o x.svg", 2, {"x,y,z", "3 labels"}},
      {"-r ref.exr a.exr --crop 0,0,8,8 --metric mze -o x.svg", 2, {"'mze'", "'mse'"}},
      {"-r ref.exr a.exr --crop 0,0,8,8 --scale 0 -o x.svg", 2, {"--scale"}},
      {"-r ref.exr a.exr --crop 0,0,8,8 --exposure nan -o x.svg", 2, {"--exposure"}},
      {"-r ref.exr a.exr --crop 0,0,8,8 --corps 1 -o x.svg", 2, {"'--corps'", "'--crop'"}},
      {"-r ref.exr absent.exr --crop 0,0,8,8 -o x.svg", 3, {"absent.exr"}},
      {"-r absent.exr a.exr --crop 0,0,8,8 -o x.svg", 3, {"absent.exr"}},
      {"-r ref.exr small.exr --crop 0,0,8,8 -o x.svg", 3, {"small.exr", "8x8", "32x24"}},
      {"-r ref.exr a.exr --crop 0,0,8,8 -o absent/x.svg", 3, {"absent"}},
      {"--series lecture cornell-box -o x.svg", 2, {"--series lecture", "'course'"}},
      {"--series course cornell-box glass -o x.svg", 2, {"one scene"}},
      {"--series course cornell-box --crop 0,0,8,8 -o x.svg", 2, {"--crop"}},
      {"--series course cornell-box -o x.pdf", 2, {"x.pdf", "*.svg or *.png"}},
      {"--series course cornell-bax -o x.svg", 3, {"cornell-bax"}},
      {"--series course cornell-box --resolution 9000x9000 -o x.svg", 2, {"9000x9000"}},
  };
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.arguments);
    expectError(run(std::string("figure ") + mistake.arguments), mistake.code, mistake.fragments);
    EXPECT_FALSE(exists("x.svg"));
  }
}

// Each picture has more light than the one before, but for what shadows take; a mirror and glass
// show nothing before the last one.
TEST_F(FigureTest, ASeriesBuildsTheLightOfASceneUp) {
  for (const std::string scene : {"cornell-box", "glass"}) {
    SCOPED_TRACE(scene);
    const ProgramResult result = run("figure --series course " + scene +
                                     " --resolution 40x32 --spp 32 --title=built-up -o s.png");
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out, "");
    const std::string png = read("s.png");
    // A text of the PNG: its length stands before "tEXt" and the key.
    const auto word = [&](const std::string& key) {
      const size_t at = png.find("tEXt" + key + '\0');
      if (at == std::string::npos) return std::string();
      const size_t length = (uint8_t(png[at - 2]) << 8) + uint8_t(png[at - 1]);
      return png.substr(at + 4 + key.size() + 1, length - key.size() - 1);
    };
    std::vector<double> means;
    for (int i = 1; i <= 5; ++i)
      means.push_back(
          std::atof(word("restlab:picture" + std::to_string(i) + ".mean_radiance").c_str()));
    ASSERT_GT(means[1], 0.0) << "no metadata";
    // The lamp of `glass` is out of view.
    EXPECT_EQ(means[0] > 0.0, scene == "cornell-box");
    EXPECT_GT(means[1], 1.02 * means[0]);
    EXPECT_LT(means[2], 0.98 * means[1]);
    EXPECT_GT(means[3], 1.02 * means[2]);
    if (scene == "glass") {
      EXPECT_GT(means[4], 1.02 * means[3]);
    } else {
      EXPECT_NEAR(means[4], means[3], 0.05 * means[3]);
    }
  }
  ASSERT_EQ(run("figure --series course cornell-box --resolution 90x60 --spp 1 -o s.svg").code, 0);
  const std::string svg = read("s.svg");
  for (const char* text : {">shadows<", ">cornell-box<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST_F(FigureTest, TooLargeIsRefused) {
  writeConstant("wide.exr", 0.5f, 4000, 1000);
  expectError(run("figure -r wide.exr wide.exr --crop 0,0,4000,1000 --scale 64 -o x.svg"), 2,
              {"--scale 64"});
}

TEST_F(FigureTest, NonfiniteImageIsSaid) {
  LayeredImage image;
  image.layers[""] = Image(32, 24, glm::vec3(0.5f));
  image.layers[""].at(3, 2).y = std::numeric_limits<float>::quiet_NaN();
  writeExr(path("nan.exr"), image);
  const ProgramResult result = run("figure -r ref.exr nan.exr a.exr --crop 0,0,8,8 -o x.svg");
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.err.find("nan.exr: holds 1 non-finite values"), std::string::npos) << result.err;
  EXPECT_NE(read("x.svg").find(">nan<"), std::string::npos);
}

}  // namespace

}  // namespace restlab::cli_test
