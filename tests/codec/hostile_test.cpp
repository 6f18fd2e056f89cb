// Bytes that no encoder made: an error or a valid mesh, never a crash. To be run with the asan preset too.

#include <gtest/gtest.h>

#include <chrono>

#include "codec/decode.h"
#include "codec/encode.h"
#include "tests/codec/checks.h"
#include "tests/shapes/shapes.h"

namespace tutte {
namespace {

using Bytes = std::vector<uint8_t>;
using shapes::Random;

/// Small streams that together use every part of the format.
std::vector<std::pair<std::string, Bytes>> streams() {
  std::vector<std::pair<std::string, Bytes>> list;
  for (const shapes::Named& named : shapes::allShapes()) {
    const Result<Encoded> encoded = encode(named.shape.mesh);
    if (encoded && encoded->bytes.size() <= 300) list.emplace_back(named.name, encoded->bytes);
  }
  return list;
}

TEST(Hostile, EveryPrefix) {
  for (const auto& [name, bytes] : streams()) {
    for (size_t size = 0; size < bytes.size(); ++size) {
      ASSERT_TRUE(isHarmless(std::span(bytes).first(size))) << name << " cut to " << size;
    }
  }
}

TEST(Hostile, EveryFlippedBit) {
  for (auto [name, bytes] : streams()) {
    for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
      ASSERT_TRUE(isHarmless(bytes)) << name << " bit " << bit;
      bytes[bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    }
  }
}

TEST(Hostile, BytesBehindTheEnd) {
  for (auto [name, bytes] : streams()) {
    for (int i = 0; i < 12; ++i) {
      bytes.push_back(static_cast<uint8_t>(0x5A + i));
      ASSERT_TRUE(isHarmless(bytes)) << name << " with " << i + 1 << " more bytes";
    }
  }
}

void mutate(Bytes& bytes, Random& random) {
  const auto at = [&] { return bytes.begin() + random.below(static_cast<Index>(bytes.size())); };
  switch (bytes.empty() ? 2 : random.below(6)) {
    case 0: *at() = static_cast<uint8_t>(random.next()); break;
    case 1: bytes.erase(at()); break;
    case 2: bytes.insert(bytes.empty() ? bytes.end() : at(), static_cast<uint8_t>(random.next())); break;
    case 3: *at() = random.below(2) ? 0xFF : 0x00; break;
    case 4: bytes.resize(random.below(static_cast<Index>(bytes.size() + 1))); break;
    default: *at() ^= static_cast<uint8_t>(1 << random.below(8));
  }
}

TEST(Hostile, RandomMutations) {
  const auto all = streams();
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  for (uint64_t seed = 0; std::chrono::steady_clock::now() < end; ++seed) {
    Random random(seed);
    const auto& [name, original] = all[random.below(static_cast<Index>(all.size()))];
    Bytes bytes = original;
    for (Index i = 1 + random.below(4); i > 0; --i) mutate(bytes, random);
    ASSERT_TRUE(isHarmless(bytes)) << name << " mutation " << seed;
  }
}

TEST(Hostile, Noise) {
  for (uint64_t seed = 0; seed < 20000; ++seed) {
    Random random(seed);
    Bytes bytes(random.below(80));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.next());
    ASSERT_TRUE(isHarmless(bytes)) << "noise " << seed;
  }
}

/// All bytes the same: the longest runs of one decision that a stream can ask for.
TEST(Hostile, ConstantBytes) {
  for (int value = 0; value < 256; ++value) {
    for (size_t size : {1u, 2u, 5u, 9u, 20u, 60u, 100u}) {
      ASSERT_TRUE(isHarmless(Bytes(size, static_cast<uint8_t>(value)))) << size << " times " << value;
    }
  }
}

}  // namespace
}  // namespace tutte
