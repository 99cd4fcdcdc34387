#include "experiments/view/measured_rows.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

// Longest line that is read; a longer one ends the rows.
constexpr size_t kMostBytes = 4 << 20;

double numberAt(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : std::nan("");
}

// Adds a value to a mean of `count` values.
void addTo(double& mean, double value, uint64_t count) {
  mean += (value - mean) / double(count + 1);
}

}  // namespace

void MeasuredRows::follow(const std::filesystem::path& file) {
  std::error_code status;
  const uintmax_t size = std::filesystem::file_size(file, status);
  file_ = file;
  read_ = status ? 0 : size;
  rows_.clear();
}

bool MeasuredRows::poll() {
  std::error_code status;
  const uintmax_t size = std::filesystem::file_size(file_, status);
  if (status || size <= read_) return false;
  std::ifstream in(file_, std::ios::binary);
  in.seekg(std::streamoff(read_));
  std::string text(std::min<uintmax_t>(size - read_, kMostBytes), '\0');
  in.read(text.data(), std::streamsize(text.size()));
  text.resize(size_t(in.gcount()));
  const size_t end = text.rfind('\n');
  if (end == std::string::npos) return false;
  read_ += end + 1;
  for (size_t at = 0; at <= end;) {
    const size_t next = text.find('\n', at);
    hear(text.substr(at, next - at));
    at = next + 1;
  }
  return true;
}

void MeasuredRows::hear(const std::string& line) {
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object() || json.value("kind", "") != "run") return;
  const std::string name = json.value("method", "");
  auto row = std::find_if(rows_.begin(), rows_.end(),
                          [&](const MeasuredRow& one) { return one.method == name; });
  if (row == rows_.end()) {
    if (rows_.size() >= kMostRows) return;
    row = rows_.insert(rows_.end(), {name});
  }
  const auto time = json.find("time_ms");
  addTo(row->mse, numberAt(json, "mse"), row->runs);
  addTo(row->relmse, numberAt(json, "relmse_e1e-2"), row->runs);
  addTo(row->energy, numberAt(json, "energy_ratio"), row->runs);
  if (time != json.end() && time->is_object())
    addTo(row->timeMs, numberAt(*time, "median"), row->runs);
  ++row->runs;
}

}  // namespace restlab
