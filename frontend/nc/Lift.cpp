#include "frontend/nc/Lift.h"

#include "frontend/nc/Findings.h"
#include "frontend/nc/Lifter.h"
#include "support/messages/Nc.h"

#include <algorithm>
#include <cmath>

namespace dotek::frontend::nc {
namespace {

// Assignments to these do not store: they stop the program with the comment as message.
constexpr std::uint32_t kAlarmVariable = 3000;
constexpr std::uint32_t kMessageVariable = 3006;

} // namespace

bool ModalState::operator==(const ModalState& other) const {
  return motion == other.motion && absolute == other.absolute && feedPerMinute == other.feedPerMinute &&
         ir::equal(feed, other.feed);
}

std::optional<std::uint32_t> codeTenths(const Word& word) {
  const std::optional<double> value = word.value ? literalOf(*word.value) : std::nullopt;
  if (!value || *value < 0 || *value > 99999) return std::nullopt;
  const double tenths = std::round(*value * 10);
  if (std::abs(tenths - *value * 10) > 1e-6) return std::nullopt;
  return static_cast<std::uint32_t>(tenths);
}

void noteModal(const Block& block, const stdlib::Control& control, std::map<int, std::string>& modal) {
  for (const Word& word : block.words) {
    const std::optional<std::uint32_t> tenths = word.address == 'G' ? codeTenths(word) : std::nullopt;
    const stdlib::CodeInfo* info = tenths ? control.find('G', *tenths) : nullptr;
    if (info != nullptr && info->group) modal.insert_or_assign(*info->group, wordText(word));
  }
}

bool lift(const Block& block, LiftContext& context, std::vector<ir::CycleStatement>& out) {
  return Lifter(block, context, out).run();
}

Lifter::Lifter(const Block& block, LiftContext& context, std::vector<ir::CycleStatement>& out)
    : block_(block), context_(context), out_(out) {
  origin_.ranges.push_back(block.range);
  origin_.block = context.nextBlock++;
  for (const Word& word : block.words)
    origin_.addresses += word.address;
}

const Word* Lifter::find(char address) const {
  const auto found = std::find_if(block_.words.begin(), block_.words.end(),
                                  [&](const Word& word) { return word.address == address; });
  return found == block_.words.end() ? nullptr : &*found;
}

bool Lifter::run() {
  if (block_.programMark) return refuse<diag::ProgramInBranch>(block_.range, "%");
  if (const Word* program = find('O')) return refuse<diag::ProgramInBranch>(program->range, "O");
  if (block_.blockDelete) return refuse<diag::BlockDeleteInBranch>(block_.range);
  for (const Word& word : block_.words) {
    if (!word.value) return refuse<diag::BareWord>(word.range, word.address);
  }
  if (block_.sequenceNumber)
    if (const auto label = context_.flow.targets.find(*block_.sequenceNumber);
        label != context_.flow.targets.end())
      enter(label->second);
  if (block_.statement) return statement();
  if (block_.port) {
    std::visit([&](const auto& node) { add(node); }, block_.port->node);
    return true;
  }
  if (!block_.assignments.empty()) return assignments();
  for (const Comment& comment : block_.comments)
    add(ir::Comment{toUtf8(comment.text, context_.encoding)});
  if (block_.words.empty()) return true;

  if (!readCodes('G')) return false;
  const auto call = std::find_if(codes_.begin(), codes_.end(), [](const Code& code) {
    return code.info != nullptr && code.info->function == stdlib::Function::MacroCall;
  });
  if (call == codes_.end()) return readCodes('M') && onePerGroup() && words();
  const Word* program = find('P');
  const std::optional<std::uint32_t> number = program == nullptr ? std::nullopt : knownTenths(*program);
  if (!number || *number % 10 != 0)
    return refuse<CallWithoutProgram>(program == nullptr ? call->word->range : program->range);
  return this->call(*number / 10, *program);
}

bool Lifter::assignments() {
  const Assignment& assignment = block_.assignments.front();
  if (isComputed(*assignment.variable)) return computedAssignment(assignment);
  const std::optional<std::uint32_t> number = variableNumber(*assignment.variable);
  if (!number) return false;
  const ir::ExpressionPtr read = formula(*assignment.value, false);
  if (!read) return false;
  std::string message;
  for (const Comment& comment : block_.comments)
    message += (message.empty() ? "" : " ") + toUtf8(comment.text, context_.encoding);
  if (*number == kAlarmVariable) {
    add(ir::Alarm{message});
    context_.flow.reachable = false;
    const double* given = ir::constantValue(read);
    context_.diagnostics.report<diag::AlarmRenumbered>(assignment.range,
                                                       given == nullptr ? "" : numberText(*given));
    return true;
  }
  if (*number == kMessageVariable) {
    const double* given = ir::constantValue(read);
    if (given == nullptr) context_.diagnostics.report<diag::MessageNumberComputed>(assignment.range);
    add(ir::Stop{false, message, given == nullptr ? 1 : *given});
    return true;
  }
  context_.stored.insert(*number);
  if (!message.empty()) add(ir::Comment{message});
  add(ir::Store{ir::constant(*number, assignment.variable->range), read});
  return true;
}

bool Lifter::computedAssignment(const Assignment& assignment) {
  const ir::ExpressionPtr number = computedNumber(*assignment.variable);
  const ir::ExpressionPtr read = number ? formula(*assignment.value, false) : nullptr;
  if (!read) return false;
  for (const Comment& comment : block_.comments)
    add(ir::Comment{toUtf8(comment.text, context_.encoding)});
  add(ir::Store{number, read});
  return true;
}

std::optional<std::uint32_t> Lifter::knownTenths(const Word& word) const {
  if (const auto tenths = codeTenths(word)) return tenths;
  const std::optional<double> known = knownNumber(*word.value);
  if (!known || *known < 0 || *known > 99999) return std::nullopt;
  const double tenths = std::round(*known * 10);
  return std::abs(tenths - *known * 10) > 1e-6 ? std::nullopt
                                               : std::optional(static_cast<std::uint32_t>(tenths));
}

bool Lifter::readCodes(char address) {
  for (const Word& word : block_.words) {
    if (word.address != address) continue;
    const std::optional<std::uint32_t> tenths = knownTenths(word);
    if (!tenths) return refuse<diag::ComputedFunction>(word.range, address);
    codes_.push_back({&word, *tenths, context_.control.find(address, *tenths)});
  }
  return true;
}

// The last of two codes of one group would win on some controls, on others it is an alarm.
bool Lifter::onePerGroup() {
  std::map<int, const Code*> seen;
  for (const Code& code : codes_) {
    if (code.word->address != 'G' || code.info == nullptr || !code.info->group) continue;
    const auto [before, fresh] = seen.emplace(*code.info->group, &code);
    if (!fresh)
      return refuse<diag::TwoFunctions>(code.word->range, wordText(*before->second->word),
                                        wordText(*code.word));
  }
  return true;
}

} // namespace dotek::frontend::nc
