// Numbers of variables, what is written, and places where a `#` is missing or misplaced.
#include "frontend/macrob/Check.h"
#include "frontend/macrob/Format.h"
#include "frontend/macrob/Walk.h"
#include "stdlib/ControlFacts.h"
#include "stdlib/DataFiles.h"
#include "stdlib/VariableNumbers.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace dotek::frontend::macrob {
namespace {

constexpr std::uint32_t kLastLocal = 33;
constexpr std::uint32_t kFirstSystem = 1000;
constexpr std::uint32_t kFirstLongTable = 10000; // of tool offsets beyond #2001 to #2800

// Bases of tables of tool offsets: they are read by `#[2000+#7]`, and hold nothing themselves.
bool isTableBase(std::uint32_t number) {
  return number == 2000 || number == 10000 || number == 11000 || number == 12000 || number == 13000;
}

// The number that a computed number of a variable counts from: 10000 of #[10000+#20].
std::optional<std::uint32_t> countsFrom(const Expression& number) {
  const auto* sum = std::get_if<nc::Operation>(&number.node);
  if (sum == nullptr || sum->op != "+") return std::nullopt;
  for (const auto& side : {&sum->left, &sum->right})
    if (const auto* base = std::get_if<nc::Number>(&(*side)->node))
      return base->value >= 0 && base->value <= 999999
                 ? std::optional(static_cast<std::uint32_t>(base->value))
                 : std::nullopt;
  return countsFrom(*sum->left);
}

// Zero points of work systems, on any control.
bool isWorkOffset(std::uint32_t number) {
  return (number >= 2500 && number <= 2899) || (number >= 5201 && number <= 5340) ||
         (number >= 7001 && number <= 7960) || (number >= 14001 && number <= 20000);
}

std::string printWithoutBrackets(const Expression& expression) {
  std::string text = print(expression);
  return text.substr(expression.brackets, text.size() - 2 * expression.brackets);
}

// Texts of all parts of one long sum take the square of its length; nobody misses a `#` in one of those.
bool isShort(const SourceRange& range) {
  constexpr std::uint32_t kMost = 200; // bytes
  return range.end - range.begin <= kMost;
}

template <class Visit> void eachAssignment(const CheckedProgram& input, const Visit& visit) {
  for (const Block& block : input.program.blocks)
    if (const nc::Assignment* assignment = assignmentOf(block)) visit(*assignment);
}

// The number of the variable that is assigned, with `#` and digits as its place; nothing where it is
// computed.
struct Written {
  std::uint32_t number = 0;
  SourceRange range;
};
std::optional<Written> writtenBy(const nc::Assignment& assignment) {
  const auto* number = std::get_if<nc::Number>(&assignment.variable->node);
  if (number == nullptr) return std::nullopt;
  return Written{static_cast<std::uint32_t>(number->value > 999999 ? 999999 : number->value),
                 {assignment.range.file, assignment.range.begin, assignment.variable->range.end}};
}

// Sums and the like that the program uses as the number of a variable, #[..].
std::set<std::string> subscriptsOf(const CheckedProgram& input) {
  std::set<std::string> out;
  for (const CheckedProgram::Part& part : input.parts)
    if (const auto* variable = std::get_if<nc::VariableRef>(&part.expression->node))
      if (std::holds_alternative<nc::Operation>(variable->number->node))
        out.insert(printWithoutBrackets(*variable->number));
  eachAssignment(input, [&](const nc::Assignment& assignment) {
    if (std::holds_alternative<nc::Operation>(assignment.variable->node))
      out.insert(printWithoutBrackets(*assignment.variable));
  });
  return out;
}

} // namespace

// ---- numbers

// What a built-in profile says of its common variables, where nobody has stated it: "inferred, K: .."
static std::string inferredRanges(const stdlib::Control& control) {
  if (control.origin != "built in") return {};
  for (const stdlib::ControlFact& fact : stdlib::controlFacts(stdlib::DataFiles(), control.name))
    if (fact.section == "common" && fact.first == 100 &&
        (fact.grade == "inferred" || fact.grade == "assumed"))
      return fmt::format("{}, {}", fact.grade, fact.source);
  return {};
}

void variableOutOfRange(const CheckedProgram& input, Report& report) {
  const stdlib::Control* control = input.control;
  std::vector<std::pair<std::uint32_t, SourceRange>> found; // each number at its first place
  const auto judge = [&](std::uint32_t number, SourceRange range) {
    if (number <= (control != nullptr ? control->locals : kLastLocal) || number >= kFirstSystem) return;
    const bool known = control != nullptr
                           ? control->isCommon(number)
                           : (number >= 100 && number <= 199) || (number >= 500 && number <= 999);
    if (known ||
        std::any_of(found.begin(), found.end(), [&](const auto& one) { return one.first == number; }))
      return;
    found.emplace_back(number, range);
  };
  // Block by block, so that the first use is the one that is reported.
  for (const Block& block : input.program.blocks) {
    walk(block, [&](const Expression& expression, bool) {
      if (const auto number = variableNumber(expression)) judge(*number, expression.range);
    });
    if (const nc::Assignment* assignment = assignmentOf(block))
      if (const auto written = writtenBy(*assignment)) judge(written->number, written->range);
    if (const auto* print = std::get_if<Print>(&block.body))
      for (const auto& piece : print->pieces)
        if (const auto* variable = std::get_if<PrintedVariable>(&piece))
          judge(variable->variable, print->range);
  }
  if (found.empty()) return;
  // #200 to #499 are an option of some controls; only a profile that states it says that this one has none.
  const bool option = std::all_of(found.begin(), found.end(),
                                  [](const auto& one) { return one.first >= 200 && one.first <= 499; });
  const std::string inferred = option && control != nullptr ? inferredRanges(*control) : "";
  if (option && (control == nullptr || !inferred.empty())) {
    Diagnostic& told =
        control == nullptr
            ? report.at(found.front().second,
                        "#{} is of the range #200 to #499, which Fanuc controls have as an option "
                        "alone; without it the control "
                        "stops with alarm 115; name the machine with `--control`, or take a "
                        "variable of #100 to #199 or #500 to #999",
                        found.front().first)
            : report.at(
                  found.front().second,
                  "#{} is none of the common variables that `{}` lists ({}); the control stops with "
                  "alarm 115 unless the machine has it as an option; where it has, list it in a profile "
                  "of your own (`dotek new control NAME --from {}`), else take a variable of #100 to "
                  "#199 or #500 to #999",
                  found.front().first, control->name, inferred, control->name);
    told.severity = Severity::Warning;
    for (std::size_t i = 1; i < found.size(); ++i)
      told.note(found[i].second, fmt::format("#{} first appears here", found[i].first));
    return;
  }
  Diagnostic& told = report.at(
      found.front().second,
      "{} has no variable #{}{}; the control stops with alarm 115; take one of the ranges that `dotek list "
      "controls` "
      "prints",
      control != nullptr ? "this control" : "a Fanuc control", found.front().first,
      found.size() > 1 ? fmt::format(", nor {} others that the program uses", found.size() - 1) : "");
  for (std::size_t i = 1; i < found.size(); ++i)
    told.note(found[i].second, fmt::format("#{} first appears here", found[i].first));
}

void nullWritten(const CheckedProgram& input, Report& report) {
  eachAssignment(input, [&](const nc::Assignment& assignment) {
    if (const auto written = writtenBy(assignment); written && written->number == 0)
      report.at(written->range,
                "#0 takes no value; the control stops with alarm 116; write the variable that is meant");
  });
}

void readOnlyWritten(const CheckedProgram& input, Report& report) {
  eachAssignment(input, [&](const nc::Assignment& assignment) {
    const auto written = writtenBy(assignment);
    if (!written || written->number == 0 || !input.onEach([&](const stdlib::Control& control) {
          return stdlib::isReadAlone(control, written->number);
        }))
      return;
    report.at(written->range, "#{} can only be read{}; the control stops with alarm 116", written->number,
              input.control == nullptr ? " on " + input.machineText() : "");
  });
}

void systemVariableUnknown(const CheckedProgram& input, Report& report) {
  std::set<std::uint32_t> told;
  std::string names;
  SourceRange first;
  bool mixed = false; // on some profiles it can be read only
  const auto isUnknown = [&](std::uint32_t number, bool written = false) {
    const auto readAlone = [&](const stdlib::Control& control) {
      return stdlib::isReadAlone(control, number);
    };
    const auto unknown = [&](const stdlib::Control& control) {
      // Common ones of some controls have such numbers, too.
      const bool common =
          std::any_of(control.common.begin(), control.common.end(), [&](const stdlib::VariableRange& range) {
            return number >= range.first && number <= range.last;
          });
      return !common && !stdlib::namesVariable(control, number);
    };
    if (input.onEach(unknown)) return true;
    const bool one = written && !input.onEach(readAlone) && input.onEach([&](const auto& control) {
      return unknown(control) || readAlone(control);
    });
    mixed = mixed || one;
    return one;
  };
  const auto judge = [&](std::uint32_t number, SourceRange range, bool written = false) {
    if (number < kFirstSystem || isTableBase(number) || told.contains(number) || !isUnknown(number, written))
      return;
    told.insert(number);
    if (names.empty()) first = range;
    names += fmt::format("{}#{}", names.empty() ? "" : ", ", number);
  };
  // Tables of tool offsets, of which this control has not even the first.
  const auto judgeTable = [&](const Expression& number, SourceRange range) {
    const auto base = countsFrom(number);
    if (!base || *base < kFirstLongTable || !isTableBase(*base) || !isUnknown(*base + 1) ||
        !told.insert(*base).second)
      return;
    if (names.empty()) first = range;
    names += fmt::format("{}#[{}+n]", names.empty() ? "" : ", ", *base);
  };
  for (const Block& block : input.program.blocks) {
    walk(block, [&](const Expression& expression, bool) {
      if (const auto number = variableNumber(expression)) judge(*number, expression.range);
      if (const auto* variable = std::get_if<nc::VariableRef>(&expression.node))
        judgeTable(*variable->number, expression.range);
    });
    if (const nc::Assignment* assignment = assignmentOf(block)) {
      if (const auto written = writtenBy(*assignment)) judge(written->number, written->range, true);
      judgeTable(*assignment->variable,
                 {assignment->range.file, assignment->range.begin, assignment->variable->range.end});
    }
  }
  if (names.empty()) return;
  if (input.control != nullptr) {
    report.at(
        first,
        "the profile of {} does not know {}; the control may stop with alarm 115, and a run ends here; take "
        "other variables, or describe these in the control's file",
        input.control->title, names);
    return;
  }
  // Some other control may have them.
  report
      .at(first,
          "no profile of Dotek knows {}{}; a control without such a variable stops with alarm 115, and a run "
          "ends here; correct the number, or name the machine with `--control`, whose file can describe it",
          names, mixed ? ", or lets a program set it" : "")
      .severity = Severity::Note;
}

// ---- `#` at the wrong place

// ABS[#13+#12] where the program has #[#13+#12]: the sum of two numbers of variables has no meaning.
void subscriptAsValue(const CheckedProgram& input, Report& report) {
  std::optional<std::set<std::string>> subscripts;
  for (const CheckedProgram::Part& part : input.parts) {
    const auto* call = std::get_if<nc::FunctionCall>(&part.expression->node);
    if (call == nullptr || call->arguments.size() != 1 || call->bare) continue;
    const Expression& argument = *call->arguments.front();
    const auto* sum = std::get_if<nc::Operation>(&argument.node);
    if (sum == nullptr || (sum->op != "+" && sum->op != "-") || !variableNumber(*sum->left) ||
        !variableNumber(*sum->right))
      continue;
    if (!subscripts) subscripts = subscriptsOf(input);
    const std::string text = printWithoutBrackets(argument);
    if (!subscripts->contains(text)) continue;
    const SourceRange range = argument.range;
    report
        .at(range,
            "the function takes the sum `{0}` itself, which the program uses as the number of a variable "
            "elsewhere; "
            "the control calculates with the number and gives no alarm; write `#[{0}]` for the variable",
            text)
        .fix =
        Fix{Fix::Applicability::Display,
            "write `#[" + text + "]`",
            {{{range.file, range.begin, range.begin}, "#["}, {{range.file, range.end, range.end}, "]"}}};
  }
}

// [#2000+#7] for #[2000+#7]
void tableBaseRead(const CheckedProgram& input, Report& report) {
  for (const CheckedProgram::Part& part : input.parts) {
    const Expression& expression = *part.expression;
    const auto* operation = std::get_if<nc::Operation>(&expression.node);
    if (operation == nullptr || operation->op != "+" || expression.brackets == 0) continue;
    const auto base = variableNumber(*operation->left);
    if (!base || !isTableBase(*base) || !std::holds_alternative<nc::VariableRef>(operation->right->node))
      continue;
    const SourceRange left = operation->left->range;
    const SourceRange hash{left.file, left.begin, left.begin + 1};
    const SourceRange open{left.file, expression.range.begin, expression.range.begin};
    const std::string offset = print(*operation->right);
    report
        .at(left,
            "#{0} is read and {1} added; #{0} holds nothing, so the offset is not read and no alarm comes; "
            "write "
            "`#[{0}+{1}]`",
            *base, offset)
        .fix = Fix{Fix::Applicability::Display,
                   fmt::format("write `#[{}+{}]`", *base, offset),
                   {{open, "#"}, {hash, ""}}};
  }
}

namespace {

constexpr std::uint32_t kFirstCommonNumber = 100;

// What a program writes with `#`, to find the place where it is lost.
class Hashes {
public:
  // `used`: its variables, ascending.
  Hashes(const CheckedProgram& input, const std::vector<std::uint32_t>& used) : used_(used) {
    for (const CheckedProgram::Part& part : input.parts)
      if (std::holds_alternative<nc::Operation>(part.expression->node) && isShort(part.expression->range))
        operations_.insert(printWithoutBrackets(*part.expression));
    // Variables that hold the number of another one: #16 of #[#16], #[#16+1].
    std::set<std::uint32_t> pointers;
    const auto addPointers = [&](const Expression& subscript) {
      walk(subscript, [&](const Expression& part, bool) {
        if (const auto number = variableNumber(part)) pointers.insert(*number);
      });
    };
    for (const CheckedProgram::Part& part : input.parts)
      if (const auto* variable = std::get_if<nc::VariableRef>(&part.expression->node))
        addPointers(*variable->number);
    eachAssignment(input, [&](const nc::Assignment& one) { addPointers(*one.variable); });
    eachAssignment(input, [&](const nc::Assignment& one) {
      if (const auto written = writtenBy(one); written && pointers.contains(written->number))
        addTerms(*one.value);
    });
  }

  // 100*COS[#2] where the program has #100*COS[#2]
  void operand(const nc::Operation& operation, bool onLeft, Report& report) const {
    const Expression& side = onLeft ? *operation.left : *operation.right;
    if (!isVariableOf(used_, side) || numbers_.contains(&side)) return;
    const auto* number = std::get_if<nc::Number>(&side.node);
    if (!isShort({side.range.file, operation.left->range.begin, operation.right->range.end})) return;
    // A number of units, `5*#129`: the other side is a factor that holds for the whole pack.
    const Expression& other = onLeft ? *operation.right : *operation.left;
    if (operation.op == "*" && number->value < kFirstCommonNumber &&
        variableNumber(other).value_or(0) >= kFirstCommonNumber)
      return;
    const std::string variable = "#" + number->digits;
    const std::string op = operation.op.size() == 1 ? operation.op : " " + operation.op + " ";
    const std::string text =
        onLeft ? variable + op + print(*operation.right) : print(*operation.left) + op + variable;
    if (operations_.contains(text)) tell(side.range, number->digits, text, report);
  }

  // The number alone is that of one of these variables.
  static bool isVariableOf(const std::vector<std::uint32_t>& used, const Expression& side) {
    const auto* number = std::get_if<nc::Number>(&side.node);
    return number != nullptr && !number->point && side.brackets == 0 && number->value < 1e6 &&
           std::binary_search(used.begin(), used.end(), static_cast<std::uint32_t>(number->value));
  }

  static void tell(SourceRange range, const std::string& digits, const std::string& text, Report& report) {
    report.at(range,
              "{0} is a number here, and the program has `{1}` elsewhere; the control calculates with {0} "
              "and gives no "
              "alarm; write `#{0}` if the variable is meant",
              digits, text);
  }

private:
  // Terms of a number of a variable that is computed first: `#16=5221+[#4-54]*20`.
  void addTerms(const Expression& sum) {
    const auto* operation = std::get_if<nc::Operation>(&sum.node);
    if (operation == nullptr) {
      numbers_.insert(&sum);
    } else if (operation->op == "+" || operation->op == "-") {
      addTerms(*operation->left);
      addTerms(*operation->right);
    }
  }

  const std::vector<std::uint32_t>& used_;
  std::set<const Expression*> numbers_;
  std::set<std::string> operations_;
};

template <class Visit> void eachWord(const CheckedProgram& input, const Visit& visit) {
  for (const Block& block : input.program.blocks)
    if (const auto* words = std::get_if<Words>(&block.body))
      for (const nc::Word& word : words->words)
        if (word.value != nullptr) visit(word);
}

// F9 where the program has F#9
void hashMissingInWords(const CheckedProgram& input, Report& report) {
  std::set<std::pair<char, std::uint32_t>> written;
  eachWord(input, [&](const nc::Word& word) {
    if (const auto number = variableNumber(*word.value)) written.emplace(word.address, *number);
  });
  if (written.empty()) return;
  eachWord(input, [&](const nc::Word& word) {
    if (ir::isAddressIn(ir::kWholeAddresses, word.address)) return;
    const auto* number = std::get_if<nc::Number>(&word.value->node);
    if (number == nullptr || number->point || number->value < 1 || number->value > 999) return;
    if (written.contains({word.address, static_cast<std::uint32_t>(number->value)}))
      Hashes::tell(word.range, number->digits, fmt::format("{}#{}", word.address, number->digits), report);
  });
}

std::optional<std::uint32_t> offsetWritten(const Block& block) {
  const auto* assignment = std::get_if<nc::Assignment>(&block.body);
  const auto written = assignment == nullptr ? std::nullopt : writtenBy(*assignment);
  return written && isWorkOffset(written->number) ? std::optional(written->number) : std::nullopt;
}

} // namespace

void hashMissing(const CheckedProgram& input, Report& report) {
  std::vector<std::uint32_t> used;
  for (const CheckedProgram::Part& part : input.parts)
    if (const auto number = variableNumber(*part.expression)) used.push_back(*number);
  std::sort(used.begin(), used.end());
  std::optional<Hashes> hashes; // most programs need none
  for (const CheckedProgram::Part& part : input.parts) {
    const auto* operation = std::get_if<nc::Operation>(&part.expression->node);
    if (operation == nullptr || part.subscript) continue;
    for (const bool onLeft : {true, false}) {
      if (!Hashes::isVariableOf(used, onLeft ? *operation->left : *operation->right)) continue;
      if (!hashes) hashes.emplace(input, used);
      hashes->operand(*operation, onLeft, report);
    }
  }
  hashMissingInWords(input, report);
}

// ---- offsets

// Two values for one zero point with nothing but assignments between them: the first is lost.
void offsetOverwritten(const CheckedProgram& input, Report& report) {
  const std::vector<Block>& blocks = input.program.blocks;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto first = offsetWritten(blocks[i]);
    if (!first) continue;
    for (std::size_t j = i + 1; j < blocks.size() && j < i + 50; ++j) {
      const Block& block = blocks[j];
      const bool comment = std::holds_alternative<std::monostate>(block.body) && !block.target;
      if (comment) continue;
      if (block.target || block.blockDelete || !std::holds_alternative<nc::Assignment>(block.body)) break;
      const auto& assignment = std::get<nc::Assignment>(block.body);
      bool reads = false;
      walk(*assignment.value, [&](const Expression& expression, bool) {
        const auto* variable = std::get_if<nc::VariableRef>(&expression.node);
        reads = reads || variableNumber(expression) == first ||
                (variable != nullptr && !std::holds_alternative<nc::Number>(variable->number->node));
      });
      if (reads) break;
      if (offsetWritten(block) != first) continue;
      report
          .at({assignment.range.file, assignment.range.begin, assignment.variable->range.end},
              "#{} gets a second value before anything uses the first; the first zero point is lost; one of "
              "the two "
              "numbers is a misprint",
              *first)
          .note(std::get<nc::Assignment>(blocks[i].body).range, "the value that is lost");
      break;
    }
  }
}

} // namespace dotek::frontend::macrob
