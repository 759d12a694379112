#include "stdlib/MikroprogControl.h"

#include "stdlib/DataFiles.h"
#include "stdlib/Toml.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <set>

namespace dotek::stdlib {
namespace {

constexpr std::string_view kFolder = "mikroprog";
constexpr std::string_view kAxes = "XYZ";
constexpr std::string_view kLetters = "ABCDEFHIJKLOPQRSTUVWXYZ@;";
constexpr std::size_t kMostFunctions = 500;

// What a profile has to have: programs that Dotek writes look it up.
constexpr std::string_view kNeeded[] = {"rapid",
                                        "feed",
                                        "jump-if",
                                        "jump",
                                        "call",
                                        "probe-move",
                                        "absolute",
                                        "stop",
                                        "incremental",
                                        "set-position",
                                        "feed-per-minute",
                                        "end",
                                        "record-value",
                                        "return",
                                        "spindle-off",
                                        "coolant-off",
                                        "record-position",
                                        "plane-xy",
                                        "plane-zx",
                                        "reference",
                                        "dwell",
                                        "coolant-on",
                                        "spindle-right",
                                        "spindle-left",
                                        "plane-yz",
                                        "compensation-off"};

class Reader {
public:
  explicit Reader(const TomlDocument& document) : document_(document), root_(document.root()) {}

  MikroprogControl read() {
    control_.title = root_.require("title", "what lists print").text();
    axes();
    words();
    files();
    texts();
    for (const TomlTable& table : root_.require("function", "tables of functions").tables())
      function(table);
    for (const TomlTable& table : root_.value("named").tables()) {
      MikroprogFunction out;
      code(table, out);
      out.usable = false;
      origin(table, out.grade, out.source);
      control_.named.push_back(std::move(out));
    }
    for (const TomlTable& table : root_.value("condition").tables())
      condition(table);
    for (const TomlTable& table : root_.value("question").tables())
      question(table);
    for (const std::string_view needed : kNeeded)
      if (std::none_of(control_.functions.begin(), control_.functions.end(),
                       [&](const MikroprogFunction& one) { return one.function == needed; }))
        document_.fail(root_.range(), fmt::format("no function is `{}`", needed));
    return std::move(control_);
  }

private:
  void origin(const TomlTable& table, std::string& grade, std::string& source) const {
    grade = table.require("grade", "how sure the fact is")
                .choice({"documented", "observed", "inferred", "assumed"}, "assumed");
    source = table.require("source", "where the fact is known from").text();
  }
  void origin(const TomlTable& table) const {
    std::string grade, source;
    origin(table, grade, source);
  }

  void axes() {
    const TomlValue value = root_.require("axes", "the letters of the axes");
    control_.axes = value.text();
    control_.diameter = root_.value("diameter").text();
    for (const char axis : control_.axes)
      if (kAxes.find(axis) == std::string_view::npos)
        document_.fail(value.range(), fmt::format("`{}` is no axis; X, Y and Z are", axis));
    for (const char axis : control_.diameter)
      if (!control_.hasAxis(axis))
        document_.fail(root_.value("diameter").range(), fmt::format("`{}` is none of `axes`", axis));
  }

  void words() {
    const TomlTable table = root_.require("words", "what a number may look like").table();
    origin(table);
    control_.decimals =
        static_cast<int>(table.require("decimals", "digits after the point").integer(3, 0, 6));
    control_.integerDigits =
        static_cast<int>(table.require("integer_digits", "digits before the point").integer(5, 1, 9));
  }

  void files() {
    const TomlTable table = root_.require("files", "endings of file names").table();
    origin(table);
    control_.programEnding = table.require("program", "ending of a program").text();
    control_.dataEnding = table.require("data", "ending of a file of positions").text();
  }

  std::string panel(const TomlTable& table, std::string_view key, bool hole) const {
    const TomlValue value = table.require(key, "what the panel shows");
    const std::string text = value.text();
    const bool ascii = std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c < 127; });
    if (!ascii || text.empty()) document_.fail(value.range(), "a text of the panel is printable ASCII");
    if (hole != (text.find("{}") != std::string::npos) || text.find("{}") != text.rfind("{}"))
      document_.fail(value.range(), hole ? "one `{}` stands for the coordinate" : "`{}` has no meaning here");
    return text;
  }

  void texts() {
    const TomlTable table = root_.require("texts", "what the panel shows").table();
    control_.notFound = panel(table, "not_found", false);
    control_.collision = panel(table, "collision", false);
    control_.enterShift = panel(table, "enter", true);
    control_.enterCentre = panel(table, "centre", true);
  }

  void code(const TomlTable& table, MikroprogFunction& out) {
    const TomlValue value = table.require("code", "G or M and a number");
    const std::string text = value.text();
    const auto [end, error] = text.size() < 2
                                  ? std::from_chars_result{nullptr, std::errc::invalid_argument}
                                  : std::from_chars(text.data() + 1, text.data() + text.size(), out.number);
    if (error != std::errc() || end != text.data() + text.size() || (text[0] != 'G' && text[0] != 'M') ||
        out.number > 999) {
      document_.fail(value.range(), fmt::format("`{}` is no code", text));
      return;
    }
    out.letter = text[0];
    if (!codes_.insert(text).second) document_.fail(value.range(), fmt::format("`{}` appears twice", text));
  }

  std::string letters(const TomlValue& value, const std::string& text, const MikroprogFunction& of,
                      bool own) const {
    for (const char letter : text)
      if (own ? of.find(letter) == nullptr : kLetters.find(letter) == std::string_view::npos)
        document_.fail(value.range(), fmt::format("`{}` is none of its `addresses`", letter));
    return text;
  }

  void function(const TomlTable& table) {
    if (control_.functions.size() == kMostFunctions)
      document_.fail(table.range(), fmt::format("more than {} functions", kMostFunctions));
    MikroprogFunction out;
    code(table, out);
    out.title = table.require("title", "what it does").text();
    out.function = table.value("function").text();
    out.group = table.value("group").text();
    out.start = table.value("start").flag(false);
    out.ends = table.value("ends").text();
    out.usable = table.value("usable").flag(true);
    if (out.start && out.group.empty())
      document_.fail(table.value("start").range(), "a function without a group is never in force");
    if (out.start && !started_.insert(out.group).second)
      document_.fail(table.value("start").range(),
                     fmt::format("the group `{}` has two functions at the start", out.group));
    for (const TomlTable& address : table.value("addresses").tables())
      out.addresses.push_back(this->address(address, out));
    for (const TomlValue& value : table.value("either").items())
      out.either.push_back(letters(value, value.text(), out, true));
    for (const TomlValue& value : table.value("not_together").items())
      out.notTogether.push_back(letters(value, value.text(), out, true));
    if (const TomlValue value = table.value("forbids"))
      out.forbids = letters(value, value.text(), out, false);
    for (const char letter : out.forbids)
      if (out.find(letter) != nullptr)
        document_.fail(table.value("forbids").range(), fmt::format("`{}` is one of its `addresses`", letter));
    out.notes = table.value("notes").texts();
    origin(table, out.grade, out.source);
    control_.functions.push_back(std::move(out));
  }

  MikroprogAddress address(const TomlTable& table, const MikroprogFunction& of) const {
    MikroprogAddress out;
    const TomlValue letter = table.require("letter", "an address");
    const std::string text = letter.text();
    if (text.size() != 1 || kLetters.find(text[0]) == std::string_view::npos)
      document_.fail(letter.range(), fmt::format("`{}` is no address", text));
    else
      out.letter = text[0];
    if (out.letter != 0 && of.find(out.letter) != nullptr)
      document_.fail(letter.range(), fmt::format("`{}` appears twice", text));
    if (kAxes.find(out.letter) != std::string_view::npos && out.letter != 0 && !control_.hasAxis(out.letter))
      document_.fail(letter.range(), fmt::format("`{}` is none of `axes`", text));
    const std::string use =
        table.require("use", "needed, given or optional").choice({"needed", "given", "optional"}, "given");
    out.use = use == "needed"  ? AddressUse::Needed
              : use == "given" ? AddressUse::Given
                               : AddressUse::Optional;
    out.unit = table.require("unit", "what its number counts").text();
    if (const TomlValue value = table.value("least")) out.least = value.number();
    if (const TomlValue value = table.value("most")) out.most = value.number();
    if (out.least && out.most && *out.least > *out.most)
      document_.fail(table.range(), "`least` is greater than `most`");
    return out;
  }

  void condition(const TomlTable& table) {
    MikroprogCondition out;
    const TomlValue number = table.require("number", "the number after O");
    out.number = static_cast<std::uint32_t>(number.integer(1, 1, 99));
    if (control_.condition(out.number) != nullptr)
      document_.fail(number.range(), fmt::format("O{} appears twice", out.number));
    out.title = table.require("title", "when it holds").text();
    origin(table, out.grade, out.source);
    control_.conditions.push_back(std::move(out));
  }

  void question(const TomlTable& table) {
    MikroprogQuestion out;
    const TomlValue number = table.require("number", "the number of the question");
    out.number = static_cast<std::uint32_t>(number.integer(1, 1, 99));
    if (control_.question(out.number) != nullptr)
      document_.fail(number.range(), fmt::format("Q{} appears twice", out.number));
    out.title = table.require("title", "what is taken to hold").text();
    out.assumed = table.require("assumed", "true or false").flag();
    control_.questions.push_back(std::move(out));
  }

  const TomlDocument& document_;
  TomlTable root_;
  MikroprogControl control_;
  std::set<std::string> codes_, started_;
};

} // namespace

const MikroprogAddress* MikroprogFunction::find(char address) const {
  const auto at = std::find_if(addresses.begin(), addresses.end(),
                               [&](const MikroprogAddress& one) { return one.letter == address; });
  return at == addresses.end() ? nullptr : &*at;
}

std::string MikroprogFunction::code() const {
  return fmt::format("{}{}", letter, number);
}

const MikroprogFunction* MikroprogControl::find(char letter, std::uint32_t number) const {
  const auto at = std::find_if(functions.begin(), functions.end(), [&](const MikroprogFunction& one) {
    return one.letter == letter && one.number == number;
  });
  return at == functions.end() ? nullptr : &*at;
}

const MikroprogFunction& MikroprogControl::function(std::string_view what) const {
  return *std::find_if(functions.begin(), functions.end(),
                       [&](const MikroprogFunction& one) { return one.function == what; });
}

const MikroprogCondition* MikroprogControl::condition(std::uint32_t number) const {
  const auto at = std::find_if(conditions.begin(), conditions.end(),
                               [&](const MikroprogCondition& one) { return one.number == number; });
  return at == conditions.end() ? nullptr : &*at;
}

const MikroprogQuestion* MikroprogControl::question(std::uint32_t number) const {
  const auto at = std::find_if(questions.begin(), questions.end(),
                               [&](const MikroprogQuestion& one) { return one.number == number; });
  return at == questions.end() ? nullptr : &*at;
}

std::optional<MikroprogControl> MikroprogControl::load(const DataFiles& files, std::string_view name) {
  const DataFile* file = files.find(kFolder, name);
  if (file == nullptr) return std::nullopt;
  const TomlDocument document = TomlDocument::parse(*file);
  MikroprogControl control = Reader(document).read();
  document.finish();
  control.name = name;
  control.origin = file->origin;
  return control;
}

} // namespace dotek::stdlib
