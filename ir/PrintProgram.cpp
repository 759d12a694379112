#include "ir/Names.h"
#include "ir/Print.h"
#include "ir/PrintStatement.h"
#include "ir/Structure.h"

#include <fmt/format.h>

namespace dotek::ir {
namespace {

std::string nameOf(const Program& program) {
  switch (program.nameKind) {
  case Program::NameKind::None: return "";
  case Program::NameKind::Number:
  case Program::NameKind::Colon: return " " + std::to_string(program.number);
  case Program::NameKind::Name: return " " + nameText(program.name);
  }
  return "";
}

std::string structureText(const Program& program, const SourceMap* sources) {
  const Structure structure = structureOf(program);
  std::string out;
  if (structure.refused)
    return withOrigin("  not structured: " + structure.refused->reason, structure.refused->range, "",
                      sources) +
           "\n";
  for (const Region& region : structure.regions) {
    const bool isLoop = region.kind == Region::Kind::Loop;
    out += fmt::format("  region {} {} to {}", isLoop ? "loop" : "if", region.begin, region.end);
    if (!isLoop && region.otherwise != region.end) out += fmt::format(" otherwise {}", region.otherwise);
    out += "\n";
  }
  return out;
}

} // namespace

LabelId Program::addLabel(ProgramLabel label) {
  labels.push_back(std::move(label));
  return static_cast<LabelId>(labels.size() - 1);
}

std::string print(const ProgramFile& file, const SourceMap* sources) {
  std::string out;
  for (const Program& program : file.programs) {
    if (!out.empty()) out += "\n";
    const Names names(program);
    out += withOrigin("program" + nameOf(program), program.range, "", sources) + "\n";
    for (const std::string& comment : program.titleComments)
      out += "  comment " + quoted(comment) + "\n";
    out += structureText(program, sources);
    out += "  body\n";
    for (const ProgramStatement& statement : program.body) {
      const bool label = std::holds_alternative<Label>(statement.node);
      out += withOrigin((label ? "  " : "    ") + statementText(statement, names), statement.origin.range(),
                        statement.origin.reason, sources) +
             "\n";
    }
  }
  return out;
}

} // namespace dotek::ir
