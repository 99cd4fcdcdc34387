#include "tests/report/sample.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

namespace restlab::report_test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "restlab-report-XXXXXX").string();
  if (!mkdtemp(name.data())) ADD_FAILURE() << "no temporary folder";
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string readFile(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void writeImage(const fs::path& file, const Image& image) {
  fs::create_directories(file.parent_path());
  LayeredImage layers;
  layers.layers[""] = image;
  writeExr(file, layers);
}

Image sampleReference(uint32_t width, uint32_t height) {
  Image image(width, height);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const float u = (float(x) + 0.5f) / float(width), v = (float(y) + 0.5f) / float(height);
      const float spot =
          3.0f * std::exp(-40.0f * ((u - 0.8f) * (u - 0.8f) + (v - 0.3f) * (v - 0.3f)));
      image.at(x, y) =
          glm::vec3(0.05f + 0.6f * u, 0.08f + 0.3f * v, 0.4f - 0.3f * u) + glm::vec3(spot);
    }
  }
  return image;
}

Image noisy(const Image& image, float strength, uint32_t seed) {
  std::mt19937 random(seed);
  Image out = image;
  for (glm::vec3& pixel : out.pixels) {
    const float u = float(random() % 65536) / 65536.0f;
    // Rare and large values, like the noise of a path tracer.
    pixel *= 1.0f + strength * (u > 0.9f ? 6.0f * (u - 0.5f) : -0.3f);
  }
  return out;
}

std::vector<glm::vec3> specialPixels() {
  using Limits = std::numeric_limits<float>;
  const float nan = Limits::quiet_NaN(), inf = Limits::infinity();
  return {{nan, 1.0f, 2.0f},
          {1.0f, inf, 2.0f},
          {1.0f, 2.0f, -inf},
          {-0.5f, -1e-20f, -3e30f},
          {Limits::denorm_min(), 1e-40f, -1e-42f},
          {-0.0f, 0.0f, 1.0f},
          {Limits::max(), Limits::lowest(), Limits::min()}};
}

namespace {

// From braces alone the library would make an object of a list of pairs, and drop a list of one.
ReportModel list(std::initializer_list<ReportModel> items) {
  ReportModel array = ReportModel::array();
  for (const ReportModel& item : items) array.push_back(item);
  return array;
}

ReportModel pair(const char* name, const ReportModel& value) { return list({name, value}); }

ReportModel cell(double value, double spread) {
  return {{"value", value}, {"lo", value - spread}, {"hi", value + spread}};
}

ReportModel columns() {
  return list(
      {{{"key", "time_ms"}, {"title", "time per frame"}, {"unit", "ms"}, {"better", "lower"}},
       {{"key", "mse"}, {"title", "MSE"}, {"better", "lower"}, {"help", "mean squared error"}},
       {{"key", "ratio"}, {"title", "MSE ratio"}, {"better", "higher"}},
       {{"key", "energy"}, {"title", "energy"}}});
}

ReportModel rows() {
  return list(
      {{{"method", "path"},
        {"cells",
         {{"time_ms", cell(70.0, 1.0)}, {"mse", cell(0.9, 0.1)}, {"energy", cell(1.01, 0.02)}}}},
       {{"method", "gi biased"},
        {"counts", false},
        {"warnings", list({"energy ratio 0.93 [0.92, 0.94] is outside 0.95..1.05"})},
        {"cells",
         {{"time_ms", cell(8.0, 0.5)},
          {"mse", cell(0.01, 0.001)},
          {"ratio", cell(90.0, 4.0)},
          {"energy", cell(0.93, 0.01)}}}},
       {{"method", "gi unbiased"},
        {"flags", list({"a remark"})},
        {"cells",
         {{"time_ms", cell(86.0, 1.0)},
          {"mse", {{"value", 0.03}, {"lo", "-inf"}, {"hi", "inf"}}},
          {"ratio", cell(30.0, 2.0)},
          {"energy", cell(0.999, 0.01)}}}},
       {{"method", "broken"},
        {"cells", {{"time_ms", cell(100.0, 1.0)}, {"mse", {{"value", "nan"}}}}}}});
}

ReportModel plots() {
  ReportModel path = ReportModel::array(), gi = ReportModel::array();
  for (int i = 0; i < 6; ++i) {
    const double x = std::pow(2.0, i);
    path.push_back(list({x, 1.0 / x, 0.8 / x, 1.25 / x}));
    gi.push_back(list({x, 0.05 / std::sqrt(x), 0.04 / std::sqrt(x), 0.06 / std::sqrt(x)}));
  }
  gi.push_back(list({64.0, "nan"}));
  const ReportModel fit = {{"slope", -1.0}, {"lo", -1.1}, {"hi", -0.9}, {"intercept", 0.0}};
  const ReportModel series = list({{{"name", "path"}, {"points", path}, {"fit", fit}},
                                   {{"name", "gi unbiased"}, {"points", gi}}});
  return list({{{"id", "mse-time"},
                {"title", "MSE over time"},
                {"x", {{"title", "render time (s)"}, {"log", true}}},
                {"y", {{"title", "MSE"}, {"log", true}}},
                {"series", series}}});
}

}  // namespace

ReportModel sampleModel(const fs::path& folder) {
  const Image reference = sampleReference(kSampleWidth, kSampleHeight);
  Image special = noisy(reference, 0.1f, 2);
  const std::vector<glm::vec3> pixels = specialPixels();
  for (uint32_t i = 0; i < pixels.size(); ++i) special.at(3 + i, 5) = pixels[i];
  writeImage(folder / "images/reference.exr", reference);
  writeImage(folder / "images/path.exr", noisy(reference, 1.0f, 1));
  writeImage(folder / "images/gi.exr", special);

  ReportModel first = {{"id", "first"},
                       {"title", "a scene, all light"},
                       {"subtitle", "64x36, 8 scattering events"},
                       {"columns", columns()},
                       {"rows", rows()},
                       {"plots", plots()},
                       {"exposure", 2.0}};
  const ReportModel pathParts = list({pair("trace", 70.0)});
  const ReportModel giParts =
      list({pair("trace", 60.0), pair("temporal", 16.0), pair("spatial", 10.0)});
  first["bars"] = {{"title", "Time of each pass"},
                   {"unit", "ms"},
                   {"rows", list({{{"name", "path"}, {"parts", pathParts}},
                                  {{"name", "gi unbiased"}, {"parts", giParts}}})}};
  first["left_out"] = list({{{"method", "path"}, {"features", list({"textures", "environment"})}},
                            {{"method", "gi unbiased"}, {"features", ReportModel::array()}}});
  first["health"] = {
      {"columns",
       list({{{"name", "nonfinite"}, {"bad", true}}, {{"name", "negative"}}, "delta_lobes"})},
      {"rows", list({{{"method", "path"}, {"counts", list({0, 0, 12345})}},
                     {{"method", "gi unbiased"}, {"counts", list({3, 2, 0})}}})}};
  const auto image = [](const char* name, const char* file, const char* role) {
    return ReportModel{{"name", name}, {"file", file}, {"role", role}};
  };
  first["images"] = list({image("reference", "images/reference.exr", "reference"),
                          image("path", "images/path.exr", "method"),
                          image("gi unbiased", "images/gi.exr", "method")});
  ReportModel second = {{"id", "second"},
                        {"title", "a scene, indirect light"},
                        {"columns", columns()},
                        {"rows", rows()}};
  return {{"schema", kReportSchema},
          {"title", "A sample"},
          {"question", "Does every part of a report work?"},
          {"generated", "2026-01-02T03:04:05Z"},
          {"command", "restlab run sample.toml"},
          {"notes", list({"interrupted"})},
          {"provenance", list({pair("restlab", "0.2.0"), pair("machine", "two cores")})},
          {"blocks", list({first, second})}};
}

}  // namespace restlab::report_test
