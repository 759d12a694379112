// Programs of Macro B: numbers of programs and blocks, variables, calls.
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Parse.h"
#include "frontend/macrob/Walk.h"
#include "lsp/Controls.h"
#include "lsp/Index.h"
#include "project/Lowering.h"
#include "project/Session.h"
#include "project/Settings.h"
#include "stdlib/ReadCall.h"

#include <cmath>
#include <fmt/format.h>
#include <set>

namespace dotek::lsp {

namespace macrob = frontend::macrob;
namespace nc = frontend::nc;
using Role = Occurrence::Role;

namespace {

std::optional<std::uint32_t> wholeOf(const nc::Word& word) {
  const std::optional<double> value = macrob::literal(word);
  if (!value || !(*value >= 0 && *value <= 99999999) || *value != std::floor(*value)) return std::nullopt;
  return static_cast<std::uint32_t>(*value);
}

class Indexer {
public:
  Indexer(Index& index, project::Session& session, const stdlib::Control* control)
      : index_(index), session_(session), control_(control) {}

  void file(const macrob::File& file) {
    for (const macrob::Program& program : file.programs) {
      index_.programs.push_back(program.name             ? program.name->range.begin
                                : program.blocks.empty() ? 0
                                                         : program.blocks.front().range.begin);
      this->program(program);
      ++number_;
    }
  }

private:
  void program(const macrob::Program& program) {
    Symbol symbol;
    symbol.name = "(before the first O number)";
    symbol.kind = SymbolKind::Module;
    if (program.name) {
      const std::string text = program.name->kind == macrob::ProgramName::Kind::Name
                                   ? "<" + index_.utf8(program.name->text) + ">"
                                   : fmt::format("O{}", program.name->number);
      symbol.name = text;
      symbol.nameRange = program.name->range;
      add(programKey(program.name->number, program.name->text), Role::Definition, program.name->range);
    }
    if (!program.comments.empty()) symbol.detail = index_.utf8(program.comments.front().text);
    symbol.range = symbol.nameRange;
    if (!program.blocks.empty()) {
      symbol.range = program.name ? spanning(program.name->range, program.blocks.back().range)
                                  : spanning(program.blocks.front().range, program.blocks.back().range);
      if (!program.name) symbol.nameRange = program.blocks.front().range;
    }
    for (const macrob::Block& block : program.blocks)
      this->block(block, symbol);
    if (symbol.range.hasPlace()) index_.symbols.push_back(std::move(symbol));
  }

  void block(const macrob::Block& block, Symbol& symbol) {
    if (block.sequenceNumber) {
      add(blockKey(block.sequenceNumber->value), Role::Definition, block.sequenceNumber->range);
      Symbol one;
      one.name = "N" + block.sequenceNumber->digits;
      one.kind = SymbolKind::Key;
      one.range = block.range;
      one.nameRange = block.sequenceNumber->range;
      if (!block.comments.empty()) one.detail = index_.utf8(block.comments.front().text);
      symbol.children.push_back(std::move(one));
    }
    if (const macrob::Goto* jump = macrob::gotoOf(block)) {
      const std::optional<double> target = jump->target ? macrob::literal(*jump->target) : std::nullopt;
      if (target && *target >= 0 && *target <= 99999999)
        add(blockKey(static_cast<std::uint64_t>(*target)), Role::Read, jump->target->range);
      else
        index_.computedJumps = true;
    }
    const nc::Assignment* const assignment = macrob::assignmentOf(block);
    if (assignment != nullptr && assignment->variable != nullptr)
      variable(*assignment->variable, assignment->range, Role::Write);
    macrob::walk(block, [&](const nc::Expression& expression, bool) {
      if (const auto* reference = std::get_if<nc::VariableRef>(&expression.node))
        if (reference->number != nullptr) variable(*reference->number, expression.range, Role::Read);
    });
    const auto* const words = std::get_if<macrob::Words>(&block.body);
    if (words != nullptr) this->words(*words);
  }

  // `number` is that of the variable; `whole` begins at the `#`.
  void variable(const nc::Expression& number, SourceRange whole, Role role) {
    const auto* const digits = std::get_if<nc::Number>(&number.node);
    if (digits == nullptr || digits->point || !(digits->value >= 0 && digits->value < 1e8)) return;
    const auto value = static_cast<std::uint32_t>(digits->value);
    const SourceRange range{whole.file, whole.begin, number.range.end};
    const bool local = control_ != nullptr ? value <= control_->locals : value <= 33;
    const std::string key = local ? fmt::format("# {} {}", number_, value) : fmt::format("# {}", value);
    add(key, role, range);
    if (control_ == nullptr) return;
    if (std::string text = variableFact(*control_, value); !text.empty())
      index_.facts.push_back({range, std::move(text)});
  }

  void words(const macrob::Words& words) {
    for (const nc::Word& word : words.words)
      if (control_ != nullptr && (word.address == 'G' || word.address == 'M'))
        if (const std::optional<double> value = macrob::literal(word); value && *value >= 0 && *value < 1e6)
          if (std::string text =
                  codeFact(*control_, word.address, static_cast<std::uint32_t>(std::lround(*value * 10)));
              !text.empty())
            index_.facts.push_back({word.range, std::move(text)});
    const std::optional<macrob::Call> call = macrob::callOf(words);
    if (!call || call->program == nullptr) return;
    const std::optional<std::uint32_t> called = wholeOf(*call->program);
    if (call->kind == macrob::CallKind::Return) {
      return; // the block is one of the caller
    }
    if (!called) return;
    add(programKey(*called, ""), Role::Read, call->program->range);
    if (call->kind != macrob::CallKind::Subprogram) arguments(*call, *called);
  }

  void arguments(const macrob::Call& call, std::uint32_t called) {
    const stdlib::MacroSet* set = nullptr;
    for (const stdlib::MacroSet& one : session_.macroSets())
      if (set == nullptr && one.calls(called)) set = &one;
    if (set == nullptr) {
      for (const macrob::CallArgument& argument : call.arguments)
        index_.ownArguments.push_back(
            {argument.word->range, called, argument.word->address, stdlib::localOf(argument.word->address)});
      return;
    }
    index_.facts.push_back({call.program->range, programFact(*set, called)});
    std::string letters;
    for (const macrob::CallArgument& argument : call.arguments)
      letters += argument.word->address;
    const stdlib::CallReading reading = stdlib::readCall(*set, called, letters);
    for (std::size_t i = 0; i < call.arguments.size(); ++i) {
      const nc::Word& word = *call.arguments[i].word;
      const stdlib::MacroSignature* signature = reading.signature;
      const stdlib::MacroArgument* meaning = signature != nullptr ? signature->find(word.address) : nullptr;
      if (meaning == nullptr) // refused, or not finished: the first reading that has the letter
        for (const stdlib::MacroSignature* one : set->of(called))
          if (meaning == nullptr && (meaning = one->find(word.address)) != nullptr) signature = one;
      if (meaning == nullptr) continue;
      index_.facts.push_back({word.range, argumentFact(*set, *signature, *meaning)});
      if (reading.signature != nullptr)
        index_.hints.push_back({word.range.begin, argumentName(*meaning) + ":"});
    }
  }

  static std::string programKey(std::uint64_t number, const std::string& name) {
    return number == 0 && !name.empty() ? "O <" + name + ">" : fmt::format("O {}", number);
  }
  std::string blockKey(std::uint64_t number) const { return fmt::format("N {} {}", number_, number); }
  void add(std::string key, Role role, SourceRange range) {
    if (key.starts_with("N ") && known_.insert(key).second) index_.renamable.push_back(key);
    index_.occurrences.push_back({std::move(key), role, range});
  }

  Index& index_;
  project::Session& session_;
  const stdlib::Control* control_;
  std::size_t number_ = 0; // of the program
  std::set<std::string> known_;
};

} // namespace

void indexMacroB(Index& index, project::Session& session, const std::string& path) {
  Diagnostics unheard;
  const macrob::File file = macrob::parse(index.file, session.sources(), session.limits(), unheard);
  std::string control = project::settingsOf(path, session).control;
  if (control.empty()) control = project::kDefaultControl;
  const stdlib::Control* const profile = session.control(control);
  if (profile != nullptr) index.lastBlock = profile->sequenceLast;
  Indexer(index, session, profile).file(file);
}

} // namespace dotek::lsp
