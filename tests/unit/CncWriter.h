// Writes `.cnc` files for tests: the layout of docs/fusion-kernel.md, byte by byte, and none of the reader's
// code.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>

namespace dotek::tests {

class CncWriter {
public:
  explicit CncWriter(std::array<int, 3> version = {2, 1, 0}) {
    latin("http://www.cimco-software.com/namespace/nc/format/compact-nci");
    word(1);
    for (const int part : version)
      bytes_ += static_cast<char>(part);
  }

  const std::string& bytes() const { return bytes_; }
  std::size_t size() const { return bytes_.size(); }

  CncWriter& word(std::uint32_t value) { return raw(value, 4); }
  CncWriter& half(std::uint32_t value) { return raw(value, 2); }
  CncWriter& single(double value) { return word(std::bit_cast<std::uint32_t>(static_cast<float>(value))); }
  CncWriter& real(double value) { return raw(std::bit_cast<std::uint64_t>(value), 8); }
  CncWriter& words(int count, std::uint32_t value = 0) {
    for (int i = 0; i < count; ++i)
      word(value);
    return *this;
  }
  CncWriter& singles(std::initializer_list<double> values) {
    for (const double value : values)
      single(value);
    return *this;
  }
  CncWriter& latin(std::string_view text) {
    word(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
    return *this;
  }

  CncWriter& text(std::string_view name, std::string_view value) { return word(10).latin(name).latin(value); }
  CncWriter& wide(std::string_view name, std::u16string_view value) {
    word(11).latin(name).word(static_cast<std::uint32_t>(value.size()));
    for (const char16_t unit : value)
      half(unit);
    return *this;
  }
  CncWriter& integer(std::string_view name, std::int32_t value) {
    return word(12).latin(name).word(static_cast<std::uint32_t>(value));
  }
  CncWriter& number(std::string_view name, double value) { return word(15).latin(name).real(value); }
  CncWriter& length(std::string_view name, double value) { return integer("kind", 2).number(name, value); }
  CncWriter& mark() { return integer("http://www.cimco-software.com/namespace/nc/marker", 0); }

  struct Place {
    std::uint32_t unit = 1, workOffset = 1, type = 0, quality = 0, jetMode = 0;
    std::array<double, 3> origin{0, 0, 51}, setup{0, 0, 51};
    std::array<double, 9> plane{1, 0, 0, 0, 1, 0, 0, 0, 1};
  };
  CncWriter& context(const Place& place) {
    word(1034).word(place.unit).word(0).word(2);
    for (const double one : place.origin)
      single(one);
    for (const double one : place.plane)
      single(one);
    for (const double one : place.setup)
      single(one);
    singles({1, 0, 0, 0, 1, 0, 0, 0, 1});
    word(place.workOffset).word(1).word(0).single(std::numeric_limits<double>::infinity());
    word(place.type).word(0).words(2).words(2, 8).words(2).word(1).word(0);
    return word(place.quality).word(place.jetMode).words(4);
  }

  struct Bit {
    std::uint32_t type = 5, number = 2, coolant = 1, clockwise = 1;
    double diameter = 4.2, taper = 0, speed = 5000, pitch = 0;
  };
  CncWriter& tool(const Bit& bit) {
    word(1035).words(26).word(bit.type).real(bit.diameter).real(0).real(0).real(bit.taper);
    for (const double one : {16.0, 24.0, 6.0, 40.0}) // flute, shoulder, shaft, body
      real(one);
    word(bit.number).word(0).real(bit.speed).word(bit.clockwise).real(bit.speed).real(0);
    word(bit.number).word(bit.number).word(0).word(bit.coolant).word(3).word(0);
    word(2).word(3).word(1).words(2).real(bit.pitch);
    singles({0, 25, 5, 30});
    return wide("http://www.cimco-software.com/namespace/nc/format/compact-nci/parameter/tool-description",
                u"cutter");
  }

  CncWriter& begin() { return word(30).words(3); }
  CncWriter& end() { return word(31); }
  CncWriter& rapid(double x, double y, double z) { return word(101).singles({x, y, z}).word(0); }
  CncWriter& linear(double x, double y, double z, double feed, std::uint32_t movement,
                    std::uint32_t flags = 0) {
    return word(100).singles({x, y, z, feed}).half(flags).half(movement);
  }
  CncWriter& arc(bool clockwise, std::initializer_list<double> toCenterNormal, double feed,
                 std::uint32_t movement) {
    return word(clockwise ? 111 : 110).singles(toCenterNormal).single(feed).half(0).half(movement);
  }
  CncWriter& command(std::uint32_t number) { return word(130).word(number); }
  CncWriter& cycle(std::string_view type) { return word(300).latin(type); }
  CncWriter& cycleEnd() { return word(301); }

  // What comes before the moves of each operation.
  CncWriter& operation(std::string_view strategy, const Place& place, const Bit& bit) {
    mark().wide("http://www.cimco-software.com/namespace/nc/parameter/notes", u"");
    text("http://www.cimco-software.com/namespace/nc/parameter/operation-strategy", strategy);
    wide("http://www.cimco-software.com/namespace/nc/parameter/operation-comment", u"Bohrung \u00d8");
    number("operation:tolerance", 0.01).context(place).tool(bit).number("movement:lead_in", 1000);
    return begin();
  }

private:
  CncWriter& raw(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i)
      bytes_ += static_cast<char>(value >> 8 * i & 0xff);
    return *this;
  }

  std::string bytes_;
};

} // namespace dotek::tests
