// A page without a browser: a WebSocket client that collects the viewer's messages.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/view/image_message.h"

namespace restlab::view_test {

using Json = nlohmann::json;

struct ShownImage {
  ImageHeader header;
  std::vector<std::byte> pixels;
};

class Page {
 public:
  // `url`: as printed by the program.
  explicit Page(const std::string& url);
  ~Page();

  void say(const Json& command) { sayText(command.dump()); }
  void sayText(const std::string& text);

  // Returns the next message of that name for which `holds`; stores images received meanwhile.
  template <class Holds>
  Json waitFor(const std::string& name, const Holds& holds) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < end) {
      const Json text = next();
      if (text.is_null()) break;
      if (text["say"] == name && holds(text)) return text;
    }
    ADD_FAILURE() << "the viewer does not say the " << name << " that was waited for";
    return Json::object();
  }
  Json waitFor(const std::string& name) {
    return waitFor(name, [](const Json&) { return true; });
  }

  // Returns the next text; null if none arrives.
  Json next();

  // Newest image of each slot.
  const std::map<uint32_t, ShownImage>& images() const { return images_; }
  template <class Holds>
  bool waitForImage(const Holds& holds) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < end && read()) {
      if (!gotText() && holds(keepImage())) return true;
    }
    ADD_FAILURE() << "the image that was waited for does not come";
    return false;
  }

  // Bytes received so far.
  uint64_t bytes() const { return bytes_; }
  void close();

 private:
  static constexpr std::chrono::seconds kPatience{30};
  struct Socket;

  bool read();
  bool gotText() const;
  const ShownImage& keepImage();

  std::unique_ptr<Socket> socket_;
  std::map<uint32_t, ShownImage> images_;
  uint64_t bytes_ = 0;
};

}  // namespace restlab::view_test
