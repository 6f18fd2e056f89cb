#pragma once
// Test vectors of lossless floats.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <span>
#include <vector>

#include "codec/mesh.h"
#include "codec/numeral_values.h"
#include "tests/spec/numbers_over.h"

namespace tutte {

/// One stream per line: relation, systems, bytes, and the floats' bits.
class NumeralVectors {
 public:
  NumeralVectors(const Connectivity& mesh, std::ostream& out) : mesh_(mesh), out_(out) {
    for (Index corner = 0; corner < mesh.umbrellas.size(); ++corner) vertices_.push_back(mesh.vertexOf(corner));
  }

  void write() {
    const NumeralSystem thousandths{10, 5, -3, -3}, six_digits{10, 6, -12, -2}, binary{2, 24, -40, -20};
    for (const NumeralSystem& system : {thousandths, six_digits, binary}) {
      for (const double unit : {1e-3, 1e-7, 1 / 1024.0}) {
        write(1, Relation::kNone, system, floats(1, unit, 30));
        write(3, Relation::kUnitVector, system, vectors(unit));
        write(4, Relation::kUnitSum, system, floats(4, unit, 5));
        write(4, Relation::kNone, system, floats(4, unit, 3000));
      }
    }
  }

 private:
  std::vector<double> smooth(int components, double unit, Index noise) const {
    const std::vector<int32_t> numbers = numbersOver(mesh_, components, 60000, noise);
    std::vector<double> values(numbers.size());
    for (size_t i = 0; i < numbers.size(); ++i) values[i] = (numbers[i] - 9000) * unit;
    return values;
  }

  // Some that no system knows are among them.
  std::vector<uint32_t> bitsOf(std::span<const double> values) const {
    constexpr std::array<uint32_t, 4> kSpecial{0x80000000, 0x7FC00001, 0x7F7FFFFF, 1};
    std::vector<uint32_t> bits;
    for (size_t i = 0; i < values.size(); ++i) {
      bits.push_back(i % 23 == 22 ? kSpecial[i / 23 % 4] : std::bit_cast<uint32_t>(static_cast<float>(values[i])));
    }
    return bits;
  }

  std::vector<uint32_t> floats(int components, double unit, Index noise) const {
    std::vector<double> values = smooth(components, unit, noise);
    for (size_t i = 3; components == 4 && i < values.size(); i += 4) {
      values[i] = 1 - values[i - 1] - values[i - 2] - values[i - 3];
    }
    return bitsOf(values);
  }

  std::vector<uint32_t> vectors(double unit) const {
    std::vector<double> values = smooth(3, unit, 100);
    for (size_t i = 0; i < values.size(); i += 3) {
      const double length = std::hypot(values[i], values[i + 1], values[i + 2]);
      for (size_t k = i; k < i + 3 && length > 0; ++k) values[k] = std::round(values[k] / length * 1e6) / 1e6;
    }
    return bitsOf(values);
  }

  void write(int components, Relation relation, const NumeralSystem& system, std::span<const uint32_t> floats) {
    const ValueGraph graph(mesh_, vertices_, mesh_.vertex_count);
    NumeralFormat format{components, relation, {}};
    format.systems.fill(system);
    if (!format.valid()) return;
    const std::vector<uint8_t> bytes = encodeNumerals(graph, format, floats);
    const auto decoded = decodeNumerals(graph, format, bytes);
    if (!decoded || !std::ranges::equal(*decoded, floats)) out_.setstate(std::ios::failbit);
    out_ << static_cast<int>(relation) << ' ';
    for (int i = 0; i < components; ++i) {
      out_ << (i == 0 ? "" : ";") << system.radix << ',' << system.digits << ',' << system.least << ',' << system.top;
    }
    out_ << ' ' << std::hex;
    for (const uint8_t byte : bytes) out_ << byte / 16 << byte % 16;
    out_ << std::dec << ' ';
    for (size_t i = 0; i < floats.size(); ++i) out_ << (i == 0 ? "" : ",") << floats[i];
    out_ << '\n';
  }

  const Connectivity& mesh_;
  std::ostream& out_;
  std::vector<Index> vertices_;
};

}  // namespace tutte
