#include "stdlib/MacroSet.h"

#include "stdlib/DataFiles.h"
#include "stdlib/Toml.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dotek::stdlib {
namespace {

constexpr std::string_view kIntentNames[] = {
#define DOTEK_INTENT(id, name) name,
    DOTEK_INTENTS(DOTEK_INTENT)
#undef DOTEK_INTENT
};
constexpr std::string_view kRoles[] = {"target", "feed", "diameter", "nominal", "system", "overtravel"};
constexpr std::string_view kResults[] = {"main", "position-x", "position-y", "position-z", "size"};
constexpr std::string_view kNoArgument = "GLNOP";
// More than any pack has; checks compare each with each.
constexpr std::size_t kMostSignatures = 2000;
constexpr std::size_t kMostRanges = 100;

template <class Id, std::size_t N> Id named(const std::string& name, const std::string_view (&names)[N]) {
  const auto at = std::find(std::begin(names), std::end(names), name);
  return at == std::end(names) ? Id{} : static_cast<Id>(at - std::begin(names));
}

bool fits(const MacroSignature& signature, std::string_view letters) {
  for (const char letter : letters) {
    if (signature.find(letter) == nullptr) return false;
  }
  for (const MacroArgument& argument : signature.arguments) {
    if (argument.required && letters.find(argument.letter) == std::string_view::npos) return false;
  }
  return signature.anyOf.empty() || letters.find_first_of(signature.anyOf) != std::string_view::npos;
}

// "X or Y or Z"
std::string alternatives(std::string_view letters) {
  return fmt::format("{}", fmt::join(letters, " or "));
}

class SetReader {
public:
  explicit SetReader(const TomlDocument& document) : document_(document), root_(document.root()) {}

  MacroSet read() {
    set_.title = root_.require("title", "what lists print").text();
    for (const TomlTable& table : root_.require("scratch", "tables of variables").tables())
      scratch(table);
    for (const TomlTable& table : root_.require("signature", "tables of calls").tables())
      signature(table);
    return std::move(set_);
  }

private:
  static void origin(const TomlTable& table, std::string& grade, std::string& source) {
    grade = table.require("grade", "documented, observed, assumed or inferred")
                .choice({"documented", "observed", "assumed", "inferred"});
    source = table.require("source", "where the fact comes from").text();
  }

  void scratch(const TomlTable& table) {
    std::string grade, source;
    origin(table, grade, source);
    const auto number = [&](std::string_view key) {
      return static_cast<std::uint32_t>(table.require(key, "a variable number").integer(1, 1, 999999));
    };
    const std::uint32_t first = number("first");
    const std::uint32_t last = number("last");
    if (set_.scratch.size() == kMostRanges)
      document_.fail(table.range(), fmt::format("more than {} ranges", kMostRanges));
    if (first > last) document_.fail(table.range(), fmt::format("#{} to #{} is no range", first, last));
    for (const auto& [otherFirst, otherLast] : set_.scratch) {
      if (first <= otherLast && otherFirst <= last)
        document_.fail(table.range(),
                       fmt::format("#{} to #{} overlaps #{} to #{}", first, last, otherFirst, otherLast));
    }
    set_.scratch.emplace_back(first, last);
  }

  void signature(const TomlTable& table) {
    if (set_.signatures.size() == kMostSignatures)
      document_.fail(table.range(), fmt::format("more than {} signatures", kMostSignatures));
    MacroSignature out;
    const TomlValue program = table.require("program", "the number behind P");
    out.program = static_cast<std::uint32_t>(program.integer(1, 1, 99999999));
    out.title = table.require("title", "what the call does").text();
    out.intent = named<Intent>(
        table.require("intent", "what the call means")
            .choice({"protected-move", "surface", "bore", "probe-on", "probe-off"}, "protected-move"),
        kIntentNames);
    origin(table, out.grade, out.source);
    for (const TomlTable& argument : table.value("arguments").tables())
      this->argument(argument, out);
    anyOf(table, out);
    for (const TomlTable& result : table.value("results").tables())
      this->result(result, out);
    checkIntent(table, out);
    for (const MacroSignature& other : set_.signatures) {
      if (other.program == out.program) checkApart(program, other, out);
    }
    set_.signatures.push_back(std::move(out));
  }

  void argument(const TomlTable& table, MacroSignature& signature) const {
    MacroArgument out;
    const TomlValue letter = table.require("letter", "the letter of the argument");
    const std::string name = letter.text();
    if (name.size() != 1 || name[0] < 'A' || name[0] > 'Z')
      document_.fail(letter.range(), fmt::format("`{}` is no letter from A to Z", name));
    out.letter = name.empty() ? 'A' : name[0];
    if (kNoArgument.find(out.letter) != std::string_view::npos)
      document_.fail(letter.range(), fmt::format("`{}` is never an argument of G65", name));
    if (signature.find(out.letter) != nullptr)
      document_.fail(letter.range(), fmt::format("`{}` is given twice", name));
    if (out.letter >= 'I' && out.letter <= 'K') {
      for (const MacroArgument& other : signature.arguments) {
        if (other.letter > out.letter && other.letter <= 'K')
          document_.fail(letter.range(),
                         fmt::format("`{}` stands behind `{}`: controls read I, J, K in that order and take "
                                     "another as the start of a second set",
                                     out.letter, other.letter));
      }
    }
    const TomlValue role = table.require("role", "what the argument means");
    out.role = named<ArgumentRole>(
        role.choice({"target", "feed", "diameter", "nominal", "system", "overtravel"}, "target"), kRoles);
    out.required = table.value("required").flag();
    if (out.role == ArgumentRole::Target || out.role == ArgumentRole::Nominal)
      out.axis = static_cast<ir::Axis>(
          std::string_view("XYZ").find(table.require("axis", "X, Y or Z").choice({"X", "Y", "Z"}, "X")));
    if (out.role == ArgumentRole::Target)
      out.frame = table.require("frame", "work or here").choice({"work", "here"}) == "here" ? ir::Frame::Here
                                                                                            : ir::Frame::Work;
    if (out.role == ArgumentRole::Feed) out.kind = ir::Kind::Feed;
    if (out.role == ArgumentRole::System) system(table, out);
    if (signature.find(out.role, out.axis) != nullptr)
      document_.fail(role.range(), fmt::format("`{}` means what `{}` means already", out.letter,
                                               signature.find(out.role, out.axis)->letter));
    signature.arguments.push_back(out);
  }

  static void system(const TomlTable& table, MacroArgument& out) {
    out.kind = ir::Kind::WorkOffset;
    out.selector = true;
    out.point = table.require("point", "true or false: a decimal point is written").flag();
    out.systemCode =
        table.require("code", "g-number or index").choice({"g-number", "index"}, "g-number") == "index"
            ? SystemCode::Index
            : SystemCode::GNumber;
    out.systemRule = table.require("rule", "nominal or error").choice({"nominal", "error"}) == "error"
                         ? SystemRule::Error
                         : SystemRule::Nominal;
  }

  void anyOf(const TomlTable& table, MacroSignature& signature) const {
    const TomlValue value = table.value("any_of");
    signature.anyOf = value.text();
    if (value && signature.anyOf.empty())
      document_.fail(value.range(), "`any_of` is empty; letters are expected");
    for (std::size_t i = 0; i < signature.anyOf.size(); ++i) {
      const char letter = signature.anyOf[i];
      const MacroArgument* argument = signature.find(letter);
      if (argument == nullptr)
        document_.fail(value.range(), fmt::format("`{}` in `any_of` is no argument of the call", letter));
      else if (argument->required)
        document_.fail(value.range(),
                       fmt::format("`{}` in `any_of` is required: the rule says nothing", letter));
      if (signature.anyOf.find(letter) != i)
        document_.fail(value.range(), fmt::format("`{}` stands twice in `any_of`", letter));
    }
  }

  void result(const TomlTable& table, MacroSignature& signature) const {
    MacroResult out;
    const TomlValue name = table.require("name", "what the variable holds");
    out.name = named<ir::ResultName>(
        name.choice({"main", "position-x", "position-y", "position-z", "size"}, "main"), kResults);
    const TomlValue variable = table.require("variable", "a variable number");
    out.variable = static_cast<std::uint32_t>(variable.integer(1, 1, 999999));
    out.documented = table.value("documented").flag(true);
    if (out.name == ir::ResultName::Main && out.documented)
      document_.fail(name.range(),
                     "`main` is a result that no document describes; write `documented = false`, "
                     "or what it holds");
    for (const MacroResult& other : signature.results) {
      if (other.name == out.name)
        document_.fail(name.range(), fmt::format("`{}` is given twice", name.text()));
      if (other.variable == out.variable)
        document_.fail(variable.range(), fmt::format("#{} holds another result already", out.variable));
    }
    const bool overwritten = std::any_of(set_.scratch.begin(), set_.scratch.end(), [&](const auto& range) {
      return range.first <= out.variable && out.variable <= range.second;
    });
    if (!overwritten)
      document_.fail(variable.range(),
                     fmt::format("#{} stands in no `[[scratch]]`, and the call writes it", out.variable));
    signature.results.push_back(out);
  }

  // What an intent needs of its arguments: a call that says less cannot be translated either way.
  void checkIntent(const TomlTable& table, const MacroSignature& s) const {
    const auto fail = [&](const std::string& message) { document_.fail(table.range(), message); };
    std::string targets; // letters of axes
    std::string nominals;
    for (const MacroArgument& argument : s.arguments) {
      if (argument.role == ArgumentRole::Target) targets += ir::letterOf(argument.axis);
      if (argument.role == ArgumentRole::Nominal) nominals += ir::letterOf(argument.axis);
    }
    const MacroArgument* system = s.find(ArgumentRole::System, ir::Axis::X);
    const MacroArgument* diameter = s.find(ArgumentRole::Diameter, ir::Axis::X);
    const bool required = std::all_of(s.arguments.begin(), s.arguments.end(), [](const MacroArgument& a) {
      return a.role != ArgumentRole::Target || a.required;
    });
    switch (s.intent) {
    case Intent::ProtectedMove: {
      if (targets.empty()) fail("a protected move has no target");
      if (diameter != nullptr || system != nullptr)
        fail("a protected move measures nothing and sets nothing");
      const bool anyRequired = std::any_of(s.arguments.begin(), s.arguments.end(), [](const auto& a) {
        return a.role == ArgumentRole::Target && a.required;
      });
      if (s.anyOf.empty() && !anyRequired)
        fail("a call without any target would fit; name the letters in `any_of`");
      break;
    }
    case Intent::Surface:
      if (targets.size() != 1 || !required)
        fail("a surface has one target, which is required; other axes are signatures of their own");
      if (diameter != nullptr) fail("a surface has no diameter");
      break;
    case Intent::Bore:
      if (diameter == nullptr || !diameter->required) fail("a bore has a diameter, which is required");
      if (!targets.empty()) fail("a bore is measured from where the probe stands: it has no target");
      break;
    case Intent::ProbeOn:
    case Intent::ProbeOff:
      if (!s.arguments.empty()) fail("a call that switches the probe has no arguments");
      break;
    }
    if (!nominals.empty() && (system == nullptr || system->systemRule == SystemRule::Error))
      fail("a nominal coordinate counts in the system that the call sets: `rule = \"nominal\"` is expected");
    if (system != nullptr && system->systemRule == SystemRule::Nominal) {
      const std::string axes = s.intent == Intent::Bore ? "XY" : targets;
      if (nominals != axes)
        fail(fmt::format("the system gets a nominal coordinate of {}, and {} given", axes,
                         nominals.empty() ? "none is" : nominals + " is"));
      for (const MacroArgument& argument : s.arguments) {
        if (argument.role == ArgumentRole::Nominal && system->required && !argument.required)
          fail(fmt::format("`{}` is not required and `{}` is, which needs it", argument.letter,
                           system->letter));
      }
    }
  }

  // No letters may fit both. What fits both fits with all letters that both have.
  void checkApart(const TomlValue& program, const MacroSignature& a, const MacroSignature& b) const {
    std::string shared;
    for (const MacroArgument& argument : a.arguments) {
      if (b.find(argument.letter) != nullptr) shared += argument.letter;
    }
    if (fits(a, shared) && fits(b, shared))
      document_.fail(program.range(), fmt::format("a call of P{} with {} means `{}` and `{}`", b.program,
                                                  shared.empty() ? "no letters" : shared, a.title, b.title));
  }

  const TomlDocument& document_;
  TomlTable root_;
  MacroSet set_;
};

// What the letters lack for the signature, in the words of SignatureMatch::missing.
std::string lack(const MacroSignature& signature, std::string_view letters, std::size_t& count) {
  std::vector<std::string> parts;
  for (const MacroArgument& argument : signature.arguments) {
    if (argument.required && letters.find(argument.letter) == std::string_view::npos)
      parts.push_back(std::string(1, argument.letter));
  }
  if (!signature.anyOf.empty() && letters.find_first_of(signature.anyOf) == std::string_view::npos) {
    const bool alone = parts.empty();
    parts.push_back(alone ? alternatives(signature.anyOf)
                          : fmt::format("({})", alternatives(signature.anyOf)));
  }
  count = parts.size();
  return fmt::format("{}", fmt::join(parts, " and "));
}

} // namespace

std::string_view intentName(Intent intent) {
  return kIntentNames[static_cast<std::size_t>(intent)];
}

const MacroArgument* MacroSignature::find(char letter) const {
  const auto at = std::find_if(arguments.begin(), arguments.end(),
                               [&](const MacroArgument& argument) { return argument.letter == letter; });
  return at == arguments.end() ? nullptr : &*at;
}

const MacroArgument* MacroSignature::find(ArgumentRole role, ir::Axis axis) const {
  const bool axial = role == ArgumentRole::Target || role == ArgumentRole::Nominal;
  const auto at = std::find_if(arguments.begin(), arguments.end(), [&](const MacroArgument& argument) {
    return argument.role == role && (!axial || argument.axis == axis);
  });
  return at == arguments.end() ? nullptr : &*at;
}

bool MacroSet::calls(std::uint32_t program) const {
  return std::any_of(signatures.begin(), signatures.end(),
                     [&](const MacroSignature& signature) { return signature.program == program; });
}

std::vector<const MacroSignature*> MacroSet::of(std::uint32_t program) const {
  std::vector<const MacroSignature*> out;
  for (const MacroSignature& signature : signatures) {
    if (signature.program == program) out.push_back(&signature);
  }
  return out;
}

const MacroSignature* MacroSet::find(Intent intent, ir::Axis axis) const {
  const auto at = std::find_if(signatures.begin(), signatures.end(), [&](const MacroSignature& signature) {
    return signature.intent == intent &&
           (intent != Intent::Surface || signature.find(ArgumentRole::Target, axis) != nullptr);
  });
  return at == signatures.end() ? nullptr : &*at;
}

std::optional<MacroSet> MacroSet::load(const DataFiles& files, std::string_view name) {
  const DataFile* file = files.find("macros", name);
  if (file == nullptr) return std::nullopt;
  const TomlDocument document = TomlDocument::parse(*file);
  MacroSet set = SetReader(document).read();
  document.finish();
  set.name = name;
  set.origin = file->origin;
  return set;
}

SignatureMatch match(const MacroSet& set, std::uint32_t program, std::string_view letters) {
  const std::vector<const MacroSignature*> signatures = set.of(program);
  SignatureMatch out;
  if (signatures.empty()) return out;
  for (const char letter : letters) {
    const bool known = std::any_of(signatures.begin(), signatures.end(),
                                   [&](const MacroSignature* s) { return s->find(letter) != nullptr; });
    if (!known) {
      out.unknown = letter;
      return out;
    }
  }
  std::size_t least = SIZE_MAX;
  for (const MacroSignature* signature : signatures) {
    if (fits(*signature, letters)) {
      out.ambiguous = out.signature != nullptr;
      if (out.ambiguous) {
        out.signature = nullptr;
        return out;
      }
      out.signature = signature;
      continue;
    }
    const bool takesAll = std::all_of(letters.begin(), letters.end(),
                                      [&](char letter) { return signature->find(letter) != nullptr; });
    if (!takesAll) continue;
    std::size_t count = 0;
    const std::string missing = lack(*signature, letters, count);
    if (count > least) continue;
    out.missing = count < least ? missing : out.missing + " or " + missing;
    least = count;
  }
  if (out.signature != nullptr) out.missing.clear();
  // Every letter is known, and no reading takes them all: those of two readings stand together.
  out.ambiguous = out.signature == nullptr && least == SIZE_MAX;
  return out;
}

} // namespace dotek::stdlib
