#include "sim/record/hdf5/deflate.hpp"

#include <zlib.h>

#include <array>
#include <stdexcept>

namespace drycut::sim::record {

namespace {

/// Steps from byte to byte are about as different as those of random bytes.
bool is_noise(const unsigned char* bytes, std::size_t count) {
  constexpr std::size_t stride = 4;  // a sample is enough
  std::array<unsigned, 256> steps{};
  std::size_t looked = 0;
  for (std::size_t i = 1; i < count; i += stride, ++looked)
    ++steps[static_cast<unsigned char>(bytes[i] - bytes[i - 1])];
  // Pairs that are equal: one of 256 in noise. Where it is one of 64, deflate gains next to nothing.
  double equal = 0;
  for (const double n : steps) equal += n * (n - 1);
  return 64 * equal < static_cast<double>(looked) * (static_cast<double>(looked) - 1);
}

}  // namespace

struct Deflate::Stream : z_stream {
  Stream() : z_stream{} {
    if (deflateInit(this, Z_BEST_SPEED) != Z_OK) throw std::runtime_error("no memory to compress with");
  }
  ~Stream() { deflateEnd(this); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
};

Deflate::Deflate() : stream_(std::make_unique<Stream>()) {}
Deflate::~Deflate() = default;

const std::string& Deflate::operator()(const double* numbers, std::size_t count) {
  constexpr std::size_t width = sizeof(double);
  const auto* const bytes = reinterpret_cast<const unsigned char*>(numbers);
  planes_.resize(count * width);
  auto* const planes = reinterpret_cast<unsigned char*>(planes_.data());
  for (std::size_t plane = 0; plane < width; ++plane)
    for (std::size_t i = 0; i < count; ++i) planes[plane * count + i] = bytes[i * width + plane];

  auto& stream = *stream_;
  deflateReset(&stream);
  out_.resize(deflateBound(&stream, planes_.size()) + 64 * width);  // and what a change of level costs
  stream.next_out = reinterpret_cast<unsigned char*>(out_.data());
  stream.avail_out = static_cast<unsigned>(out_.size());
  for (std::size_t plane = 0; plane < width; ++plane) {
    auto* const begin = planes + plane * count;
    deflateParams(&stream, is_noise(begin, count) ? Z_NO_COMPRESSION : Z_BEST_SPEED, Z_DEFAULT_STRATEGY);
    stream.next_in = begin;
    stream.avail_in = static_cast<unsigned>(count);
    deflate(&stream, Z_NO_FLUSH);
  }
  if (deflate(&stream, Z_FINISH) != Z_STREAM_END)
    throw std::runtime_error("what is recorded does not deflate");
  out_.resize(stream.total_out);
  return out_;
}

}  // namespace drycut::sim::record
