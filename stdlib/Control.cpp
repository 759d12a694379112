#include "stdlib/Control.h"

#include "stdlib/CodeSpan.h"
#include "stdlib/ControlFiles.h"
#include "stdlib/ControlReader.h"
#include "stdlib/DataFiles.h"
#include "stdlib/StoredTables.h"
#include "support/NearestName.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace dotek::stdlib {
namespace {

// What macro statements can compute; ATAN in the forms that exist.
constexpr std::string_view kMacroFunctions[] = {
    "ABS", "ACOS", "ADP", "ASIN", "ATAN", "ATAN[y]", "ATAN[y]/[x]", "ATAN[y,x]", "BCD", "BIN", "COS", "EXP",
    "FIX", "FUP",  "LN",  "MOD",  "POW",  "ROUND",   "SIN",         "SQRT",      "TAN", "AND", "OR",  "XOR"};

// Keys that are true where the control takes what others refuse: `WH[..]` for WHILE, IF without THEN and with
// an NC block after it, `#30057.21` (a bit, or one axis, of a parameter), comments in comments, small
// letters, DPRNT without POPEN, G53 as a distance under G91.
constexpr std::string_view kLanguageForms[] = {
    "abbreviated_words",         "then_optional", "parameter_bits",
    "nested_comments",           "small_letters", "print_without_port",
    "incremental_machine_moves",
};

} // namespace

Control ControlReader::read() {
  removals();
  TomlValue title;
  for (std::size_t i = 0; i < roots_.size() && !title; ++i)
    title = roots_[i].value("title");
  control_.title = (title ? title : roots_.front().require("title", "what lists print")).text();
  decimal();
  lengths();
  words();
  language();
  common();
  control_.readOnly = systemRanges("read_only");
  control_.toolOffsets = systemRanges("tool_offsets");
  alarm();
  programs();
  const std::vector<TomlTable> stated = own("codes", "tables of G and M codes");
  for (const TomlTable& table : stated)
    codes(table);
  calls();
  if (base_ != nullptr) inheritCodes();
  for (const TomlTable& table : stated)
    codeRanges(table);
  motion();
  dwell();
  rotation();
  turning();
  readAhead();
  output();
  alarms();
  variables();
  return control_;
}

ControlReader::Origin ControlReader::origin(const TomlTable& table) {
  Origin out;
  out.grade = table.require("grade", "documented, observed, assumed or inferred")
                  .choice({"documented", "observed", "assumed", "inferred"});
  out.source = table.require("source", "where the fact comes from").text();
  return out;
}

void ControlReader::decimal() {
  const ControlSection table = section("decimal", "how a number without a point is read");
  const std::string mode =
      table.require("mode", "increment or calculator").choice({"increment", "calculator"}, "calculator");
  control_.decimal = mode == "increment" ? DecimalMode::Increment : DecimalMode::Calculator;
  control_.decimalGrade = origin(table).grade;
}

void ControlReader::lengths() {
  const ControlSection table = optional("lengths");
  if (!table) return;
  origin(table);
  const TomlValue letters = table.require("addresses", "the letters that count lengths, as XYZIJK");
  control_.lengths = 0;
  for (const char letter : letters.text()) {
    if (letter < 'A' || letter > 'Z')
      document_.fail(table.range("addresses"),
                     fmt::format("`{}` is no address; capital letters are", letter));
    else if (ir::isAddressIn(ir::kWholeAddresses, letter))
      document_.fail(table.range("addresses"),
                     fmt::format("`{}` counts whole units on every control", letter));
    else if (control_.isLength(letter))
      document_.fail(table.range("addresses"), fmt::format("`{}` is given twice", letter));
    else
      control_.lengths |= ir::addressBit(letter);
  }
}

void ControlReader::words() {
  const ControlSection table = section("words", "how many digits a word takes");
  origin(table);
  const TomlValue increment = table.require("increment", "the least input increment in mm");
  control_.increment = increment.number();
  control_.decimals = static_cast<int>(whole(table, "decimals", "the most digits after the point, mm", 0, 6));
  control_.integerDigits =
      static_cast<int>(whole(table, "integer_digits", "the most digits before the point", 1, 9));
  if (const TomlValue digits = table.value("digits"))
    control_.digits = static_cast<std::uint32_t>(digits.integer(8, 1, 99));
  if (std::abs(control_.increment * std::pow(10.0, control_.decimals) - 1) > 1e-9)
    document_.fail(table.range("increment"), fmt::format("an increment of {} is not one unit of decimal {}",
                                                         control_.increment, control_.decimals));
}

void ControlReader::language() {
  const ControlSection table = section("language", "what macro statements can say");
  origin(table);
  control_.ifThen = table.require("if_then", "true or false").flag();
  control_.joinedConditions = table.require("joined_conditions", "true or false").flag();
  control_.thenGoto = table.value("then_goto").flag();
  control_.bareFunctions = table.value("bare_functions").flag();
  control_.bracketDepth = whole(table, "bracket_depth", "how deep brackets nest", 1, 99);
  control_.locals = whole(table, "locals", "the greatest number of a local variable", 1, 99);
  if (table.value("arithmetic").choice({"double", "decimal8"}, "double") == "decimal8")
    control_.arithmetic = Arithmetic::Decimal8;
  control_.macroLevels = whole(table, "macro_levels", "how deep G65 nests", 1, 99);
  for (const TomlValue& item : table.require("functions", "a list of names").items()) {
    const std::string name = item.text();
    if (std::find(std::begin(kMacroFunctions), std::end(kMacroFunctions), name) ==
        std::end(kMacroFunctions)) {
      const std::string near = nearestName(
          name, std::vector<std::string_view>(std::begin(kMacroFunctions), std::end(kMacroFunctions)));
      document_.fail(item.range(), fmt::format("`{}` is no function of macro statements{}", name,
                                               near.empty() ? "" : "; the nearest is `" + near + "`"));
    }
    if (!control_.functions.insert(name).second)
      document_.fail(item.range(), fmt::format("`{}` is given twice", name));
  }
  // Kept among the names, which no function shares.
  for (const std::string_view form : kLanguageForms)
    if (table.value(std::string(form)).flag()) control_.functions.emplace(form);
  for (const std::string& name : control_.functions) {
    if (name.starts_with("ATAN[") && !control_.functions.contains("ATAN"))
      document_.fail(table.range("functions"),
                     fmt::format("`{}` is a form of `ATAN`, which is missing", name));
  }
}

void ControlReader::common() {
  for (const TomlTable& table : own("common", "tables of common variables")) {
    origin(table);
    if (control_.common.size() == kMostRanges)
      document_.fail(table.range(), fmt::format("more than {} ranges", kMostRanges));
    VariableRange range;
    range.first = whole(table, "first", "a variable number", 1, 999999);
    range.last = whole(table, "last", "a variable number", 1, 999999);
    range.kept = table.require("kept", "true or false").flag();
    if (range.first > range.last)
      document_.fail(table.range(), fmt::format("#{} to #{} is no range", range.first, range.last));
    if (range.first <= control_.locals)
      document_.fail(table.range(), fmt::format("#{} is a local variable", range.first));
    for (const VariableRange& other : control_.common) {
      if (range.first <= other.last && other.first <= range.last)
        document_.fail(table.range(), fmt::format("#{} to #{} overlaps #{} to #{}", range.first, range.last,
                                                  other.first, other.last));
    }
    control_.common.push_back(range);
  }
  if (base_ == nullptr) return;
  inherit(control_.common, base_->common);
  for (const VariableRange& range : control_.common)
    if (range.first <= control_.locals)
      document_.fail(roots_.front().range(), fmt::format("#{} is a local variable", range.first));
}

std::vector<VariableRange> ControlReader::systemRanges(std::string_view key) {
  std::vector<VariableRange> out;
  for (const TomlTable& table : own(key)) {
    origin(table);
    if (out.size() == kMostRanges)
      document_.fail(table.range(), fmt::format("more than {} ranges", kMostRanges));
    VariableRange range;
    range.first = whole(table, "first", "a variable number", 1000, 999999);
    range.last = whole(table, "last", "a variable number", 1000, 999999);
    if (range.first > range.last)
      document_.fail(table.range(), fmt::format("#{} to #{} is no range", range.first, range.last));
    out.push_back(range);
  }
  if (base_ != nullptr) inherit(out, key == "read_only" ? base_->readOnly : base_->toolOffsets);
  return out;
}

void ControlReader::alarm() {
  const ControlSection table = section("alarm", "what #3000 takes");
  origin(table);
  control_.alarmFirst = whole(table, "first", "the least number", 0, 9999);
  control_.alarmLast = whole(table, "last", "the greatest number", 0, 9999);
  control_.alarmShown = static_cast<std::uint32_t>(table.value("shown_from").integer(3000, 0, 99'999));
  control_.alarmLength = whole(table, "length", "characters of a message", 1, 999);
  if (control_.alarmFirst > control_.alarmLast)
    document_.fail(table.range(),
                   fmt::format("{} to {} is no range", control_.alarmFirst, control_.alarmLast));
}

void ControlReader::programs() {
  const ControlSection table = section("programs", "numbers of programs and blocks");
  origin(table);
  control_.programLast = whole(table, "last", "the greatest O number", 1, 99999999);
  control_.repeatInProgram = table.value("repeat_in_program").flag();
  if (control_.repeatInProgram && control_.programLast > 9999)
    document_.fail(
        table.range(table.owns("last") ? "last" : "repeat_in_program"),
        "under `repeat_in_program` the number of the program takes the last four digits, and `last` "
        "goes beyond them; `repeat_in_program = false` takes it back");
  control_.sequenceLast = whole(table, "last_sequence", "the greatest N number of a GOTO", 1, 99999999);
  control_.colonNames = table.value("colon").flag();
  control_.programNames = table.value("names").flag();
}

void ControlReader::motion() {
  const ControlSection table = optional("motion");
  if (!table) return;
  origin(table);
  if (const TomlValue tolerance = table.value("arc_tolerance")) {
    control_.arcTolerance = tolerance.number();
    if (*control_.arcTolerance <= 0)
      document_.fail(table.range("arc_tolerance"), "`arc_tolerance` is a length in mm");
  }
  if (const TomlValue letter = table.value("repeat"))
    control_.repeatLetter = letter.choice({"K", "L"}, "K").front();
}

void ControlReader::dwell() {
  const ControlSection table = optional("dwell");
  if (!table) return;
  origin(table);
  control_.dwellLetter =
      table.require("seconds", "the address that takes seconds: X or P").choice({"X", "P"}, "X").front();
}

void ControlReader::rotation() {
  const ControlSection table = optional("rotation");
  if (!table) return;
  origin(table);
  if (const TomlValue frame = table.value("positions"))
    control_.rotation.positions = frame.choice({"work", "program"}, "work") == "work"
                                      ? RotationFacts::Frame::Work
                                      : RotationFacts::Frame::Program;
  if (const TomlValue axis = table.value("other_axis"))
    control_.rotation.otherAxis = axis.choice({"turned", "as-before"}, "turned") == "turned"
                                      ? RotationFacts::Position::Turned
                                      : RotationFacts::Position::AsBefore;
}

// [turning]
void ControlReader::turning() {
  const ControlSection table = optional("turning");
  if (!table) return;
  const Origin from = origin(table);
  TurningFacts out;
  out.grade = from.grade;
  out.source = from.source;
  out.diameters =
      table.require("x", "diameter or radius").choice({"diameter", "radius"}, "diameter") == "diameter";
  for (const TomlValue& item : table.require("increments", "a list such as [\"XU\", \"ZW\"]").items()) {
    const std::string pair = item.text();
    const bool good = pair.size() == 2 &&
                      std::string_view("XYZABC").find(pair[0]) != std::string_view::npos &&
                      std::string_view("UVWH").find(pair[1]) != std::string_view::npos &&
                      out.incrementOf(pair[0]) == 0 && out.axisOf(pair[1]) == 0;
    if (good)
      out.increments.emplace_back(pair[0], pair[1]);
    else
      document_.fail(
          item.range(),
          fmt::format("`{}` is no axis with the address of its increments, `XU` is one; each is listed once",
                      pair));
  }
  out.axes = table.require("axes", "the axes in the order of their variables, as XZ").text();
  for (const char axis : out.axes)
    if (std::string_view("XYZABC").find(axis) == std::string_view::npos ||
        std::count(out.axes.begin(), out.axes.end(), axis) > 1)
      document_.fail(table.range("axes"), fmt::format("`{}` are no axes, each once", out.axes));
  for (const TomlValue& item : table.require("start", "the G codes in force at power on").items()) {
    const auto span = codeSpan(item.text());
    if (!span || span->letter != 'G' || span->first != span->last ||
        control_.find('G', span->first) == nullptr)
      document_.fail(item.range(), fmt::format("`{}` is no G code of the control", item.text()));
    else
      out.startCodes.push_back(span->first);
  }
  out.offsetDigits = whole(table, "offset_digits", "how many digits of T name the offset", 1, 3);
  control_.turning = std::move(out);
}

char TurningFacts::axisOf(char increment) const {
  const auto at = std::find_if(increments.begin(), increments.end(),
                               [&](const auto& pair) { return pair.second == increment; });
  return at == increments.end() ? '\0' : at->first;
}

char TurningFacts::incrementOf(char axis) const {
  const auto at = std::find_if(increments.begin(), increments.end(),
                               [&](const auto& pair) { return pair.first == axis; });
  return at == increments.end() ? '\0' : at->second;
}

const AlarmInfo* Control::find(Alarm alarm) const {
  const auto at =
      std::find_if(alarms.begin(), alarms.end(), [&](const AlarmInfo& info) { return info.alarm == alarm; });
  return at == alarms.end() ? nullptr : &*at;
}

const CodeInfo* Control::find(char letter, std::uint32_t tenths) const {
  const auto at = std::find_if(codes.begin(), codes.end(), [&](const CodeInfo& code) {
    return code.letter == letter && code.tenths == tenths;
  });
  return at == codes.end() ? nullptr : &*at;
}

const CodeInfo* Control::find(Function function) const {
  const auto at = std::find_if(codes.begin(), codes.end(),
                               [&](const CodeInfo& code) { return code.function == function; });
  return at == codes.end() ? nullptr : &*at;
}

bool Control::isCommon(std::uint32_t number) const {
  return std::any_of(common.begin(), common.end(), [&](const VariableRange& range) {
    return range.first <= number && number <= range.last;
  });
}

namespace {

bool isIn(const std::vector<VariableRange>& ranges, std::uint32_t number) {
  return std::any_of(ranges.begin(), ranges.end(), [&](const VariableRange& range) {
    return number >= range.first && number <= range.last;
  });
}

// The control and those that it extends, one after the other.
constexpr std::size_t kMostExtended = 4;

// What `extends` names: a control, or a file seen from the folder of the one that says so.
const DataFile* extended(const DataFiles& files, const DataFile& from, const std::string& name) {
  const DataFile* const found = files.find("controls", name);
  return found != nullptr || !isDataPath(name) ? found
                                               : files.find("controls", besideFile(from.origin, name));
}

// The files of a control, the nearest first.
std::vector<const DataFile*> chainOf(const DataFiles& files, const DataFile& file) {
  std::vector<const DataFile*> out = {&file};
  while (true) {
    const TomlDocument document = TomlDocument::parse(*out.back());
    const TomlValue extends = document.root().value("extends");
    if (!extends) return out;
    const std::string name = extends.text();
    const DataFile* const next = extended(files, *out.back(), name);
    if (next == nullptr) document.fail(extends.range(), fmt::format("there is no control `{}`", name));
    if (std::find(out.begin(), out.end(), next) != out.end())
      document.fail(extends.range(),
                    fmt::format("`{}` is extended by itself: the controls extend one another", name));
    if (out.size() == kMostExtended)
      document.fail(extends.range(),
                    fmt::format("a chain of more than {} controls; `extends` a control nearer to the "
                                "beginning of the chain",
                                kMostExtended));
    out.push_back(next);
  }
}

Control loadFrom(std::span<const DataFile* const> chain, std::vector<ControlFact>* facts) {
  std::vector<TomlDocument> documents;
  for (const DataFile* file : chain)
    documents.push_back(TomlDocument::parse(*file));
  std::optional<Control> base;
  std::vector<ControlFact> inherited;
  if (chain.size() > 1) base = loadFrom(chain.subspan(1), facts == nullptr ? nullptr : &inherited);
  static_cast<void>(documents.front().root().value("extends"));
  ControlReader reader(documents, base ? &*base : nullptr);
  Control control = reader.read();
  documents.front().finish();
  const DataFile& file = *chain.front();
  control.name = file.name;
  control.origin = file.origin;
  if (facts != nullptr)
    *facts = reader.facts(std::move(inherited), file.builtIn() ? "built in: " + file.name : file.origin);
  return control;
}

} // namespace

Control TableStore::readControl(const DataFiles& files, const DataFile& file) {
  return loadFrom(chainOf(files, file), nullptr);
}

std::vector<ControlFact> controlFacts(const DataFiles& files, std::string_view name) {
  std::vector<ControlFact> out;
  if (const DataFile* file = files.find("controls", name)) loadFrom(chainOf(files, *file), &out);
  return out;
}

bool Control::isReadOnly(std::uint32_t number) const {
  return isIn(readOnly, number);
}

bool Control::isToolOffset(std::uint32_t number) const {
  return isIn(toolOffsets, number);
}

} // namespace dotek::stdlib
