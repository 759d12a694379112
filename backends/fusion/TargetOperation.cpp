#include "backends/fusion/TargetOperation.h"

#include "backends/fusion/Emit.h"
#include "backends/fusion/TargetLists.h"
#include "backends/fusion/TargetWritten.h"
#include "support/Decimal.h"
#include "targets/DialogChoices.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::targets {

namespace fusion = backends::fusion;

namespace {

constexpr double kTooLong = 1e15;
// Fit pictures of usual size themselves; what is computed from them need not.
constexpr double kLarge[] = {kTooLong, 99999, 9999, 999};

} // namespace

fusion::RunInput operationOf(const verify::Case& drawn, const std::string& prefix) {
  const auto host = [&](const char* name, double otherwise) {
    const auto found = drawn.hosts.find(name);
    return found == drawn.hosts.end() ? otherwise : found->second;
  };
  fusion::RunInput out;
  for (const auto& [name, value] : drawn.values)
    out.properties[fusion::propertyOf(prefix, name)] = inJob(value);
  out.points = {{inJob(host("start_x", 0)), inJob(host("start_y", 0)), inJob(host("start_z", 0))}};
  out.toolDiameter = inJob(2 * host("tool_radius", 3));
  out.toolNumber = host("tool_number", 1);
  out.toolLengthOffset = host("tool_offset", 1);
  // Of its cycle a drilling operation has these planes, and nothing of a probing one.
  for (const char* plane : {"clearance", "retract"})
    if (const auto found = drawn.hosts.find(plane); found != drawn.hosts.end())
      out.cycle[plane] = inJob(found->second);
  return out;
}

void OperationDemands::check(const TargetCase& now, const fusion::RunResult& result, TargetRun& out) {
  runElsewhere(now, out);
  compareChoice(result, out);
  runWithoutSense(now, out);
  runBeside(now, out);
  runTooLarge(now, out);
  runRejected(now, out);
  for (const verify::DrawField& field : from_.plan.fields) {
    fusion::RunInput input = operationOf(now.drawn, prefix_);
    if (field.fixed || input.properties.erase(fusion::propertyOf(prefix_, field.name)) == 0) continue;
    runWithout(field, now, fragment_.run(input), out);
  }
  for (const verify::DrawField& field : from_.plan.fields)
    compareDefinition(field, result, out);
  compareTitles(from_.plan.fields, from_.folder, from_.session.sources(), result, prefix_, out);
  compareLists(dialogChoices(from_.folder, from_.session.sources()), result, prefix_, out);
}

// How an operation chooses the cycle: it does so alone, and the list offers it.
void OperationDemands::compareChoice(const fusion::RunResult& result, TargetRun& out) const {
  constexpr const char* kChoice = "dotekCycle";
  const auto differs = [&](std::string text) {
    if (out.differences.empty()) out.differs(verify::Aspect::Variable, std::move(text));
  };
  const auto offered = result.offered.find(kChoice);
  const bool isOffered =
      offered != result.offered.end() && std::any_of(offered->second.begin(), offered->second.end(),
                                                     [&](const auto& one) { return one.first == prefix_; });
  if (!isOffered) differs(fmt::format("the property `{}` does not offer `{}`", kChoice, prefix_));
  const auto first = result.defined.find(kChoice);
  if (first != result.defined.end() && first->second == prefix_)
    differs(fmt::format("the property `{}` begins with `{}`: each drilling operation would print the cycle",
                        kChoice, prefix_));
  for (const auto& [name, scope] : result.scopes)
    if ((name == kChoice || name.starts_with(prefix_ + "_")) && scope != "operation")
      differs(fmt::format("the property `{}` has the scope `{}`: one operation could not have its own value",
                          name, scope));
  for (const auto& [name, group] : result.lostGroups)
    if (name == kChoice || name.starts_with(prefix_ + "_"))
      differs(fmt::format("the property `{}` is in the group `{}`, which `groupDefinitions` spells otherwise",
                          name, group));
}

// The operation of another cycle, a document in inches, an operation that the post surrounds with calls, a
// further point of an operation.
void OperationDemands::runElsewhere(const TargetCase& now, TargetRun& out) {
  fusion::RunInput input = operationOf(now.drawn, prefix_);
  input.chosen = false;
  fusion::RunResult result = fragment_.run(input);
  if (!result.ok() || !result.text.empty() || result.taken)
    out.differs(verify::Aspect::Ending,
                "an operation that names no cycle: it has to write nothing; " +
                    (result.taken ? "its dispatch returns true" : didInstead(result)));
  input = operationOf(now.drawn, prefix_);
  input.inch = true;
  result = fragment_.run(input);
  if (result.fault || result.errors.empty() || !result.text.empty())
    out.differs(verify::Aspect::Ending, "a document in inches has to be an error; " + didInstead(result));
  input = operationOf(now.drawn, prefix_);
  input.probing = true;
  result = fragment_.run(input);
  if (result.fault || result.errors.empty() || !result.text.empty() || !result.taken)
    out.differs(verify::Aspect::Ending,
                "a probing operation has to be an error, and the post has to print nothing else for it; " +
                    (result.errors.empty() || result.taken ? didInstead(result)
                                                           : "its dispatch does not return true"));
  input = operationOf(now.drawn, prefix_);
  const std::string once = fragment_.run(input).text;
  input.points.push_back(input.points.front());
  result = fragment_.run(input);
  if (result.fault || result.errors.empty() || result.text != once || !result.taken)
    out.differs(verify::Aspect::Ending,
                "a further point of the operation has to be an error: nothing moves there; " +
                    didInstead(result));
}

// What the dialog of the operation begins with.
void OperationDemands::compareDefinition(const verify::DrawField& field, const fusion::RunResult& result,
                                         TargetRun& out) {
  const auto defined = result.defined.find(fusion::propertyOf(prefix_, field.name));
  const auto& given = from_.options.defaults;
  const bool own =
      std::any_of(given.begin(), given.end(), [&](const auto& one) { return one.first == field.name; });
  if (!out.differences.empty() || own || !field.initial || defined == result.defined.end()) return;
  const std::optional<double> value = parseNumber(defined->second);
  if (value && std::abs(*value - *field.initial) <= from_.options.tolerance) return;
  out.differs(verify::Aspect::Variable,
              fmt::format("the property of `{}` is defined as {} against {}, the first value of the field",
                          field.name, defined->second, numberText(*field.initial)));
}

// ---- values that no operation should give

// The fragment has to stop with an error, where it uses what the name stands for: with one that ends so.
void OperationDemands::demandError(const TargetCase& now, const std::string& name,
                                   const fusion::RunInput& input, const std::string& why, TargetRun& out,
                                   std::string_view says) {
  if (!out.differences.empty()) return;
  const fusion::RunResult result = fragment_.run(input);
  const bool stops = !result.fault && !result.errors.empty() && result.text.empty();
  if (stops && result.errors.front().ends_with(says)) return;
  if (!result.fault && result.text == right_ && result.errors.empty() && !uses(now, name)) return;
  out.differs(verify::Aspect::Ending,
              why + (stops ? fmt::format(" has to be an error, `..{}`; ", says) : " has to be an error; ") +
                  didInstead(result));
}

// A number that fits no picture and no word of a control is printed by nobody.
// true: that is so, or it is refused for another reason.
bool OperationDemands::demandText(const fusion::RunInput& input, double value, const std::string& what,
                                  TargetRun& out) {
  if (!out.differences.empty()) return false;
  const fusion::RunResult result = fragment_.run(input);
  const bool other = !result.errors.empty() && !isOfFragment(result.errors.front());
  if (result.fault)
    out.differs(verify::Aspect::Ending,
                fmt::format("{} as {}: it fails: {}", numberText(value), what, result.fault->text));
  if (result.text.find("null") == std::string::npos || right_.find("null") != std::string::npos) return other;
  out.differs(verify::Aspect::Ending,
              fmt::format("{} as `{}` does not fit and has to be an error; it writes `null`",
                          numberText(value), what));
  return false;
}

// A check of the dialog may bound one field by another: then that one is larger still.
void OperationDemands::demandTexts(fusion::RunInput input, const std::string& property, double value,
                                   const std::string& what, TargetRun& out) {
  constexpr double kLarger = 16;
  input.properties[property] = value;
  if (!demandText(input, value, what, out)) return;
  for (auto& [name, other] : input.properties) {
    if (name == property) continue;
    const double drawn = other;
    for (const double larger : {value * kLarger, -value * kLarger}) {
      other = larger;
      demandText(input, value, what, out);
    }
    other = drawn;
  }
}

// Values that the dialog rejects beside those of the case, which leave all else as it is.
void OperationDemands::runRejected(const TargetCase& now, TargetRun& out) {
  constexpr double kFar = 500;
  for (const verify::DrawField& field : from_.plan.fields) {
    fusion::RunInput input = operationOf(now.drawn, prefix_);
    const auto property = input.properties.find(fusion::propertyOf(prefix_, field.name));
    if (field.fixed || property == input.properties.end()) continue;
    for (const double value : {0.0, kFar, -kFar}) {
      if (!out.differences.empty()) return;
      if (now.questions->with(field.name, value).answer != SourceQuestions::Answer::Rejected) continue;
      property->second = value;
      const fusion::RunResult result = fragment_.run(input);
      if (!result.fault && !result.errors.empty() && result.text.empty()) continue;
      out.differs(verify::Aspect::Ending, fmt::format("the dialog rejects {} as `{}`; {}", numberText(value),
                                                      field.name, didInstead(result)));
    }
  }
}

bool OperationDemands::uses(const TargetCase& now, const std::string& name) {
  const auto known = uses_.find(name);
  if (known != uses_.end() && known->second) return true;
  return uses_[name] = now.questions->moves(name) || now.questions->rejectsSome(name);
}

// Texts for numbers, halves of what chooses something, a ball without a radius.
void OperationDemands::runWithoutSense(const TargetCase& now, TargetRun& out) {
  const auto& hosts = now.drawn.hosts;
  right_ = fragment_.run(operationOf(now.drawn, prefix_)).text;
  const auto isWhole = [](ir::Kind kind) {
    return kind == ir::Kind::WorkOffset || kind == ir::Kind::ToolOffset || kind == ir::Kind::Count;
  };
  for (const verify::DrawField& field : from_.plan.fields) {
    fusion::RunInput input = operationOf(now.drawn, prefix_);
    const auto property = input.properties.find(fusion::propertyOf(prefix_, field.name));
    if (field.fixed || property == input.properties.end()) continue;
    input.noNumber = property->first;
    demandError(now, field.name, input, fmt::format("a text as `{}`", field.name), out, " is no number");
    input.noNumber.clear();
    if (isWhole(field.kind)) {
      property->second += 0.5;
      demandError(now, field.name, input, fmt::format("a half as `{}`", field.name), out,
                  " is no whole number");
    }
    const std::vector<double> others = besideList(field);
    if (!others.empty() && now.questions->moves(field.name))
      for (const double beside : others) {
        property->second = beside;
        demandError(now, field.name, input, fmt::format("{} as `{}`", numberText(beside), field.name), out);
      }
    if (field.kind == ir::Kind::WorkOffset && !sameSet_)
      for (const double system : {field.firstSystem - 1, field.firstSystem + 6}) {
        property->second = system;
        demandError(now, field.name, input, fmt::format("{} as `{}`", numberText(system), field.name), out);
      }
  }
  struct Input {
    const char *host, *name;
  };
  static constexpr Input kInputs[] = {{"start_x", "x"},           {"start_y", "y"},
                                      {"start_z", "z"},           {"tool_radius", "diameter"},
                                      {"tool_number", "number"},  {"tool_offset", "lengthOffset"},
                                      {"clearance", "clearance"}, {"retract", "retract"}};
  for (const Input& one : kInputs) {
    if (from_.plan.fixedHosts.contains(one.host) || !hosts.contains(one.host)) continue;
    fusion::RunInput input = operationOf(now.drawn, prefix_);
    input.noNumber = one.name;
    demandError(now, one.host, input, fmt::format("a text as {}", one.host), out, " is no number");
  }
  for (const auto& [host, member] : {std::pair("tool_number", &fusion::RunInput::toolNumber),
                                     std::pair("tool_offset", &fusion::RunInput::toolLengthOffset)}) {
    if (from_.plan.fixedHosts.contains(host) || !hosts.contains(host)) continue;
    fusion::RunInput input = operationOf(now.drawn, prefix_);
    input.*member += 0.5;
    demandError(now, host, input, fmt::format("a half as {}", host), out);
  }
  runWithoutBall(now, out);
}

// What the post prints otherwise one step beside, the fragment does, too: limits of what is measured decide
// nothing in most cases. For another set it may print half of the value.
void OperationDemands::runBeside(const TargetCase& now, TargetRun& out) {
  for (const verify::DrawField& field : from_.plan.fields) {
    const auto drawn = now.drawn.values.find(field.name);
    if (field.fixed || !field.choices.empty() || drawn == now.drawn.values.end()) continue;
    const double step = (sameSet_ ? 1 : 2) * std::pow(10.0, -field.decimals);
    for (const double value : {drawn->second + step, drawn->second - step}) {
      if (!out.differences.empty()) return;
      fusion::RunInput input = operationOf(now.drawn, prefix_);
      const auto property = input.properties.find(fusion::propertyOf(prefix_, field.name));
      if (property == input.properties.end() || !now.questions->prints(field.name, {value})) continue;
      property->second = inJob(value);
      const fusion::RunResult result = fragment_.run(input);
      if (!result.ok() || result.text != right_ || losesDigits(result)) continue;
      out.differs(
          verify::Aspect::Printed,
          fmt::format("{} as `{}` instead of {}: the post prints other digits, and the fragment the same",
                      fixedText(value, field.decimals), field.name,
                      fixedText(drawn->second, field.decimals)));
    }
  }
}

// What does not fit its picture.
void OperationDemands::runTooLarge(const TargetCase& now, TargetRun& out) {
  for (const verify::DrawField& field : from_.plan.fields) {
    const fusion::RunInput input = operationOf(now.drawn, prefix_);
    const std::string property = fusion::propertyOf(prefix_, field.name);
    if (field.fixed || !input.properties.contains(property)) continue;
    for (const double size : kLarge)
      for (const double value : {size, -size})
        demandTexts(input, property, value, field.name, out);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    fusion::RunInput input = operationOf(now.drawn, prefix_);
    input.points.front()[axis] = kTooLong;
    demandText(input, kTooLong, std::string(1, "xyz"[axis]) + " of the point", out);
  }
  for (auto& [member, drawn] : operationOf(now.drawn, prefix_).cycle)
    for (const double value : {kTooLong, -kTooLong}) {
      fusion::RunInput input = operationOf(now.drawn, prefix_);
      input.cycle[member] = value;
      demandText(input, value, member + " of the cycle", out);
    }
  for (const auto& [name, member] : {std::pair("diameter", &fusion::RunInput::toolDiameter),
                                     std::pair("number", &fusion::RunInput::toolNumber),
                                     std::pair("length offset", &fusion::RunInput::toolLengthOffset)}) {
    fusion::RunInput input = operationOf(now.drawn, prefix_);
    input.*member = kTooLong;
    demandText(input, kTooLong, fmt::format("the {} of the tool", name), out);
  }
}

void OperationDemands::runWithoutBall(const TargetCase& now, TargetRun& out) {
  const auto& hosts = now.drawn.hosts;
  if (!hosts.contains("tool_radius") || from_.plan.fixedHosts.contains("tool_radius")) return;
  fusion::RunInput input = operationOf(now.drawn, prefix_);
  input.toolDiameter = 0;
  demandError(now, "tool_radius", input, "a ball without a radius", out, " is not above 0");
}

// As with the first value of DefineData; without one an error where the field moves something.
void OperationDemands::runWithout(const verify::DrawField& field, const TargetCase& now,
                                  const fusion::RunResult& result, TargetRun& out) {
  const std::string who = fmt::format("`{}` as its property is defined", field.name);
  if (!field.initial) {
    const bool stops = !result.fault && !result.errors.empty() && result.text.empty();
    if (!stops && now.questions->moves(field.name))
      out.differs(verify::Aspect::Ending,
                  who + ": without a default it has to be an error; " + didInstead(result));
    return;
  }
  fusion::RunInput given = operationOf(now.drawn, prefix_);
  given.properties[fusion::propertyOf(prefix_, field.name)] = inJob(*field.initial);
  const fusion::RunResult meant = fragment_.run(given);
  if (meant.text == result.text && meant.errors == result.errors &&
      meant.fault.has_value() == result.fault.has_value())
    return;
  const Written one = writtenOf(meant.text), other = writtenOf(result.text);
  const auto at = std::mismatch(one.lines.begin(), one.lines.end(), other.lines.begin(), other.lines.end());
  out.differs(verify::Aspect::Variable,
              fmt::format("{} against {}, the first value of the field", who, numberText(*field.initial)),
              at.second == other.lines.end() ? "" : *at.second);
}

} // namespace dotek::targets
