#include "backends/fanuc/ProgramNumbers.h"

#include "ir/Flow.h"
#include "ir/Walk.h"
#include "stdlib/CalledProgram.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>

namespace dotek::backends::fanuc {

namespace {

std::optional<std::uint64_t> wholeOf(const ir::ExpressionPtr& expression) {
  const double* value = expression ? ir::constantValue(expression) : nullptr;
  if (value == nullptr || *value < 0 || *value > 99999999) return std::nullopt;
  return static_cast<std::uint64_t>(std::llround(*value));
}

bool isNumbered(const ir::ProgramLabel& label) {
  return label.number != 0 || !label.digits.empty();
}

// Which programs a statement calls, by a call or by a code of `[[calls]]`.
struct Called {
  std::vector<std::uint64_t> programs;
  bool computed = false;
};

void callsOf(const ir::Word& word, const stdlib::Control& control, Called& out) {
  for (const stdlib::CallCode& code : control.callCodes) {
    if (word.address != code.letter || code.program == 0) continue; // 0: a block of the same program
    const auto number = wholeOf(word.value);
    if (code.letter == 'T')
      out.programs.push_back(code.program);
    else if (!number)
      for (std::uint32_t i = 0; i < code.count; ++i)
        out.programs.push_back(code.program + i);
    else if (*number >= code.first && *number - code.first < code.count)
      out.programs.push_back(code.program + (*number - code.first));
  }
}

Called calledBy(const ir::ProgramStatement& statement, const stdlib::Control& control) {
  Called out;
  match(
      statement,
      [&](const ir::Call& call) {
        if (call.kind == ir::CallKind::Off) return;
        if (const auto number = wholeOf(call.program)) {
          const bool counts = call.kind == ir::CallKind::Subprogram && !call.repeats;
          out.programs.push_back(counts ? stdlib::subprogramCall(*number, control).program : *number);
        } else {
          out.computed = true;
        }
      },
      [&](const ir::NcBlock& block) {
        for (const ir::Word& word : block.words)
          callsOf(word, control, out);
      },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::JumpTo, ir::Loop,
                         ir::LoopEnd, ir::Exit, ir::Raise, ir::Notice, ir::Port, ir::Print,
                         ir::NameVariables> auto&) {});
  return out;
}

std::string digitsOf(const ir::ProgramLabel& label) {
  return label.digits.empty() ? std::to_string(label.number) : label.digits;
}

} // namespace

std::map<ir::LabelId, std::uint64_t> renumbered(const ir::Program& program, std::uint64_t start,
                                                std::uint64_t step) {
  std::map<ir::LabelId, std::uint64_t> out;
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* label = std::get_if<ir::Label>(&statement.node);
    if (label == nullptr || !isNumbered(program.labels[label->label])) continue;
    if (out.emplace(label->label, start).second) start += step;
  }
  return out;
}

FileExits::FileExits(const ir::ProgramFile& file) {
  for (const ir::Program& program : file.programs) {
    for (const ir::ProgramStatement& statement : program.body) {
      const auto* exit = std::get_if<ir::Exit>(&statement.node);
      if (exit == nullptr || !exit->block) continue;
      if (const auto number = wholeOf(exit->block))
        numbers.insert(*number);
      else if (!computed.hasPlace())
        computed = statement.origin.range();
    }
  }
}

ProgramNumbers::ProgramNumbers(const ir::ProgramFile& file, const FileExits& exits,
                               const ir::Program& program, const ProgramContext& context)
    : file_(file), exits_(exits), program_(program), context_(context) {
  for (ir::LabelId id = 0; id < program.labels.size(); ++id)
    if (isNumbered(program.labels[id])) digits_.emplace(id, digitsOf(program.labels[id]));
  if (context.options.renumber) renumber();
  for (const auto& [id, text] : digits_)
    used_.insert(std::stoull(text));
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* jump = std::get_if<ir::JumpTo>(&statement.node);
    if (jump == nullptr) continue;
    if (const auto number = wholeOf(jump->number))
      used_.insert(*number);
    else if (!computed_.hasPlace())
      computed_ = statement.origin.range();
  }
  if (!computed_.hasPlace()) computed_ = exits.computed;
  if (!context.options.renumber) checkJumps();
}

void ProgramNumbers::renumber() {
  Diagnostics& diagnostics = context_.diagnostics;
  const std::uint32_t last = context_.to().sequenceLast;
  bool callsOut = false;
  for (const ir::ProgramStatement& statement : program_.body) {
    const SourceRange range = statement.origin.range();
    if (std::holds_alternative<ir::JumpTo>(statement.node))
      diagnostics.report<diag::RenumberComputed>(range, "GOTO");
    const auto* exit = std::get_if<ir::Exit>(&statement.node);
    if (exit != nullptr && exit->block && !wholeOf(exit->block))
      diagnostics.report<diag::RenumberComputed>(range, "M99 P");
    const Called called = calledBy(statement, context_.from());
    callsOut = callsOut || called.computed ||
               std::any_of(called.programs.begin(), called.programs.end(),
                           [&](std::uint64_t number) { return onlyProgram(number) == nullptr; });
    const std::optional<int>& words = context_.from().variables.modalWords;
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* machine = std::get_if<ir::MachineVariable>(&node.node);
      if (machine != nullptr && words && wholeOf(machine->number) == static_cast<std::uint64_t>(*words + 14))
        diagnostics.report<diag::RenumberRead>(range, *words + 14);
    });
  }
  for (const auto& [id, number] :
       renumbered(program_, context_.options.renumber->first, context_.options.renumber->second)) {
    digits_[id] = std::to_string(number);
    if (number <= last) continue;
    diagnostics.report<diag::RenumberRange>(program_.labels[id].range, number, last, context_.to().title);
    return;
  }
  if (callsOut && !digits_.empty())
    diagnostics.report<diag::RenumberCalls>(program_.range, "`--renumber`: ", "", "");
}

// A GOTO names a number, and the control searches for it: forward, then from the top.
void ProgramNumbers::checkJumps() {
  std::map<std::uint64_t, std::vector<std::size_t>> places;
  const std::vector<ir::ProgramStatement>& body = program_.body;
  for (std::size_t i = 0; i < body.size(); ++i)
    if (const auto* label = std::get_if<ir::Label>(&body[i].node); label && digits_.contains(label->label))
      places[program_.labels[label->label].number].push_back(i);
  for (std::size_t i = 0; i < body.size(); ++i) {
    const auto target = ir::targetOf(body[i]);
    if (!target || !digits_.contains(*target)) continue;
    const SourceRange range = body[i].origin.range();
    const std::uint64_t number = program_.labels[*target].number;
    const std::vector<std::size_t>& all = places[number];
    const auto next = std::upper_bound(all.begin(), all.end(), i);
    const std::size_t met = all.empty() ? body.size() : next == all.end() ? all.front() : *next;
    if (met == body.size() || std::get<ir::Label>(body[met].node).label != *target)
      context_.diagnostics.report<diag::StatementNotOfProgram>(range,
                                                               "a jump that its number does not lead to");
    else if (number > context_.to().sequenceLast)
      context_.diagnostics.report<diag::BlockNumberRange>(range, number, context_.to().sequenceLast,
                                                          context_.to().title);
  }
}

std::string ProgramNumbers::digits(ir::LabelId label) const {
  const auto found = digits_.find(label);
  return found == digits_.end() ? "" : found->second;
}

std::string ProgramNumbers::target(ir::LabelId label) const {
  const std::string text = digits(label);
  return text.empty() ? text : std::to_string(std::stoull(text));
}

void ProgramNumbers::add(ir::LabelId label, SourceRange from) {
  if (digits_.contains(label)) return;
  const std::uint64_t last = context_.to().sequenceLast;
  if (computed_.hasPlace()) {
    context_.diagnostics.report<diag::NewNumberMet>(from, context_.to().title)
        .note(computed_, "the number that is computed");
    digits_.emplace(label, "0");
    return;
  }
  // Numbers above the last one are no targets here.
  const auto mostOf = [&](const std::set<std::uint64_t>& numbers) {
    const auto above = numbers.upper_bound(last);
    return above == numbers.begin() ? 0 : *std::prev(above);
  };
  const std::uint64_t most = std::max(mostOf(used_), mostOf(exits_.numbers));
  std::uint64_t number = most / 10 * 10 + 10;
  if (number > last) {
    number = last;
    while (number > 0 && (used_.contains(number) || exits_.numbers.contains(number)))
      --number;
  }
  if (number == 0) context_.diagnostics.report<diag::TooManyJumps>(from, context_.to().title, last);
  used_.insert(number);
  digits_.emplace(label, std::to_string(number));
}

const ir::Program* ProgramNumbers::onlyProgram(std::uint64_t number) const {
  const auto found = std::find_if(file_.programs.begin(), file_.programs.end(), [&](const ir::Program& one) {
    return one.number == number && number != 0;
  });
  return found == file_.programs.end() ? nullptr : &*found;
}

// The programs of the file that call this one, with their numbers before and after.
void ProgramNumbers::findCallers() {
  callers_ = Callers{{}, false};
  for (const ir::Program& caller : file_.programs) {
    bool calls = false;
    for (const ir::ProgramStatement& statement : caller.body) {
      const Called called = calledBy(statement, context_.from());
      callers_->open = callers_->open || called.computed;
      calls = calls || (program_.number != 0 &&
                        std::count(called.programs.begin(), called.programs.end(), program_.number) != 0);
    }
    if (!calls) continue;
    std::map<std::uint64_t, std::uint64_t>& now = callers_->numbers.emplace_back();
    for (const auto& [id, number] :
         renumbered(caller, context_.options.renumber->first, context_.options.renumber->second))
      // Of two blocks with one number the place of the call decides: 0, it is not followed.
      if (!now.emplace(caller.labels[id].number, number).second) now[caller.labels[id].number] = 0;
  }
}

ir::ExpressionPtr ProgramNumbers::exitTo(const ir::Exit& exit, SourceRange range) {
  const auto number = exit.block ? wholeOf(exit.block) : std::nullopt;
  if (!context_.options.renumber || !number) return exit.block;
  if (!callers_) findCallers();
  const bool own = std::any_of(program_.labels.begin(), program_.labels.end(),
                               [&](const ir::ProgramLabel& label) { return label.number == *number; });
  if (callers_->numbers.empty() && !callers_->open && !own) {
    context_.diagnostics.report<diag::RenumberReturn>(range, *number);
    return exit.block;
  }
  std::set<std::uint64_t> now;
  for (const auto& numbers : callers_->numbers) {
    const auto found = numbers.find(*number);
    now.insert(found == numbers.end() ? 0 : found->second);
  }
  if (callers_->open || now.size() != 1 || now.contains(0)) {
    context_.diagnostics.report<diag::RenumberCallers>(range, *number);
    return exit.block;
  }
  return ir::constant(static_cast<double>(*now.begin()), exit.block->range, std::to_string(*now.begin()));
}

} // namespace dotek::backends::fanuc
