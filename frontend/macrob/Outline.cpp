#include "frontend/macrob/Outline.h"

#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Constant.h"
#include "frontend/macrob/Walk.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::frontend::macrob {
namespace {

class Outliner {
public:
  Outliner(OutlineProgram& out, const SourceMap& sources) : out_(out), sources_(sources) {}

  void block(const Block& block) {
    if (block.sequenceNumber)
      out_.numbers.emplace_back(block.sequenceNumber->digits, block.sequenceNumber->range);
    if (const Goto* jump = gotoOf(block))
      out_.jumps.emplace_back(sources_.textUtf8(jump->target->range), jump->target->range);
    if (const auto* words = std::get_if<Words>(&block.body)) {
      call(*words);
      contour(*words);
    }
    if (const nc::Assignment* set = assignmentOf(block)) use(*set->variable, set->range, true);
    if (const auto* print = printOf(block))
      for (const auto& piece : print->pieces)
        if (const auto* variable = std::get_if<PrintedVariable>(&piece))
          out_.variables[variable->variable].read.push_back(print->range);
    if (const auto* names = std::get_if<SetNames>(&block.body))
      for (std::uint32_t i = 0; i < names->names.size(); ++i)
        out_.variables[names->first + i].written.push_back(names->range);
    walk(block, [&](const Expression& expression, bool) {
      if (const auto* variable = std::get_if<nc::VariableRef>(&expression.node))
        use(*variable->number, expression.range, false);
    });
  }

private:
  static const Print* printOf(const Block& block) {
    if (const auto* print = std::get_if<Print>(&block.body)) return print;
    const auto* condition = std::get_if<If>(&block.body);
    return condition == nullptr ? nullptr : std::get_if<Print>(&condition->statement);
  }

  void use(const Expression& number, SourceRange range, bool written) {
    const auto value = constantOf(number);
    if (!value || *value < 0 || *value > 999999 || *value != std::floor(*value)) {
      out_.computedVariables.emplace_back("#" + sources_.textUtf8(number.range), range);
      return;
    }
    OutlineUse& use = out_.variables[static_cast<std::uint32_t>(*value)];
    (written ? use.written : use.read).push_back(range);
  }

  void call(const Words& words) {
    const auto found = callOf(words);
    if (const nc::Word* code = found ? nullptr : findCode(words, 'M', 97))
      blockCall(*code, findWord(words, 'P'));
    if (!found || found->kind == CallKind::Off || found->code == nullptr) return;
    if (found->kind == CallKind::Return) {
      if (found->program != nullptr)
        out_.jumps.emplace_back("caller's " + sources_.textUtf8(found->program->range).substr(1),
                                found->program->range);
      return;
    }
    if (found->kind == CallKind::Subprogram && found->program == nullptr && found->block != nullptr)
      return blockCall(*found->code, found->block);
    OutlineCall one;
    one.code = sources_.textUtf8(found->code->range);
    one.range = found->code->range;
    if (found->program != nullptr) {
      const auto value = literal(*found->program);
      one.computed = !value;
      one.program = value                              ? fmt::format("{}", *value)
                    : found->program->value != nullptr ? sources_.textUtf8(found->program->value->range)
                                                       : "";
    }
    out_.calls.push_back(std::move(one));
  }

  // M97 P, M98 Q: a part of the same program.
  void blockCall(const nc::Word& code, const nc::Word* block) {
    if (block == nullptr || block->value == nullptr) return;
    const auto value = literal(*block);
    out_.calls.push_back({sources_.textUtf8(code.range),
                          value ? fmt::format("N{}", *value) : "N" + sources_.textUtf8(block->value->range),
                          !value, code.range});
  }

  // Of G70 to G73 of a lathe; G73 with a level R drills.
  void contour(const Words& words) {
    const nc::Word *const first = findWord(words, 'P'), *const last = findWord(words, 'Q');
    const bool drills = findWord(words, 'R') != nullptr && findWord(words, 'Z') != nullptr;
    for (const double code : {70, 71, 72, 73})
      if (findCode(words, 'G', code) != nullptr && first != nullptr && last != nullptr && !drills)
        out_.jumps.emplace_back(fmt::format("contour of G{}, {} to {}", code,
                                            sources_.textUtf8(first->range).substr(1),
                                            sources_.textUtf8(last->range).substr(1)),
                                first->range);
  }

  OutlineProgram& out_;
  const SourceMap& sources_;
};

} // namespace

std::vector<OutlineProgram> outline(const File& file, const SourceMap& sources) {
  std::vector<OutlineProgram> out;
  for (const Program& program : file.programs) {
    OutlineProgram& one = out.emplace_back();
    if (program.name) {
      one.name = program.name->kind == ProgramName::Kind::Number  ? "O" + program.name->text
                 : program.name->kind == ProgramName::Kind::Colon ? ":" + program.name->text
                                                                  : "<" + program.name->text + ">";
      one.range = program.name->range;
    } else if (!program.blocks.empty()) {
      one.range = program.blocks.front().range;
    }
    const Comment* title = program.comments.empty() ? nullptr : &program.comments.front();
    if (title == nullptr && !program.blocks.empty() && !program.blocks.front().comments.empty() &&
        std::holds_alternative<std::monostate>(program.blocks.front().body))
      title = &program.blocks.front().comments.front();
    if (title != nullptr) {
      one.title = sources.textUtf8(title->range);
      if (one.title.starts_with('(')) one.title.erase(0, 1);
      if (one.title.ends_with(')')) one.title.pop_back();
    }
    Outliner outliner(one, sources);
    for (const Block& block : program.blocks)
      outliner.block(block);
  }
  return out;
}

} // namespace dotek::frontend::macrob
