#include "driver/VerifyTranslation.h"

#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"
#include "sim/geometry/PartFile.h"
#include "sim/machine/Compile.h"
#include "support/Files.h"
#include "support/messages/Verify.h"

#include <algorithm>
#include <cstdlib>

namespace dotek::driver {

namespace {

// A stylus where no machine file states one, by its ball: stem and body.
constexpr double kStemShare = 0.6, kStemLength = 60, kBodyDiameter = 40, kBodyLength = 60;

std::uint32_t numberOf(const std::string& text) {
  const std::size_t at = text.find("\nO");
  return at == std::string::npos ? 0 : static_cast<std::uint32_t>(std::atoi(text.c_str() + at + 2));
}

} // namespace

bool Translation::madeUp(std::uint32_t line) const {
  return line != 0 && line <= sources.size() && sources[line - 1] && sources[line - 1]->empty();
}

bool Translation::stemsFrom(SourceRange source, std::uint32_t line, const SourceMap& files) const {
  if (!source.hasPlace() || line == 0) return true;
  if (line > sources.size()) return false;
  const auto& from = sources[line - 1];
  return !from || from->contains({files.file(source.file).name(), files.line(source)});
}

bool TargetPrograms::read(const std::string& name, std::string text, const stdlib::Control& control,
                          Session& session) {
  const FileId id = sources_.add(SourceFile(name, std::move(text), Encoding::Utf8));
  Diagnostics found;
  const frontend::macrob::File tree = frontend::macrob::parse(id, sources_, session.limits(), found);
  std::optional<ir::ProgramFile> file;
  if (!found.hasErrors()) file = frontend::macrob::lower(tree, control, sources_, found);
  if (!file) {
    for (const Diagnostic& one : found.all())
      if (one.severity == Severity::Error)
        session.diagnostics().report<diag::TranslationNotRead>({}, name, one.message);
    return false;
  }
  files_.push_back(std::move(*file));
  return true;
}

bool TargetPrograms::readTranslation(const Translation& translation, const stdlib::Control& control,
                                     Session& session) {
  translation_ = sources_.size();
  return read(translation.name, translation.text, control, session);
}

bool TargetPrograms::readMacros(const stdlib::MacroSet& set, const stdlib::Control& control,
                                Session& session) {
  const stdlib::DataFile* text = session.data().find("macrob", set.name);
  return text == nullptr || read(set.name, std::string(text->text), control, session);
}

bool TargetPrograms::compile(const stdlib::Control& control) {
  std::vector<const ir::Program*> programs;
  for (const ir::ProgramFile& file : files_)
    for (const ir::Program& program : file.programs)
      programs.push_back(&program);
  code_ = sim::compile(programs, control, sources_);
  return true;
}

Translation translationOf(const Outcome& converted) {
  Translation out;
  out.name = converted.files.front().name;
  out.text = converted.files.front().text;
  out.number = numberOf(out.text);
  if (!converted.arguments.empty()) out.arguments = converted.arguments.front();
  for (const MappedLine& line : converted.maps.front().lines) {
    auto& places = out.sources.emplace_back().emplace();
    for (const SourceRange& range : line.ranges)
      if (range.hasPlace())
        places.emplace(converted.sources.file(range.file).name(), converted.sources.line(range));
  }
  return out;
}

bool takeEdited(const std::string& path, Translation& translation, Session& session) {
  const auto bytes = readBytes(path, session.limits(), session.diagnostics());
  if (!bytes) return false;
  const SourceFile before("", translation.text, Encoding::Utf8), now("", *bytes, Encoding::Utf8);
  const std::uint32_t rows = before.lineCount(), columns = now.lineCount();
  constexpr std::uint64_t kMost = 25'000'000;
  std::vector<std::optional<std::set<std::pair<std::string, std::uint32_t>>>> sources(columns);
  if (std::uint64_t{rows} * columns <= kMost) {
    // The longest common subsequence of lines.
    std::vector<std::vector<std::uint32_t>> common(rows + 1, std::vector<std::uint32_t>(columns + 1, 0));
    for (std::uint32_t r = rows; r-- > 0;)
      for (std::uint32_t c = columns; c-- > 0;)
        common[r][c] = before.line(r + 1) == now.line(c + 1) ? common[r + 1][c + 1] + 1
                                                             : std::max(common[r + 1][c], common[r][c + 1]);
    for (std::uint32_t r = 0, c = 0; r < rows && c < columns;) {
      if (before.line(r + 1) == now.line(c + 1)) {
        if (r < translation.sources.size()) sources[c] = translation.sources[r];
        ++r, ++c;
      } else if (common[r + 1][c] >= common[r][c + 1]) {
        ++r;
      } else {
        ++c;
      }
    }
  }
  translation.name = path;
  translation.text = *bytes;
  translation.sources = std::move(sources);
  return true;
}

bool loadWorld(const VerifyOptions& options, VerifyPlan& plan, Session& session) {
  if (options.machine) {
    plan.machine =
        sim::loadMachine(*options.machine, session.limits(), session.sources(), session.diagnostics());
    if (!plan.machine) return false;
  }
  if (!options.part) return true;
  const auto part = sim::loadPart(*options.part, session.limits(), session.sources(), session.diagnostics());
  if (!part) return false;
  plan.part = part->part;
  return true;
}

sim::Probe probeFor(const VerifyPlan& plan, const verify::Case& drawn) {
  const double radius = drawn.hosts.at("tool_radius");
  sim::Probe probe;
  if (plan.machine) {
    probe = plan.machine->probe;
  } else {
    probe.length = verify::kToolLength;
    probe.stemDiameter = 2 * radius * kStemShare;
    probe.stemLength = kStemLength;
    probe.bodyDiameter = kBodyDiameter;
    probe.bodyLength = kBodyLength;
  }
  probe.ballDiameter = 2 * radius;
  probe.effectiveRadius = radius;
  probe.lengthToTip = true;
  probe.preTravel = 0; // a calibrated probe, as exact as its signal
  probe.noise = 0;
  probe.on = false;
  return probe;
}

verify::Entry entryFor(const VerifyPlan& plan, const verify::Case& drawn, bool probeOn) {
  verify::Entry entry;
  const auto host = [&](const char* name) {
    const auto found = drawn.hosts.find(name);
    return found == drawn.hosts.end() ? 0.0 : found->second;
  };
  entry.start = {host("start_x"), host("start_y"), host("start_z")};
  entry.system = drawn.system;
  entry.probeOn = probeOn;
  if (plan.machine) {
    // Where the machine's travel is stated, the cycle stands in its middle.
    double middle[3] = {};
    const sim::Point3 zero = entry.zeros[drawn.system - 54];
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const auto& span = plan.machine->limits.travel[axis])
        middle[axis] = (span->least + span->most) / 2 - (axis == 0   ? zero.x + entry.start.x
                                                         : axis == 1 ? zero.y + entry.start.y
                                                                     : zero.z + entry.start.z);
    for (sim::Point3& one : entry.zeros)
      one = one + sim::Point3{middle[0], middle[1], middle[2]};
  }
  return entry;
}

sim::Part emptyPart(const sim::Point3& middle) {
  constexpr double kAway = 10000;
  sim::PartBuilder builder;
  const sim::Point3 corner = middle + sim::Point3{0, 0, -kAway};
  builder.box(corner, corner + sim::Point3{1, 1, 1});
  std::string fault;
  return *builder.finish(fault);
}

double resultTolerance(const stdlib::Control& one, const stdlib::Control& other) {
  constexpr double kEightDigits = 5e-5;
  const auto digits = [](const stdlib::Control& control) {
    return control.arithmetic == stdlib::Arithmetic::Decimal8;
  };
  return digits(one) || digits(other) ? kEightDigits : 0;
}

} // namespace dotek::driver
