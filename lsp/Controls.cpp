#include "lsp/Controls.h"

#include <fmt/format.h>

namespace dotek::lsp {

using stdlib::Control;
using stdlib::SystemVariables;

namespace {

std::string codeText(char letter, std::uint32_t tenths) {
  return tenths % 10 == 0 ? fmt::format("{}{}", letter, tenths / 10)
                          : fmt::format("{}{}.{}", letter, tenths / 10, tenths % 10);
}

// The source that a data file names is for `dotek list controls`.
std::string graded(const std::string& grade) {
  return grade.empty() ? "" : fmt::format("\n\n*{}*", grade);
}

// The letter of the axis that is `step` numbers after X; 0: none.
char axisAt(std::uint32_t number, const std::optional<int>& first, int step = 1) {
  constexpr std::string_view kAxes = "XYZABC";
  if (!first || step <= 0) return 0;
  const std::int64_t distance = static_cast<std::int64_t>(number) - *first;
  if (distance < 0 || distance % step != 0 || distance / step >= static_cast<std::int64_t>(kAxes.size()))
    return 0;
  return kAxes[static_cast<std::size_t>(distance / step)];
}

std::string offsetsFact(const SystemVariables& v, std::uint32_t number) {
  if (!v.workOffsetX || v.axisStep <= 0) return "";
  if (const char axis = axisAt(number, v.externalX, v.axisStep))
    return fmt::format("external work offset, {}", axis);
  for (int system = 0; system < 6 && v.systemStep > 0; ++system)
    if (const char axis = axisAt(number, *v.workOffsetX + system * v.systemStep, v.axisStep))
      return fmt::format("work offset G{}, {}", 54 + system, axis);
  if (v.extendedX && v.extendedStep > 0) {
    const std::int64_t distance = static_cast<std::int64_t>(number) - *v.extendedX;
    if (distance >= 0 && distance / v.extendedStep < v.extendedCount)
      if (const char axis =
              axisAt(number, static_cast<int>(*v.extendedX + distance / v.extendedStep * v.extendedStep),
                     v.axisStep))
        return fmt::format("work offset G54.1 P{}, {}", distance / v.extendedStep + 1, axis);
  }
  return "";
}

std::string toolsFact(const SystemVariables& v, std::uint32_t number) {
  const auto within = [&](const std::optional<int>& first) -> std::int64_t {
    if (!first) return 0;
    const std::int64_t offset = static_cast<std::int64_t>(number) - *first;
    return offset >= 1 && offset <= v.toolCount ? offset : 0;
  };
  if (const auto n = within(v.toolGeometry)) return fmt::format("tool offset {}, geometry", n);
  if (const auto n = within(v.toolGeometryToo)) return fmt::format("tool offset {}, geometry", n);
  const char* const wear = v.toolGeometry ? "tool offset {}, wear" : "tool offset {}, length";
  if (const auto n = within(v.toolWear)) return fmt::format(fmt::runtime(wear), n);
  if (const auto n = within(v.toolWearToo)) return fmt::format(fmt::runtime(wear), n);
  return "";
}

std::string positionsFact(const SystemVariables& v, std::uint32_t number) {
  if (const char a = axisAt(number, v.blockEnd)) return fmt::format("{} of the end of the previous block", a);
  if (const char a = axisAt(number, v.machine)) return fmt::format("{} of the machine position", a);
  if (const char a = axisAt(number, v.position))
    return fmt::format("{} of the position, work coordinates", a);
  if (const char a = axisAt(number, v.skip))
    return fmt::format("{} of the skip position, work coordinates", a);
  if (const char a = axisAt(number, v.toolLength)) return fmt::format("tool offset in force, {}", a);
  return "";
}

std::string namedFact(const SystemVariables& v, std::uint32_t number) {
  const auto is = [&](const std::optional<int>& one) {
    return one && *one >= 0 && static_cast<std::uint32_t>(*one) == number;
  };
  if (is(v.alarm)) return "alarm: a value that is assigned stops the program with that number";
  if (is(v.message)) return "stop with a message";
  if (is(v.timer)) return "clock, milliseconds";
  if (is(v.hours)) return "clock, hours";
  if (is(v.extendedNumber)) return "P of the additional work system in force";
  if (is(v.modalFeed)) return "feed in force";
  if (v.modalFirst && number >= static_cast<std::uint32_t>(*v.modalFirst) &&
      number < static_cast<std::uint32_t>(*v.modalFirst) + 31)
    return fmt::format("modal G code of group {}", number - static_cast<std::uint32_t>(*v.modalFirst));
  return "";
}

} // namespace

std::string codeFact(const Control& control, char letter, std::uint32_t tenths) {
  const stdlib::CodeInfo* const code = control.find(letter, tenths);
  if (code == nullptr) return "";
  std::string out = fmt::format("**{}** {}", codeText(letter, tenths), code->title);
  if (code->group)
    out += fmt::format("\n\nmodal group {}", *code->group);
  else if (letter == 'G')
    out += "\n\nthis block only";
  return out + graded(code->grade) + fmt::format("\n\n{}", control.title);
}

std::string variableFact(const Control& control, std::uint32_t number) {
  if (number == 0) return "**#0** null";
  std::string what;
  if (number <= control.locals) {
    const char letter = stdlib::letterOfLocal(number);
    what = letter != 0 ? fmt::format("local variable, argument `{}`", letter) : "local variable";
  } else if (control.isCommon(number)) {
    what = "common variable";
    for (const stdlib::VariableRange& range : control.common)
      if (number >= range.first && number <= range.last)
        what += range.kept ? ", kept at power off" : ", lost at power off";
  } else {
    const SystemVariables& v = control.variables;
    for (const auto& fact :
         {namedFact(v, number), positionsFact(v, number), offsetsFact(v, number), toolsFact(v, number)})
      if (what.empty()) what = fact;
    for (const stdlib::StateRange& range : control.state)
      if (what.empty() && number >= range.first && number <= range.last)
        what = range.title + graded(range.grade);
  }
  if (what.empty()) return "";
  return fmt::format("**#{}** {}{}\n\n{}", number, what, control.isReadOnly(number) ? " (read only)" : "",
                     control.title);
}

std::string argumentName(const stdlib::MacroArgument& argument) {
  std::string name(stdlib::roleName(argument.role));
  for (char& c : name)
    if (c == '-') c = ' ';
  const bool axis =
      argument.role == stdlib::ArgumentRole::Target || argument.role == stdlib::ArgumentRole::Nominal ||
      argument.role == stdlib::ArgumentRole::Spacing || argument.role == stdlib::ArgumentRole::Point;
  return axis ? fmt::format("{} {}", name, "xyzabc"[static_cast<std::size_t>(argument.axis)]) : name;
}

std::string argumentFact(const stdlib::MacroSet& set, const stdlib::MacroSignature& signature,
                         const stdlib::MacroArgument& argument) {
  std::string out = fmt::format("**{}** {}", argument.letter, argumentName(argument));
  if (argument.role == stdlib::ArgumentRole::Target)
    out += argument.frame == ir::Frame::Work ? ", absolute in the active work system"
                                             : ", distance from here, signed";
  if (argument.required) out += ", required";
  if (!argument.unknown.empty()) out += "\n\nno source says: " + argument.unknown;
  return out + fmt::format("\n\nof P{} {} ({})", signature.program, signature.title, set.title);
}

std::string programFact(const stdlib::MacroSet& set, std::uint32_t program) {
  std::string out;
  for (const stdlib::MacroSignature* signature : set.of(program)) {
    out += fmt::format("{}**P{}** {}\n", out.empty() ? "" : "\n", program, signature->title);
    for (const stdlib::MacroArgument& argument : signature->arguments)
      out += fmt::format("- `{}` {}{}\n", argument.letter, argumentName(argument),
                         argument.required ? ", required" : "");
    for (const stdlib::MacroResult& result : signature->results)
      if (result.output != stdlib::Output::Main)
        out += fmt::format("- #{} = {}\n", result.variable, stdlib::outputName(result.output));
  }
  return out.empty() ? "" : out + "\n" + set.title;
}

} // namespace dotek::lsp
