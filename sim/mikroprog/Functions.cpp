#include "sim/mikroprog/Functions.h"

#include "sim/machine/Axes.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace dotek::sim::mikroprog {

namespace {

// What joins blocks changes no end of a move.
constexpr std::string_view kQuiet[] = {"join-on", "join-off", "set-condition"};

} // namespace

bool isQuiet(std::string_view function) {
  return std::find(std::begin(kQuiet), std::end(kQuiet), function) != std::end(kQuiet);
}

Flow flowOf(std::string_view function) {
  static constexpr std::pair<std::string_view, Flow> kFlows[] = {
      {"jump", Flow::Jump},
      {"jump-if", Flow::JumpIf},
      {"call", Flow::Call},
      {"return", Flow::Return},
      {"record-position", Flow::Position},
      {"record-value", Flow::Value},
      {"write-text", Flow::Text},
      {"stop", Flow::Stop},
      {"stop-if", Flow::StopIf},
      {"wait", Flow::Wait},
      {"reference", Flow::Reference},
      {"output-on", Flow::Output},
      {"output-off", Flow::Output},
      {"run-program", Flow::Program},
      {"run-macro", Flow::Macro},
  };
  for (const auto& [name, flow] : kFlows)
    if (name == function) return flow;
  return Flow::None;
}

std::string macroFile(const stdlib::MikroprogFunction& function) {
  return function.code() + ".MAC";
}

bool isSetting(std::string_view function) {
  return function == "system-off" || function == "system-stored" || function == "surface-speed";
}
std::string_view lettersOf(std::string_view function) {
  if (function == "surface-speed") return "A";
  if (function == "wait") return "E";
  return function.starts_with("output-") ? "Q" : "";
}

std::string whyNotFollowed(const stdlib::MikroprogFunction& function) {
  const std::string code = function.code();
  if (function.function == "read-value")
    return fmt::format("which value of its file {} reads is not stated (Q24)", code);
  if (function.function == "run-macro")
    return fmt::format("{} runs {}.MAC, and how such a program ends and what it finds in force is not stated "
                       "(Q25); write its blocks as a subprogram and call them by G26",
                       code, code);
  if (function.function.empty())
    return fmt::format("{} ({}) does what the supplier of the machine has written, and no source says it",
                       code, function.title);
  return function.function + " is not followed";
}

bool isAxis(char letter) {
  return std::string_view(kAxisLetters).find(letter) != std::string_view::npos;
}

} // namespace dotek::sim::mikroprog
