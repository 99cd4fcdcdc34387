#include "experiments/view/tev_message.h"

#include <bit>
#include <cstring>

namespace restlab {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie");

enum class Operation : uint8_t { createImage = 4, updateImage = 6 };

constexpr const char* kChannels[] = {"R", "G", "B"};
constexpr int kChannelCount = 3;

class Message {
 public:
  explicit Message(Operation operation) : bytes_(sizeof(uint32_t), '\0') {
    put(operation);
    put(uint8_t{0});  // false: tev does not take the keyboard focus
  }
  template <class Number>
  void put(Number value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void putText(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
  void putChannels() {
    put(int32_t{kChannelCount});
    for (const char* channel : kChannels) putText(channel);
  }
  void putPixels(const Image& image) {
    bytes_.append(reinterpret_cast<const char*>(image.pixels.data()),
                  image.pixels.size() * sizeof(glm::vec3));
  }
  std::string finished() {
    const auto length = uint32_t(bytes_.size());
    std::memcpy(bytes_.data(), &length, sizeof length);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

}  // namespace

std::string tevCreateMessage(const std::string& name, uint32_t width, uint32_t height) {
  Message message(Operation::createImage);
  message.putText(name);
  message.put(int32_t(width));
  message.put(int32_t(height));
  message.putChannels();
  return message.finished();
}

std::string tevUpdateMessage(const std::string& name, const Image& image) {
  Message message(Operation::updateImage);
  message.putText(name);
  message.putChannels();
  for (const int32_t side : {0, 0, int32_t(image.width), int32_t(image.height)}) message.put(side);
  // Offset of each channel, then the stride from pixel to pixel, both in floats.
  for (int64_t channel = 0; channel < kChannelCount; ++channel) message.put(channel);
  for (int channel = 0; channel < kChannelCount; ++channel) message.put(int64_t{kChannelCount});
  message.putPixels(image);
  return message.finished();
}

}  // namespace restlab
