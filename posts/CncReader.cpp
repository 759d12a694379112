#include "posts/Cnc.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace dotek::posts::cnc {

namespace {

constexpr std::size_t kMostRecords = 2'000'000;
constexpr std::uint32_t kMostHolderParts = 1000;
constexpr std::string_view kFormat = "/namespace/nc/format/compact-nci";

std::uint64_t bitsAt(std::string_view bytes, std::size_t at, int size) {
  std::uint64_t out = 0;
  for (int i = size; i-- > 0;)
    out = out << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  return out;
}

void appendUtf8(std::string& out, std::uint32_t point) {
  const auto tail = [&](int shift) { out += static_cast<char>(0x80 | (point >> shift & 0x3f)); };
  if (point < 0x80)
    out += static_cast<char>(point);
  else if (point < 0x800) {
    out += static_cast<char>(0xc0 | point >> 6);
    tail(0);
  } else if (point < 0x10000) {
    out += static_cast<char>(0xe0 | point >> 12);
    tail(6);
    tail(0);
  } else {
    out += static_cast<char>(0xf0 | point >> 18);
    tail(12);
    tail(6);
    tail(0);
  }
}

class Reader {
public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  std::variant<File, Fault> file() {
    try {
      start_ = 0;
      text();
      while (at_ < bytes_.size())
        record();
    } catch (const Fault& fault) {
      return fault;
    }
    return std::move(file_);
  }

private:
  [[noreturn]] void fail(std::string text) const { throw Fault{start_, std::move(text)}; }

  std::string_view take(std::size_t size) {
    if (size > bytes_.size() - at_) fail("the file ends within the record");
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  std::uint32_t word() { return static_cast<std::uint32_t>(bitsAt(take(4), 0, 4)); }
  std::uint16_t half() { return static_cast<std::uint16_t>(bitsAt(take(2), 0, 2)); }
  float single() { return finite(std::bit_cast<float>(word())); }
  double real() { return finite(std::bit_cast<double>(bitsAt(take(8), 0, 8))); }
  template <class T> T finite(T value) const {
    if (!std::isfinite(value)) fail("it holds a value that is no number");
    return value;
  }
  template <class T> T singles() {
    T out{};
    for (auto& one : out)
      one = single();
    return out;
  }

  std::string text() {
    std::string out;
    for (const char c : take(word()))
      appendUtf8(out, static_cast<unsigned char>(c));
    return out;
  }
  std::string wideText() {
    const std::uint32_t units = word();
    if (units > (bytes_.size() - at_) / 2) fail("the file ends within the record");
    const std::string_view raw = take(std::size_t{units} * 2);
    std::string out;
    for (std::size_t i = 0; i < raw.size(); i += 2) {
      std::uint32_t point = static_cast<std::uint32_t>(bitsAt(raw, i, 2));
      if (point >= 0xd800 && point < 0xe000) {
        const std::uint32_t second =
            point < 0xdc00 && i + 2 < raw.size() ? static_cast<std::uint32_t>(bitsAt(raw, i + 2, 2)) : 0;
        if (second < 0xdc00 || second >= 0xe000) fail("its text is no UTF-16");
        point = 0x10000 + ((point - 0xd800) << 10) + (second - 0xdc00);
        i += 2;
      }
      appendUtf8(out, point);
    }
    return out;
  }
  // "http://../parameter/notes" is "notes"; names of Fusion have colons, and no slash.
  std::string name() {
    std::string out = text();
    if (out.starts_with("http://")) out.erase(0, out.rfind('/') + 1);
    return out;
  }

  void record() {
    if (file_.records.size() == kMostRecords)
      fail(fmt::format("there are more than {} records", kMostRecords));
    start_ = at_;
    Record out;
    out.offset = at_;
    out.code = static_cast<Code>(word());
    out.value = value(out.code);
    file_.records.push_back(std::move(out));
  }

  Value value(Code code) {
    switch (code) {
    case Code::Version:
      for (std::uint8_t& part : file_.version)
        part = static_cast<std::uint8_t>(take(1).front());
      return {};
    case Code::Text: return named([this] { return text(); });
    case Code::WideText: return named([this] { return wideText(); });
    case Code::Integer: return named([this] { return static_cast<std::int32_t>(word()); });
    case Code::Real: return named([this] { return real(); });
    case Code::PlacedReal: return named([this] { return Double3{real(), real(), real()}; });
    case Code::Stock: {
      Box box;
      box.lower = singles<Single3>();
      box.upper = singles<Single3>();
      return box;
    }
    case Code::Comment:
    case Code::PassThrough: return text();
    case Code::Cycle: return name();
    case Code::Frame:
      text();
      text();
      for (int i = 0; i < 9; ++i)
        real();
      return {};
    case Code::Section: zero(3); return {};
    case Code::SectionEnd:
    case Code::CycleEnd: return {};
    case Code::Linear:
    case Code::Rapid:
    case Code::ArcCounterclockwise:
    case Code::ArcClockwise:
    case Code::Linear5:
    case Code::Rapid5: return move(code);
    case Code::Dwell: {
      const double seconds = single();
      zero(1);
      return seconds;
    }
    case Code::SpindleSpeed: return static_cast<double>(single());
    case Code::Command: return word();
    case Code::Extrusion: take(20); return {};
    case Code::GaugeLengths: take(16); return {};
    case Code::ToolLength1:
    case Code::ToolLength2: take(8); return {};
    case Code::Context: return context(188);
    case Code::AdditiveContext: return context(140);
    case Code::ShortTool:
    case Code::Tool:
    case Code::TurningTool:
    case Code::JetTool: return tool(code);
    }
    fail(fmt::format("record {} is not known to Dotek", static_cast<std::uint32_t>(code)));
  }

  template <class Read> Value named(Read read) {
    Named out;
    out.name = name();
    out.value = read();
    return out;
  }

  // Words that are 0 in every file that was read: what they would say is not known.
  void zero(int words) {
    for (int i = 0; i < words; ++i)
      if (word() != 0) fail("a part of it that was always 0 is not");
  }

  Value move(Code code) {
    Move out;
    out.to = singles<Single3>();
    if (code == Code::ArcClockwise || code == Code::ArcCounterclockwise) {
      out.center = singles<Single3>();
      out.normal = singles<Single3>();
    }
    if (code == Code::Linear5 || code == Code::Rapid5) out.axis = singles<Single3>();
    if (code != Code::Rapid && code != Code::Rapid5) out.feed = single();
    out.flags = half();
    out.movement = half();
    constexpr unsigned kKnown =
        kPathBegins | kPathEnds | kUnknownFlag | kCompensationLeft | kCompensationRight;
    if ((out.flags & ~kKnown) != 0 ||
        (out.flags & (kCompensationLeft | kCompensationRight)) == (kCompensationLeft | kCompensationRight))
      fail(fmt::format("flags {} of a move are not known to Dotek", out.flags));
    return out;
  }

  Value context(std::size_t size) {
    const std::size_t end = at_ + size;
    if (size > bytes_.size() - at_) fail("the file ends within the record");
    Context out;
    out.unit = word();
    take(8);
    out.origin = singles<Single3>();
    out.plane = singles<std::array<float, 9>>();
    out.wcsOrigin = singles<Single3>();
    out.wcsPlane = singles<std::array<float, 9>>();
    out.workOffset = word();
    take(12);
    out.type = word();
    if (size == 188) {
      out.spindle = word();
      take(32);
      out.quality = word();
      out.jetMode = word();
    }
    take(end - at_);
    file_.contexts.push_back(out);
    return file_.contexts.size() - 1;
  }

  Value tool(Code code) {
    Tool out;
    if (code == Code::JetTool) {
      out.kerfWidth = real();
      out.nozzleDiameter = real();
      out.cutHeight = real();
      out.pierceHeight = real();
      take(8);
      out.pressure = real();
      take(16);
      out.cutPower = real();
      out.piercePower = real();
      out.assistGas = wideText();
      wideText();
      wideText();
    } else if (code != Code::ShortTool) {
      take(40);
      out.maximumSpindleSpeed = real();
      take(56);
    }
    common(out, code == Code::TurningTool);
    file_.tools.push_back(std::move(out));
    return file_.tools.size() - 1;
  }

  // What all tools have.
  void common(Tool& out, bool turning) {
    out.type = word();
    for (double* const one : {&out.diameter, &out.tipDiameter, &out.cornerRadius, &out.taperAngle,
                              &out.fluteLength, &out.shoulderLength, &out.shaftDiameter, &out.bodyLength})
      *one = real();
    out.number = word();
    take(4);
    out.spindleSpeed = real();
    out.clockwise = word();
    out.rampSpindleSpeed = real();
    out.surfaceSpeed = real();
    out.diameterOffset = word();
    out.lengthOffset = word();
    out.compensationOffset = word();
    out.coolant = word();
    out.flutes = word();
    take(4);
    const std::uint32_t parts = word();
    take(4);
    out.unit = word();
    take(8);
    out.threadPitch = real();
    if (turning) {
      take(24);
      out.noseRadius = real();
      take(480 - 0x124);
      if (parts != 0) fail("a turning tool with a holder of parts is not known to Dotek");
      return;
    }
    if (parts > kMostHolderParts || parts > (bytes_.size() - at_) / 8)
      fail(fmt::format("the holder of the tool has {} parts", parts));
    out.holder.reserve(parts);
    for (std::uint32_t i = 0; i < parts; ++i) {
      const float height = single();
      out.holder.emplace_back(height, single());
    }
  }

  std::string_view bytes_;
  std::size_t at_ = 0, start_ = 0;
  File file_;
};

} // namespace

bool isCnc(std::string_view bytes) {
  if (bytes.size() < 4) return false;
  const std::uint64_t size = bitsAt(bytes, 0, 4);
  if (size > 200 || size + 4 > bytes.size()) return false;
  return bytes.substr(4, static_cast<std::size_t>(size)).ends_with(kFormat);
}

std::variant<File, Fault> read(std::string_view bytes) {
  return Reader(bytes).file();
}

} // namespace dotek::posts::cnc
