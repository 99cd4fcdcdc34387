// Specialisation has an effect: few instantiations, and each specialised kernel is smaller than the
// general one.
#include <elf.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/backend/cpu_kernel.h"
#include "core/dialect/features.h"

namespace restlab::lint {
namespace {

struct Row {
  std::string mask, trace;
  rl::FeatureMask features;
};

std::map<std::string, std::vector<Row>> rowsByKernel() {
  std::map<std::string, std::vector<Row>> result;
  const rl::CpuKernelTable table = rl::cpuKernelTable();
  for (uint32_t i = 0; i < table.count; ++i) {
    result[table.rows[i].name].push_back(
        {table.rows[i].maskName, table.rows[i].trace, table.rows[i].mask});
  }
  return result;
}

// Names of kernels added with NO_FEATURES, as patterns, since a loop may insert a part of a
// name. These kernels work on buffers only and depend on no feature of a scene.
std::set<std::string> kernelsWithoutFeatures() {
  namespace fs = std::filesystem;
  static const std::regex added(R"(rl_add_kernel\(([\w${}]+)[^)]*\bNO_FEATURES\b)");
  static const std::regex variable(R"(\$\{\w+\})");
  std::set<std::string> names;
  for (const char* folder : {"cmake", "core", "denoise", "integrators"}) {
    for (const fs::path& path :
         fs::recursive_directory_iterator(fs::path(RESTLAB_SOURCE_DIR) / folder)) {
      if (path.filename() != "CMakeLists.txt" && path.filename() != "kernels.cmake") continue;
      std::ifstream file(path);
      const std::string text((std::istreambuf_iterator<char>(file)), {});
      for (std::sregex_iterator it(text.begin(), text.end(), added), end; it != end; ++it)
        names.insert(std::regex_replace((*it)[1].str(), variable, "[a-z_]+"));
    }
  }
  return names;
}

// Bytes of the functions of an ELF64 object file whose mangled names have `part`.
size_t codeBytes(const std::string& path, const std::string& part) {
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const auto read = [&](size_t at, auto& into) {
    if (at + sizeof into > bytes.size()) throw std::out_of_range(path + " ends too early");
    std::memcpy(&into, bytes.data() + at, sizeof into);
  };
  Elf64_Ehdr header;
  read(0, header);
  Elf64_Shdr section, names;
  // With more than 65279 sections the count is in section 0.
  read(header.e_shoff, section);
  const size_t count = header.e_shnum ? header.e_shnum : section.sh_size;
  size_t total = 0;
  for (size_t i = 0; i < count; ++i) {
    read(header.e_shoff + i * sizeof section, section);
    if (section.sh_type != SHT_SYMTAB) continue;
    read(header.e_shoff + section.sh_link * sizeof names, names);
    for (size_t at = 0; at < section.sh_size; at += sizeof(Elf64_Sym)) {
      Elf64_Sym symbol;
      read(section.sh_offset + at, symbol);
      const std::string name = bytes.c_str() + names.sh_offset + symbol.st_name;
      if (ELF64_ST_TYPE(symbol.st_info) == STT_FUNC && name.find(part) != std::string::npos)
        total += symbol.st_size;
    }
  }
  return total;
}

// Code of one mask: members of Ctx<features> and runTile<features>.
size_t codeBytes(const std::string& object, rl::FeatureMask features) {
  return codeBytes(object, "ILm" + std::to_string(features) + "EE");
}

// Object file of generated/kernels/<kernel>.cpp.
std::string objectFile(const std::string& kernel) {
  std::ifstream list(RESTLAB_KERNEL_OBJECTS);
  const std::string wanted = "/kernels/" + kernel + ".cpp";
  for (std::string path; std::getline(list, path);) {
    if (path.find(wanted) != std::string::npos) return path;
  }
  return "";
}

TEST(Instantiation, FewMasksAreBuiltIn) {
  const auto kernels = rowsByKernel();
  ASSERT_FALSE(kernels.empty());
  const std::set<std::string> buffersAlone = kernelsWithoutFeatures();
  ASSERT_TRUE(buffersAlone.contains("accumulate"));
  for (const auto& [name, rows] : kernels) {
    size_t embree = 0, general = 0, bvh = 0;
    for (const Row& row : rows) {
      EXPECT_EQ(row.features & ~rl::RL_FEATURE_ALL, 0u) << name << " " << row.mask;
      if (row.trace == "bvh") {
        // Only compared with a Vulkan device, never used to render: one instantiation suffices.
        ++bvh;
        EXPECT_EQ(row.features, rl::RL_FEATURE_ALL) << name << " " << row.mask;
        continue;
      }
      EXPECT_EQ(row.trace, "embree") << name << " " << row.mask;
      ++embree;
      general += row.features == rl::RL_FEATURE_ALL;
    }
    EXPECT_LE(embree, 3u) << name << ": others are compiled where a scene needs them";
    const bool isOfBuffers = std::any_of(
        buffersAlone.begin(), buffersAlone.end(),
        [&](const std::string& pattern) { return std::regex_match(name, std::regex(pattern)); });
    const size_t least = isOfBuffers ? 1 : 2;
    EXPECT_GE(embree, least) << name << " is not specialised";
    EXPECT_EQ(general, 1u) << name;
    EXPECT_EQ(bvh, 1u) << name;
  }
}

TEST(Instantiation, SpecialisedCodeIsSmaller) {
  for (const auto& [name, rows] : rowsByKernel()) {
    const std::string object = objectFile(name);
    const size_t general = codeBytes(object, rl::RL_FEATURE_ALL);
    ASSERT_GT(general, 0u) << name << ": no general kernel in '" << object << "'";
    for (const Row& row : rows) {
      if (row.trace == "bvh") continue;
      const size_t bytes = codeBytes(object, row.features);
      ASSERT_GT(bytes, 0u) << name << " " << row.mask << ": " << object;
      std::printf("  %-24s %-20s %8zu bytes of code, %5.1f %% of the general kernel's\n",
                  name.c_str(), row.mask.c_str(), bytes, 100.0 * double(bytes) / double(general));
      if (row.features == rl::RL_FEATURE_ALL) continue;
      EXPECT_LT(bytes, general) << name << " " << row.mask;
    }
  }
}

}  // namespace
}  // namespace restlab::lint
