#include "frontend/gibbs/CommandShape.h"

#include <algorithm>
#include <array>

namespace dotek::frontend::gibbs {

using stdlib::ArgumentSpec;
using stdlib::CommandSignature;

bool asksUser(std::string_view name) {
  constexpr std::array<std::string_view, 8> kAsksUser = {"INPUT",        "YESNO",   "FILE_DIALOG_SHOW",
                                                         "RUN_EXE",      "RUN_CMD", "EXIT_GIBBSCAM",
                                                         "RUN_REPORTER", "RUN_POST"};
  return std::find(kAsksUser.begin(), kAsksUser.end(), name) != kAsksUser.end();
}

const ArgumentSpec* specAt(const CommandSignature& signature, std::size_t index) {
  for (const ArgumentSpec& spec : signature.arguments) {
    if (index < spec.repeat) return &spec;
    index -= spec.repeat;
  }
  return nullptr;
}

std::string bareWord(const Expression& e) {
  const VariableRef* ref = std::get_if<VariableRef>(&e.node);
  return ref != nullptr && !ref->index ? foldCase(ref->name.text) : "";
}

bool fits(const CommandSignature& signature, const Command& c) {
  std::size_t least = 0;
  for (const ArgumentSpec& spec : signature.arguments) {
    if (!spec.optional) ++least;
  }
  if (c.arguments.size() < least) return false;
  for (std::size_t i = 0; i < c.arguments.size(); ++i) {
    const ArgumentSpec* spec = specAt(signature, i);
    if (spec == nullptr) return false;
    if (spec->kind != ArgumentSpec::Kind::Choice) continue;
    if (std::find(spec->keywords.begin(), spec->keywords.end(), bareWord(*c.arguments[i])) ==
        spec->keywords.end()) {
      return false;
    }
  }
  return true;
}

bool isOwn(std::string_view family, const Symbol* number) {
  if (number == nullptr) return false;
  if (family.starts_with("tool")) return *number == Symbol::host("tool_number");
  return *number == Symbol::named("CALLBACK_PROC") || *number == Symbol::named("CALLBACK_OP");
}

bool isWritten(const ArgumentSpec& spec) {
  return spec.kind == ArgumentSpec::Kind::Result || spec.kind == ArgumentSpec::Kind::ReadWrite;
}

} // namespace dotek::frontend::gibbs
