// restlab bsdf --tabulate and --simulate: tables of BRDFs for the closure `table`.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace restlab {

struct BsdfOptions {
  std::string kind;
  std::vector<std::string> settings;
  std::string output;
  uint64_t samples = 1'000'000;
  bool json = false;
  uint32_t ballSize = 256;
  std::string tabulate;  // file to write
  std::string angles = "half";
  std::vector<uint32_t> sizes;
  std::string simulate;  // file of heights
  std::string base = "lambert";
  double albedo = 1.0;
  double spacing = 1.0;
  uint32_t bounces = 8;
};

void addTableOptions(CLI::App& verb, BsdfOptions& options);
// Writes the table of a kind to options.tabulate.
void writeTable(const BsdfOptions& options);
// Traces the rays of options.simulate, and writes the table to options.output.
void simulateTable(const BsdfOptions& options);

}  // namespace restlab
