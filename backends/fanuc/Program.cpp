#include "backends/fanuc/Program.h"

#include "backends/fanuc/ProgramBlocks.h"
#include "ir/Structure.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace dotek::backends::fanuc {

namespace {

using NameKind = ir::Program::NameKind;

class Emission {
public:
  Emission(const ir::ProgramFile& file, const ProgramContext& context) : file_(file), context_(context) {}

  std::optional<std::vector<EmittedLine>> run() {
    checkNumbers();
    AnyVariable any(context_);
    std::optional<FileModes> modes;
    if (!context_.same()) modes.emplace(file_, context_.from());
    CallLevels levels(file_);
    for (ir::Program& program : file_.programs) {
      if (modes) {
        translateVariables(program, any, context_);
        translateWords(program, *modes, context_);
      }
      checkProgram(program, levels, context_);
    }
    if (context_.diagnostics.hasErrors()) return std::nullopt;
    out_.push_back({"%", {}, ""});
    const FileExits exits(file_);
    for (const ir::Program& program : file_.programs) {
      header(program);
      ProgramNumbers numbers(file_, exits, program, context_);
      ProgramBlocks(program, numbers, context_, out_).run();
      if (const ir::Structure structure = ir::structureOf(program); structure.refused)
        context_.diagnostics.report<diag::NotStructured>(structure.refused->range, structure.refused->reason);
    }
    out_.push_back({"%", {}, ""});
    if (context_.diagnostics.hasErrors()) return std::nullopt;
    return std::move(out_);
  }

private:
  const std::optional<std::uint32_t>& number() const { return context_.options.number; }

  void checkNumbers() {
    if (number() && file_.programs.size() > 1)
      context_.diagnostics.report<diag::ProgramNumberOfSeveral>(file_.programs.front().range,
                                                                file_.programs.size());
    std::map<std::uint64_t, const ir::Program*> seen;
    for (const ir::Program& program : file_.programs) {
      const bool numbered = program.nameKind == NameKind::Number || program.nameKind == NameKind::Colon;
      if (!number() && !numbered) continue;
      const std::uint64_t value = number() ? *number() : program.number;
      if (value == 0 || value > context_.to().programLast)
        context_.diagnostics.report<diag::ProgramNumber>(program.range, value, context_.to().programLast,
                                                         context_.to().title);
      if (!seen.emplace(value, &program).second)
        context_.diagnostics.report<diag::ProgramHeaders>(program.range, value);
      if (number() && numbered && program.number != *number()) callsItself(program);
    }
  }

  void callsItself(const ir::Program& program) {
    for (const ir::ProgramStatement& statement : program.body) {
      const auto* call = std::get_if<ir::Call>(&statement.node);
      const double* value = call != nullptr && call->program ? ir::constantValue(call->program) : nullptr;
      if (value != nullptr && std::round(*value) == static_cast<double>(program.number))
        context_.diagnostics.report<diag::ProgramCallsItself>(statement.origin.range(), program.number);
    }
  }

  void header(const ir::Program& program) {
    std::string text;
    if (number()) {
      text = fmt::format("O{:04}", *number());
    } else {
      switch (program.nameKind) {
      case NameKind::None: return;
      case NameKind::Number: text = "O" + digitsOf(program); break;
      case NameKind::Colon: text = (context_.to().colonNames ? ":" : "O") + digitsOf(program); break;
      case NameKind::Name:
        if (!context_.to().programNames)
          context_.diagnostics.report<diag::ProgramNameRefused>(program.range, program.name,
                                                                context_.to().title);
        text = "<" + program.name + ">";
        break;
      }
    }
    for (const std::string& comment : program.titleComments)
      text += "(" + commentText(comment, program.range, context_) + ")";
    out_.push_back({std::move(text), {}, ""});
    if (program.range.hasPlace()) out_.back().ranges.push_back(program.range);
  }

  static std::string digitsOf(const ir::Program& program) {
    return program.name.empty() ? fmt::format("{:04}", program.number) : program.name;
  }

  ir::ProgramFile file_;
  const ProgramContext& context_;
  std::vector<EmittedLine> out_;
};

} // namespace

std::optional<std::vector<EmittedLine>> emitPrograms(const ir::ProgramFile& file,
                                                     const ProgramOptions& options, const SourceMap& sources,
                                                     Diagnostics& diagnostics) {
  Diagnostics own;
  const ProgramContext context{options, sources, own};
  auto out = Emission(file, context).run();
  for (Diagnostic& one : own.all())
    diagnostics.add(std::move(one));
  return out;
}

} // namespace dotek::backends::fanuc
