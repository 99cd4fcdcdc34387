#include "tests/cli/program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>

namespace restlab::cli_test {

namespace fs = std::filesystem;

namespace {

std::string readFile(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// Runs in the child: redirects the streams, changes to the folder and executes the program.
[[noreturn]] void becomeProgram(const fs::path& folder, const fs::path& outFile,
                                const fs::path& errFile, const std::vector<std::string>& arguments,
                                const Circumstances& circumstances) {
  const int in = open("/dev/null", O_RDONLY);
  const int out = open(outFile.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int err = open(errFile.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(in, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  if (chdir(folder.c_str()) != 0) _exit(127);
  setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
  const auto setLimit = [](auto resource, rlim_t most) {
    const rlimit limit = {most, most};
    if (most > 0 && setrlimit(resource, &limit) != 0) _exit(127);
  };
  setLimit(RLIMIT_FSIZE, circumstances.maxFileBytes);
  setLimit(RLIMIT_CPU, static_cast<rlim_t>(circumstances.maxCpuS));
  std::vector<std::string> line = {RESTLAB_PROGRAM};
  line.insert(line.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : line) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(argv[0], argv.data());
  _exit(127);
}

constexpr std::chrono::seconds kPatience{60};

// Returns whether the program has installed its handler of `signal`.
bool handles(pid_t program, int signal) {
  std::ifstream status(fmt::format("/proc/{}/status", program));
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("SigCgt:", 0) != 0) continue;
    return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0;
  }
  return false;
}

// Sends the requested signal, unless the program ends before. Returns its status.
int waitFor(pid_t child, const Circumstances& circumstances, rusage& usage) {
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto start = now();
  int status = 0;
  while (circumstances.signalWhen) {
    if (wait4(child, &status, WNOHANG, &usage) != 0) return status;
    const bool isHeard = circumstances.signal == SIGKILL || handles(child, circumstances.signal);
    if (isHeard && circumstances.signalWhen()) {
      kill(child, circumstances.signal);
      break;
    }
    if (now() - start > kPatience) {
      ADD_FAILURE() << "the program runs, and what it was to be signalled at does not come";
      kill(child, SIGKILL);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  return status;
}

std::vector<std::string> words(const std::string& arguments) {
  std::istringstream text(arguments);
  std::vector<std::string> list;
  for (std::string word; text >> word;) list.push_back(word);
  return list;
}

}  // namespace

std::vector<std::string> ProgramResult::errors() const {
  std::vector<std::string> lines;
  std::istringstream text(err);
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("error: ", 0) == 0) lines.push_back(line);
  }
  return lines;
}

void ProgramTest::SetUp() {
  std::string name = (fs::temp_directory_path() / "restlab-test-XXXXXX").string();
  ASSERT_NE(mkdtemp(name.data()), nullptr) << std::strerror(errno);
  folder_ = name;
}

void ProgramTest::TearDown() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

ProgramResult ProgramTest::run(const std::vector<std::string>& arguments,
                               const Circumstances& circumstances) const {
  static std::atomic<int> count{0};
  const fs::path out = folder_ / fmt::format(".stdout{}", ++count);
  ProgramResult result = start(arguments, out, circumstances);
  result.out = readFile(out);
  return result;
}

ProgramResult ProgramTest::run(const std::string& arguments,
                               const Circumstances& circumstances) const {
  return run(words(arguments), circumstances);
}

ProgramResult ProgramTest::start(const std::vector<std::string>& arguments, const fs::path& out,
                                 const Circumstances& circumstances) const {
  static std::atomic<int> count{0};
  const fs::path err = folder_ / fmt::format(".stderr{}", ++count);
  const pid_t child = fork();
  if (child == 0) becomeProgram(folder_, out, err, arguments, circumstances);
  ProgramResult result;
  if (child < 0) {
    ADD_FAILURE() << "fork: " << std::strerror(errno);
    return result;
  }
  rusage usage{};
  const int status = waitFor(child, circumstances, usage);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.peakBytes = uint64_t(usage.ru_maxrss) << 10;
  result.err = readFile(err);
  return result;
}

ProgramResult ProgramTest::runUntil(const std::function<bool()>& when,
                                    const std::string& arguments) const {
  Circumstances interrupted;
  interrupted.signalWhen = when;
  return run(arguments, interrupted);
}

ProgramResult ProgramTest::runInto(const std::string& file, const std::string& arguments) const {
  return start(words(arguments), file, {});
}

void ProgramTest::write(const std::string& name, const std::string& text) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string ProgramTest::read(const std::string& name) const { return readFile(folder_ / name); }

bool ProgramTest::isSaid(const std::string& words) const {
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(".stderr", 0) == 0 && read(name).find(words) != std::string::npos) return true;
  }
  return false;
}

std::vector<fs::path> ProgramTest::entries(const std::string& name) const {
  std::vector<fs::path> found;
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(path(name), absent)) {
    if (entry.path().filename().string().front() != '.') found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

void expectError(const ProgramResult& result, int code, const std::vector<std::string>& fragments) {
  EXPECT_EQ(result.code, code) << result.err;
  EXPECT_EQ(result.out, "");
  const std::vector<std::string> errors = result.errors();
  ASSERT_EQ(errors.size(), 1u) << result.err;
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos) << "colour codes in a file";
  for (const std::string& fragment : fragments) {
    EXPECT_NE(errors[0].find(fragment), std::string::npos)
        << "'" << fragment << "' is not in: " << errors[0];
  }
}

std::vector<std::map<std::string, std::string>> parseCsv(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1);
  std::string field;
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
        field += text[++i];
      } else if (c == '"') {
        quoted = false;
      } else {
        field += c;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',' || c == '\n') {
      lines.back().push_back(field);
      field.clear();
      if (c == '\n') lines.emplace_back();
    } else {
      field += c;
    }
  }
  std::vector<std::map<std::string, std::string>> rows;
  for (size_t line = 1; line + 1 < lines.size(); ++line) {
    EXPECT_EQ(lines[line].size(), lines[0].size());
    std::map<std::string, std::string>& row = rows.emplace_back();
    for (size_t i = 0; i < lines[line].size(); ++i) row[lines[0].at(i)] = lines[line][i];
  }
  return rows;
}

std::string triangleGltf(const std::vector<float>& positions, const std::string& extraMaterial) {
  static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes(positions.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), positions.data(), bytes.size());
  std::string encoded;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t word = 0;
    for (size_t k = 0; k < 3; ++k) {
      word = word << 8 | (i + k < bytes.size() ? uint8_t(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      encoded += i + k > bytes.size() ? '=' : digits[(word >> (18 - 6 * k)) & 63];
    }
  }
  return fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0, 1]}}],
"nodes": [{{"mesh": 0}}, {{"camera": 0, "translation": [0.3, 0.3, 2]}}],
"cameras": [{{"type": "perspective", "perspective": {{"yfov": 0.8, "znear": 0.1}}}}],
"materials": [{{"doubleSided": true, "emissiveFactor": [1, 1, 1]{}}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "material": 0}}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": {}, "type": "VEC3",
  "min": [-10, -10, -10], "max": [10, 10, 10]}}],
"bufferViews": [{{"buffer": 0, "byteLength": {}}}],
"buffers": [{{"byteLength": {}, "uri": "data:application/octet-stream;base64,{}"}}]}}
)",
      extraMaterial, positions.size() / 3, bytes.size(), bytes.size(), encoded);
}

}  // namespace restlab::cli_test
