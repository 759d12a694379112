// stdlib/macros/<name>.toml into a MacroSet, strictly.
#include "stdlib/DataFiles.h"
#include "stdlib/MacroSet.h"
#include "stdlib/MacroSetRules.h"
#include "stdlib/StoredTables.h"
#include "stdlib/Toml.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <map>

namespace dotek::stdlib {
namespace {

// The outputs are the results of the IR, in the same order.
#define DOTEK_OUTPUT(id, name)                                                                               \
  static_assert(static_cast<int>(Output::id) == static_cast<int>(ir::ResultName::id));
DOTEK_OUTPUTS(DOTEK_OUTPUT)
#undef DOTEK_OUTPUT
ir::ResultName resultOf(Output output) {
  return static_cast<ir::ResultName>(output);
}

struct RoleFacts {
  std::string_view name;
  ir::Kind kind;
  AxisUse axis;
  bool selector;
};
constexpr RoleFacts kRoles[] = {
#define DOTEK_ROLE(id, name, kind, axis, selector) {name, ir::Kind::kind, AxisUse::axis, selector},
    DOTEK_ROLES(DOTEK_ROLE)
#undef DOTEK_ROLE
};
constexpr std::size_t kIntents = static_cast<std::size_t>(Intent::ProbeOff) + 1;
constexpr std::size_t kOutputs = static_cast<std::size_t>(Output::ProbeError) + 1;
constexpr std::size_t kAlarms = static_cast<std::size_t>(MacroAlarm::UpperLimit) + 1;
constexpr std::string_view kNoArgument = "GLNOP";
// More than any pack has; checks compare each with each.
constexpr std::size_t kMostSignatures = 2000;
constexpr std::size_t kMostRanges = 100;

// One of the names that `nameOf` gives the first `count` values of Id.
template <class Id, class NameOf> Id chosen(const TomlValue& value, std::size_t count, NameOf nameOf) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(nameOf(static_cast<Id>(i)));
  const std::string name = value.choice(names, names.front());
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? Id{} : static_cast<Id>(at - names.begin());
}

class SetReader {
public:
  explicit SetReader(const TomlDocument& document) : document_(document), root_(document.root()) {}

  MacroSet read() {
    set_.title = root_.require("title", "what lists print").text();
    for (const TomlTable& table : root_.require("scratch", "tables of variables").tables())
      scratch(table);
    caller();
    probing();
    for (const TomlTable& table : root_.value("alarms").tables())
      alarms(table);
    for (const TomlTable& table : root_.value("arguments").tables())
      group(table, arguments_);
    for (const TomlTable& table : root_.value("results").tables())
      group(table, results_);
    for (const TomlTable& table : root_.require("signature", "tables of calls").tables())
      signature(table);
    for (const TomlTable& table : root_.value("refused").tables())
      refused(table);
    for (const auto* groups : {&arguments_, &results_})
      for (const auto& [name, entry] : *groups)
        if (!entry.used) document_.fail(entry.table.range(), fmt::format("no signature names `{}`", name));
    return std::move(set_);
  }

private:
  // Arguments or results that several signatures share.
  struct Group {
    TomlTable table;
    std::vector<TomlTable> list;
    bool used = false;
  };

  static void origin(const TomlTable& table, std::string& grade, std::string& source) {
    grade = table.require("grade", "documented, observed, assumed or inferred")
                .choice({"documented", "observed", "assumed", "inferred"});
    source = table.require("source", "where the fact comes from").text();
  }
  static void origin(const TomlTable& table) {
    std::string grade, source;
    origin(table, grade, source);
  }
  static std::optional<double> length(const TomlTable& table, std::string_view key) {
    const TomlValue value = table.value(key);
    return value ? std::optional<double>(value.number()) : std::nullopt;
  }
  static std::optional<std::uint32_t> variable(const TomlTable& table, std::string_view key) {
    const TomlValue value = table.value(key);
    return value ? std::optional<std::uint32_t>(static_cast<std::uint32_t>(value.integer(1, 1, 999999)))
                 : std::nullopt;
  }

  void scratch(const TomlTable& table) {
    origin(table);
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
    if (table.value("overwritten").flag()) set_.overwritten.emplace_back(first, last);
  }

  void caller() {
    const TomlValue value = root_.value("caller");
    if (!value) return;
    const TomlTable table = value.table();
    origin(table);
    if (const TomlValue needs = table.value("needs")) set_.needs = needs.text();
    set_.needsSkipPosition = table.value("skip_position").flag();
    for (const TomlTable& one : table.value("values").tables()) {
      const auto number =
          static_cast<std::uint32_t>(one.require("variable", "a variable number").integer(1, 1, 999999));
      set_.callerValues.emplace_back(number, one.require("value", "a number").number());
    }
    if (set_.needs.empty() && !set_.callerValues.empty())
      document_.fail(table.range(), "`values` are of variables that `needs` reports");
    if (set_.needs.empty() && !set_.needsSkipPosition)
      document_.fail(table.range(), "nothing is needed: leave the table out");
  }

  void probing() {
    ProbingFacts& facts = set_.probing;
    if (const TomlValue value = root_.value("probing")) {
      const TomlTable table = value.table();
      origin(table);
      facts.overtravel = length(table, "overtravel");
      facts.overtravelZ = length(table, "overtravel_z");
      facts.clearance = length(table, "clearance");
      facts.feedVariable = variable(table, "feed_variable");
      for (const auto& given : {facts.overtravel, facts.overtravelZ, facts.clearance})
        if (given && !(*given > 0)) document_.fail(table.range(), "these lengths are above 0");
    }
    if (const TomlValue value = root_.value("stylus")) {
      const TomlTable table = value.table();
      origin(table);
      facts.radiusX = variable(table, "radius_x");
      facts.radiusY = variable(table, "radius_y");
      facts.offsetX = variable(table, "offset_x");
      facts.offsetY = variable(table, "offset_y");
      facts.vectorFirst = variable(table, "vector_first");
      facts.vectorLast = variable(table, "vector_last");
      facts.lengthToTip =
          table.require("length_to", "tip or centre").choice({"tip", "centre"}, "tip") == "tip";
      if (facts.radiusX.has_value() != facts.radiusY.has_value())
        document_.fail(table.range(), "`radius_x` and `radius_y` go together");
    }
    if (const TomlValue value = root_.value("tool_update")) {
      const TomlTable table = value.table();
      origin(table);
      facts.toolLength = table.require("length", "wear or geometry").choice({"wear", "geometry"}) == "wear"
                             ? ProbingFacts::ToolRegister::Wear
                             : ProbingFacts::ToolRegister::Geometry;
    }
  }

  // "probe-fail 93: PROBE FAIL", "out-of-position: OUT OF POSITION"
  void alarms(const TomlTable& table) {
    origin(table);
    for (const TomlValue& item : table.require("list", "a list of alarms").items()) {
      const std::string text = item.text();
      const std::size_t colon = text.find(": ");
      const std::size_t blank = std::min(text.find(' '), colon);
      MacroAlarmInfo info;
      bool found = false;
      for (std::size_t i = 0; i < kAlarms; ++i) {
        if (macroAlarmName(static_cast<MacroAlarm>(i)) != text.substr(0, blank)) continue;
        info.alarm = static_cast<MacroAlarm>(i);
        found = true;
      }
      if (!found || colon == std::string::npos) {
        document_.fail(item.range(), fmt::format("`{}` is no alarm: `NAME NUMBER: TEXT` is expected", text));
        continue;
      }
      if (blank < colon) {
        std::uint32_t number = 0;
        const char* end = text.data() + colon;
        const auto read = std::from_chars(text.data() + blank + 1, end, number);
        if (read.ec != std::errc() || read.ptr != end || number > 999)
          document_.fail(item.range(), fmt::format("`{}`: n of `#3000=n` goes from 0 to 999", text));
        info.number = number;
      }
      info.text = text.substr(colon + 2);
      if (set_.find(info.alarm) != nullptr)
        document_.fail(item.range(), fmt::format("`{}` is given twice", macroAlarmName(info.alarm)));
      set_.alarms.push_back(std::move(info));
    }
  }

  void group(const TomlTable& table, std::map<std::string, Group>& groups) const {
    origin(table);
    const TomlValue name = table.require("name", "what signatures call it");
    Group out{table, table.require("list", "a list of tables").tables()};
    if (!groups.emplace(name.text(), std::move(out)).second)
      document_.fail(name.range(), fmt::format("`{}` is given twice", name.text()));
  }

  // Calls `read` for each table of the groups that `key` of `table` names.
  template <class Read>
  void shared(const TomlTable& table, std::string_view key, std::map<std::string, Group>& groups, Read read) {
    for (const TomlValue& item : table.value(key).items()) {
      const auto at = groups.find(item.text());
      if (at == groups.end()) {
        document_.fail(item.range(), fmt::format("there is no group `{}`", item.text()));
        continue;
      }
      at->second.used = true;
      for (const TomlTable& one : at->second.list)
        read(one);
    }
  }

  void signature(const TomlTable& table) {
    if (set_.signatures.size() == kMostSignatures)
      document_.fail(table.range(), fmt::format("more than {} signatures", kMostSignatures));
    MacroSignature out;
    const TomlValue program = table.require("program", "the number after P");
    out.program = static_cast<std::uint32_t>(program.integer(1, 1, 99999999));
    out.title = table.require("title", "what the call does").text();
    out.intent = chosen<Intent>(table.require("intent", "what the call means"), kIntents, intentName);
    out.unknown = table.value("unknown").text();
    origin(table, out.grade, out.source);
    for (const TomlTable& one : table.value("arguments").tables())
      argument(one, out);
    shared(table, "groups", arguments_, [&](const TomlTable& one) { argument(one, out); });
    anyOf(table, out);
    for (const TomlTable& one : table.value("results").tables())
      result(one, out);
    shared(table, "gives", results_, [&](const TomlTable& one) { result(one, out); });
    for (const std::string& defect : intentDefects(out))
      document_.fail(table.range(), defect);
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
                         fmt::format("`{}` follows `{}`: controls read I, J, K in that order and take "
                                     "another as the start of a second set",
                                     out.letter, other.letter));
      }
    }
    const TomlValue role = table.require("role", "what the argument means");
    out.role = chosen<ArgumentRole>(role, std::size(kRoles), roleName);
    const RoleFacts& facts = kRoles[static_cast<std::size_t>(out.role)];
    out.kind = facts.kind;
    out.selector = facts.selector;
    out.point = !facts.selector;
    out.required = table.value("required").flag();
    out.positive = table.value("positive").flag();
    out.unknown = table.value("unknown").text();
    if (facts.axis == AxisUse::Needed || (facts.axis == AxisUse::Possible && table.has("axis")))
      out.axis = static_cast<ir::Axis>(
          std::string_view("XYZ").find(table.require("axis", "X, Y or Z").choice({"X", "Y", "Z"}, "X")));
    if (out.role == ArgumentRole::Target)
      out.frame = table.require("frame", "work or here").choice({"work", "here"}) == "here" ? ir::Frame::Here
                                                                                            : ir::Frame::Work;
    if (out.role == ArgumentRole::System) system(table, out);
    if (out.role != ArgumentRole::Unstated && signature.find(out.role, out.axis) != nullptr)
      document_.fail(role.range(), fmt::format("`{}` means what `{}` means already", out.letter,
                                               signature.find(out.role, out.axis)->letter));
    signature.arguments.push_back(out);
  }

  void system(const TomlTable& table, MacroArgument& out) const {
    out.point = table.require("point", "true or false: a decimal point is written").flag();
    out.systemCode =
        table.require("code", "g-number or index").choice({"g-number", "index"}, "g-number") == "index"
            ? SystemCode::Index
            : SystemCode::GNumber;
    out.systemRule = table.require("rule", "nominal or error").choice({"nominal", "error"}) == "error"
                         ? SystemRule::Error
                         : SystemRule::Nominal;
    if (!table.has("extended_first") && !table.has("extended_last")) return;
    const TomlValue first = table.require("extended_first", "the number that stands for G54.1 P1");
    out.extendedFirst = static_cast<double>(first.integer(7, 7, 9999));
    out.extendedLast =
        static_cast<double>(table.require("extended_last", "the last number of G54.1").integer(7, 7, 9999));
    if (out.systemCode != SystemCode::Index || out.extendedFirst > out.extendedLast)
      document_.fail(first.range(), "numbers of G54.1 form a range of an index");
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
        document_.fail(value.range(), fmt::format("`{}` appears twice in `any_of`", letter));
    }
  }

  void result(const TomlTable& table, MacroSignature& signature) const {
    MacroResult out;
    const TomlValue name = table.require("name", "what the variable holds");
    out.output = chosen<Output>(name, kOutputs, outputName);
    out.name = resultOf(out.output);
    const TomlValue variable = table.require("variable", "a variable number");
    out.variable = static_cast<std::uint32_t>(variable.integer(1, 1, 999999));
    out.documented = table.value("documented").flag(true);
    if (const TomlValue taken = table.value("taken")) {
      out.taken = chosen<Output>(taken, kOutputs, outputName);
      if (out.documented)
        document_.fail(taken.range(), "what is documented needs no `taken`: it holds what `name` says");
    }
    if (out.output == Output::Main && out.documented)
      document_.fail(name.range(),
                     "`main` is a result that no document describes; write `documented = false`, "
                     "or what it holds");
    for (const MacroResult& other : signature.results) {
      if (other.output == out.output)
        document_.fail(name.range(), fmt::format("`{}` is given twice", name.text()));
      if (other.variable == out.variable)
        document_.fail(variable.range(), fmt::format("#{} holds another result already", out.variable));
    }
    const bool overwritten = std::any_of(set_.scratch.begin(), set_.scratch.end(), [&](const auto& range) {
      return range.first <= out.variable && out.variable <= range.second;
    });
    if (!overwritten)
      document_.fail(variable.range(),
                     fmt::format("#{} is in no `[[scratch]]`, and the call writes it", out.variable));
    signature.results.push_back(out);
  }

  void refused(const TomlTable& table) {
    origin(table);
    RefusedLetters out;
    const TomlValue letters = table.require("letters", "letters that exclude each other");
    out.letters = letters.text();
    out.text = table.value("text").text();
    if (out.letters.size() < 2) document_.fail(letters.range(), "two letters at least exclude each other");
    for (const TomlValue& item : table.require("programs", "a list of program numbers").items()) {
      const auto program = static_cast<std::uint32_t>(item.integer(1, 1, 99999999));
      const auto signatures = set_.of(program);
      for (const char letter : out.letters) {
        const bool known = std::any_of(signatures.begin(), signatures.end(), [&](const MacroSignature* one) {
          return one->find(letter) != nullptr;
        });
        if (!known) document_.fail(item.range(), fmt::format("P{} has no argument `{}`", program, letter));
      }
      out.programs.push_back(program);
    }
    set_.refused.push_back(std::move(out));
  }

  // No letters may fit both. What fits both fits with all letters that both have.
  void checkApart(const TomlValue& program, const MacroSignature& a, const MacroSignature& b) const {
    std::string shared;
    for (const MacroArgument& argument : a.arguments) {
      if (b.find(argument.letter) != nullptr) shared += argument.letter;
    }
    if (a.fits(shared) && b.fits(shared))
      document_.fail(program.range(), fmt::format("a call of P{} with {} means `{}` and `{}`", b.program,
                                                  shared.empty() ? "no letters" : shared, a.title, b.title));
  }

  const TomlDocument& document_;
  TomlTable root_;
  MacroSet set_;
  std::map<std::string, Group> arguments_, results_;
};

} // namespace

MacroSet TableStore::readMacroSet(const DataFile& file) {
  const TomlDocument document = TomlDocument::parse(file);
  MacroSet set = SetReader(document).read();
  document.finish();
  set.name = file.name;
  set.origin = file.origin;
  return set;
}

} // namespace dotek::stdlib
