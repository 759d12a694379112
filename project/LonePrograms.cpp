#include "project/LonePrograms.h"

#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"
#include "project/Programs.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <utility>

namespace dotek::project {
namespace {

namespace macrob = frontend::macrob;

std::uint32_t beginOf(const macrob::Program& program) {
  if (program.name) return program.name->range.begin;
  return 0; // only the first one lacks a name
}

// A block that is no part of the program, or not the one that was written.
bool isBroken(const macrob::Block& block) {
  return block.repaired || std::holds_alternative<macrob::Unread>(block.body);
}

// Between the bounds, in bytes; without a place: everywhere.
bool isWithin(const SourceRange& range, std::uint32_t begin, std::uint32_t end) {
  return !range.hasPlace() || (range.begin >= begin && range.begin < end);
}

} // namespace

std::vector<LoneProgram> lonePrograms(FileId file, const stdlib::Control& control, Session& session) {
  Diagnostics found;
  macrob::File tree = macrob::parse(file, session.sources(), session.limits(), found, textOf(file, session),
                                    macrob::Reader::Fast, macrob::formsOf(control));
  std::erase_if(found.all(), [](const Diagnostic& d) { return d.severity != Severity::Error; });
  std::vector<LoneProgram> out(tree.programs.size());
  bool explained = false; // an error of the file is one of a program
  for (std::size_t i = 0; i < out.size(); ++i) {
    LoneProgram& one = out[i];
    const std::uint32_t begin = i == 0 ? 0 : beginOf(tree.programs[i]);
    const std::uint32_t end = i + 1 < out.size() ? beginOf(tree.programs[i + 1]) : UINT32_MAX;
    for (const Diagnostic& d : found.all())
      if (isWithin(d.range, begin, end)) one.found.add(d);
    one.file.file = file;
    one.file.markFirst = tree.markFirst;
    one.file.markLast = tree.markLast;
    if (i == 0) one.file.leader = tree.leader;
    for (const SourceRange& legend : tree.legends)
      if (isWithin(legend, begin, end)) one.file.legends.push_back(legend);
    const std::vector<macrob::Block>& blocks = tree.programs[i].blocks;
    one.file.hasErrors = one.found.hasErrors() || std::any_of(blocks.begin(), blocks.end(), isBroken);
    explained = explained || one.file.hasErrors;
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (tree.hasErrors && !explained) out[i].file.hasErrors = true;
    if (tree.programs[i].name) out[i].number = tree.programs[i].name->number;
    out[i].file.programs.push_back(std::move(tree.programs[i]));
  }
  // A control keeps the number; the text of the file may lack it.
  if (!out.empty() && !out.front().file.programs.front().name)
    out.front().number =
        numberOfName(std::filesystem::path(session.sources().file(file).name()).filename().string());
  return out;
}

std::optional<ir::Program> lowerAlone(LoneProgram& program, const stdlib::Control& control,
                                      Session& session) {
  for (Diagnostic& one : program.found.all())
    session.diagnostics().add(std::move(one));
  program.found = Diagnostics();
  std::optional<ir::ProgramFile> lowered =
      macrob::lower(program.file, control, session.sources(), session.diagnostics());
  if (!lowered || lowered->programs.empty()) return std::nullopt;
  ir::Program out = std::move(lowered->programs.front());
  if (out.nameKind == ir::Program::NameKind::None && program.number != 0) {
    out.nameKind = ir::Program::NameKind::Number;
    out.number = program.number;
  }
  return out;
}

std::vector<std::uint64_t> programNumbers(std::string_view text) {
  std::vector<std::uint64_t> out;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n;", at), text.size());
    std::string_view line = text.substr(at, end - at);
    at = end + 1;
    line.remove_prefix(std::min(line.find_first_not_of(" \t%"), line.size()));
    if (line.empty() || (line[0] != 'O' && line[0] != 'o' && line[0] != ':')) continue;
    line.remove_prefix(std::min(line.find_first_not_of(" \t", 1), line.size()));
    std::uint64_t number = 0;
    if (std::from_chars(line.data(), line.data() + line.size(), number).ec == std::errc())
      out.push_back(number);
  }
  return out;
}

std::uint64_t numberOfName(std::string_view fileName) {
  const std::string_view stem = fileName.substr(0, fileName.find('.'));
  std::uint64_t number = 0;
  if (stem.size() < 2 || (stem[0] != 'O' && stem[0] != 'o')) return 0;
  const auto [end, error] = std::from_chars(stem.data() + 1, stem.data() + stem.size(), number);
  return error == std::errc() && end == stem.data() + stem.size() ? number : 0;
}

} // namespace dotek::project
