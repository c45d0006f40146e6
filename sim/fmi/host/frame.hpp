#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace drycut::sim::fmi::host {

// What a run and the process that holds a foreign FMU say to each other over a socket: a head, then as many
// bytes as it says. Both are of one build, on one machine.

/// What is asked, and what is answered. `refused` has a sentence behind it.
enum class FrameWord : std::uint32_t { load, step, save, restore, done, refused };

struct FrameHead {
  FrameWord word = FrameWord::done;
  std::uint32_t size = 0;  ///< of what follows [bytes]
};

/// Types of variables that are exchanged. Numbers travel as doubles.
enum class NumberKind : std::uint8_t {
  float32,
  float64,
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  boolean,
  text
};

/// A value of a variable: of an array there is one for each element, with one reference.
struct SharedVariable {
  std::uint32_t reference = 0;
  NumberKind kind = NumberKind::float64;
  std::uint32_t elements = 1;
};

/// The first thing that is asked: load a library, make an instance, begin. The answer has the outputs.
struct LoadRequest {
  int version = 2;  ///< 2 or 3
  std::string library;
  std::string resources;  ///< 2.0: a URI, 3.0: a folder
  std::string token;
  std::string name;          ///< of the instance
  std::uint64_t memory = 0;  ///< [bytes]
  bool keeps_state = false;
  std::vector<SharedVariable> parameters = {};
  std::vector<double> numbers = {};     ///< of those parameters that are no texts, an element each
  std::vector<std::string> texts = {};  ///< of those that are
  std::vector<SharedVariable> inputs = {};
  std::vector<SharedVariable> outputs = {};
};

/// A message that is written, or one that is read. Reading beyond its end throws.
class HostFrame {
 public:
  HostFrame() = default;
  explicit HostFrame(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(std::as_bytes(std::span(&value, 1)));
  }
  void put(const std::string& text) {
    put(text.size());
    put_bytes(std::as_bytes(std::span(text)));
  }
  template <class T>
  void put(const std::vector<T>& list) {
    put(list.size());
    for (const auto& each : list) put(each);
  }
  void put_bytes(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  template <class T>
  void get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&value, take(sizeof value), sizeof value);
  }
  void get(std::string& text) {
    const auto size = size_of_list(1);
    text.assign(reinterpret_cast<const char*>(take(size)), size);
  }
  template <class T>
  void get(std::vector<T>& list) {
    list.resize(size_of_list(1));
    for (auto& each : list) get(each);
  }

  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }
  [[nodiscard]] std::span<const std::byte> left() const { return std::span(bytes_).subspan(at_); }

 private:
  const std::byte* take(std::size_t size) {
    if (size > bytes_.size() - at_) throw std::runtime_error("a message is cut short");
    const auto* const begin = bytes_.data() + at_;
    at_ += size;
    return begin;
  }
  std::size_t size_of_list(std::size_t least) {
    std::size_t size = 0;
    get(size);
    if (size > (bytes_.size() - at_) / least) throw std::runtime_error("a message is cut short");
    return size;
  }

  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
};

/// Its members, in the order in which they travel: `exchange(member)` of each.
template <class Self, class Exchange>
void each_member(Self& load, const Exchange& exchange) {
  exchange(load.version);
  exchange(load.library);
  exchange(load.resources);
  exchange(load.token);
  exchange(load.name);
  exchange(load.memory);
  exchange(load.keeps_state);
  exchange(load.parameters);
  exchange(load.numbers);
  exchange(load.texts);
  exchange(load.inputs);
  exchange(load.outputs);
}

}  // namespace drycut::sim::fmi::host
