#include "posts/LathePost.h"

#include "posts/Json.h"
#include "posts/KernelFiles.h"
#include "project/SufProgram.h"
#include "stdlib/Toml.h"
#include "support/Printable.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace dotek::posts {

using stdlib::MikroprogControl;
using stdlib::MikroprogFunction;
using stdlib::TomlDocument;
using stdlib::TomlTable;
using stdlib::TomlValue;

namespace {

constexpr std::string_view kFunctions = "mikroprog-lathe.js";

// Members of `control`, by what the profile calls them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 26> kCodes = {
    {{"rapid", "rapid"},
     {"feed", "feed"},
     {"arcClockwise", "arc-clockwise"},
     {"arcCounterclockwise", "arc-counter-clockwise"},
     {"dwell", "dwell"},
     {"plane", "plane-zx"},
     {"thread", "thread-pass"},
     {"compensationOff", "compensation-off"},
     {"compensationLeft", "compensation-left"},
     {"compensationRight", "compensation-right"},
     {"absolute", "absolute"},
     {"feedPerMinute", "feed-per-minute"},
     {"feedPerRevolution", "feed-per-revolution"},
     {"surfaceSpeed", "surface-speed"},
     {"reference", "reference"},
     {"stop", "stop"},
     {"stopIf", "stop-if"},
     {"spindleRight", "spindle-right"},
     {"spindleLeft", "spindle-left"},
     {"spindleOff", "spindle-off"},
     {"toolChange", "tool-change"},
     {"coolantOn", "coolant-on"},
     {"coolantOff", "coolant-off"},
     {"writeText", "write-text"},
     {"end", "end"},
     {"setCondition", "set-condition"}}};
// Cycles share a name in the profile.
constexpr std::array<std::pair<std::string_view, std::uint32_t>, 4> kCycles = {
    {{"threadCycle", 78}, {"drill", 81}, {"peck", 83}, {"ream", 85}}};

struct Text {
  std::string_view key, member, standard;
};
constexpr std::array<Text, 18> kTexts = {
    {{"stop_field", "stopField", "M1=STOP"},
     {"safe_position", "safePosition", "SAFE POSITION FOR THE TOOL CHANGE"},
     {"check_tool", "checkTool", "CHECK THE TOOL"},
     {"clean", "clean", "CLEAN THE MACHINE"},
     {"alert", "alert", "ATTENTION"},
     {"unsupported", "unsupported", "The machine has no function for %1 of Manual NC."},
     {"inches", "inches", "The control has no inches: post in millimetres."},
     {"milling", "milling", "The lathe has no driven tools: operations of turning alone."},
     {"tool_number", "toolNumber", "Tool %1: the turret has places 1 to %2."},
     {"coolant", "coolant", "The machine has flood coolant alone."},
     {"thread_arc", "threadArc", "A thread cannot be cut along an arc."},
     {"compensation_arc", "compensationArc", "Compensation cannot begin or end with an arc."},
     {"no_pitch", "noPitch", "The thread has no pitch."},
     {"pitch", "pitch", "A pitch of %1 is above the limit of the control, %2."},
     {"thread_depth", "threadDepth", "The depth of the thread is not known."},
     {"off_axis", "offAxis", "A hole has to lie on the axis of the lathe."},
     {"taper", "taper", "A tapered thread has no cycle here: turn the cycle off in the operation."},
     {"tapping", "tapping", "The spindle cannot stop and turn back in step: no tapping."}}};

struct Property {
  std::string_view key, name, title, description, group, type, standard;
};
constexpr std::array<Property, 13> kProperties = {
    {{"m1_every_section", "m1EverySection", "Write M1 in every section",
      "Before the tool change of each operation", "preferences", "boolean", "true"},
     {"optional_stop", "optionalStop", "Optional stop", "M1 between operations, for the field of the screen",
      "preferences", "boolean", "true"},
     {"stop_condition", "stopCondition", "Condition of M1", "The words after M1", "preferences", "string",
      ""},
     {"write_g98", "writeG98", "Write G98", "The reference run in the header", "preferences", "boolean",
      "false"},
     {"safe_x", "safeX", "Safe position, X", "Diameter at which tools are changed", "preferences", "number",
      "200"},
     {"safe_z", "safeZ", "Safe position, Z", "Z at which tools are changed", "preferences", "number", "100"},
     {"maximum_spindle_speed", "maximumSpindleSpeed", "Maximum spindle speed",
      "Limit of S and of G96, rev/min", "preferences", "number", "2000"},
     {"threads", "threads", "Threads", "How the cycle of a thread is written", "preferences", "enum",
      "passes"},
     {"parametric_feed", "parametricFeed", "Parametric feed", "Feeds as parameters P", "preferences",
      "boolean", "false"},
     {"author", "author", "Author", "In the header", "formats", "string", ""},
     {"show_numbers", "showNumbers", "Block numbers", "N before each block", "formats", "boolean", "true"},
     {"first_number", "firstNumber", "First number", "N of the first block", "formats", "integer", "10"},
     {"number_step", "numberStep", "Step of the numbers", "From block to block", "formats", "integer",
      "10"}}};

class LathePost {
public:
  LathePost(const TomlDocument& document, const MikroprogControl& control)
      : document_(document), control_(control), root_(document.root()) {}

  std::string head(const std::string& from) {
    std::string out = fmt::format(
        "// Made by `dotek new post --from {}`: change the description, not this text.\n", printable(from));
    out += "description = " + jsonText(root_.value("description").text(control_.title)) + ";\n";
    out += "vendor = " + jsonText(root_.value("vendor").text()) + ";\n";
    std::string ending = control_.programEnding;
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    out += "extension = " + jsonText(ending) + ";\n";
    out += "certificationLevel = 2;\nminimumRevision = 45811;\nsetCodePage(\"ascii\");\n";
    out += "capabilities = CAPABILITY_TURNING;\ntolerance = 0.002;\n";
    out += "allowHelicalMoves = false;\nallowedCircularPlanes = 1 << PLANE_ZX;\n\n";
    out += "properties = {\n" + properties() + "};\n";
    out += "groupDefinitions = {\n  preferences: {title: \"Preferences\", order: 1},\n  formats: {title: "
           "\"Formats\", "
           "order: 2}\n};\n\n";
    out += "var control = {\n" + control() + "};\n\n";
    out += "var texts = {\n" + texts() + "};\n\n";
    return out;
  }

private:
  static void member(std::string& out, std::string_view name, const std::string& json) {
    out += fmt::format("{}  {}: {}", out.empty() ? "" : ",\n", name, json);
  }

  double number(const TomlTable& table, std::string_view key, double standard) {
    const double out = table.value(key).number(standard);
    if (out < 0) document_.fail(table.value(key).range(), fmt::format("`{}` is 0 or more", key));
    return out;
  }

  std::string properties() {
    const TomlTable given = root_.value("properties").table();
    std::string out;
    for (const Property& one : kProperties) {
      const TomlValue value = given.value(one.key);
      std::string json;
      if (one.type == "boolean")
        json = value.flag(one.standard == "true") ? "true" : "false";
      else if (one.type == "enum")
        json = jsonText(value.choice({"passes", "cycle"}, one.standard));
      else if (one.type == "string")
        json = jsonText(value.text(one.name == "stopCondition" ? "O" + std::to_string(condition())
                                                               : std::string(one.standard)));
      else
        json = jsonNumber(value.number(std::stod(std::string(one.standard))));
      std::string choices;
      if (one.type == "enum")
        choices =
            ", values: [{title: \"G33 for each pass\", id: \"passes\"}, {title: \"G78\", id: \"cycle\"}]";
      member(out, one.name,
             fmt::format("{{title: {}, description: {}, group: {}, type: {}, value: {}{}, scope: \"post\"}}",
                         jsonText(one.title), jsonText(one.description), jsonText(one.group),
                         jsonText(one.type), json, choices));
    }
    return out + "\n";
  }

  std::int64_t condition() { return root_.value("values").table().value("condition").integer(20, 1, 99); }

  std::string control() {
    const TomlTable values = root_.value("values").table();
    std::string out;
    member(out, "decimals", std::to_string(control_.decimals));
    for (const auto& [name, function] : kCodes)
      member(out, name, std::to_string(control_.function(function).number));
    for (const auto& [name, code] : kCycles)
      if (control_.find('G', code) == nullptr)
        document_.fail(root_.value("control").range(), fmt::format("the control has no G{}", code));
      else
        member(out, name, std::to_string(code));
    const auto most = [&](const MikroprogFunction* function, char letter) -> std::optional<double> {
      const stdlib::MikroprogAddress* const address = function == nullptr ? nullptr : function->find(letter);
      return address == nullptr ? std::nullopt : address->most;
    };
    if (const auto pitch = most(control_.find('G', 78), 'K')) member(out, "pitchLimit", jsonNumber(*pitch));
    member(out, "tools", jsonNumber(most(&control_.function("tool-change"), 'T').value_or(99)));
    member(out, "condition", std::to_string(condition()));
    member(out, "reversalSeconds", jsonNumber(number(values, "reversal_seconds", 5)));
    member(out, "threadFeed", jsonNumber(number(values, "thread_feed", 100)));
    return out + "\n";
  }

  std::string texts() {
    const TomlTable given = root_.value("texts").table();
    std::string out;
    std::vector<std::string> header;
    for (const std::string& line : given.value("header").texts())
      header.push_back(plain(given, "header", line));
    member(out, "header", jsonList(header));
    for (const Text& one : kTexts)
      member(out, one.member, plain(given, one.key, given.value(one.key).text(one.standard)));
    return out + "\n";
  }

  std::string plain(const TomlTable& table, std::string_view key, const std::string& text) {
    if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }))
      document_.fail(table.value(key).range(), "texts of the control are ASCII");
    return jsonText(text);
  }

  const TomlDocument& document_;
  const MikroprogControl& control_;
  TomlTable root_;
};

} // namespace

std::optional<std::string> newLathePost(const std::string& description, project::Session& session) {
  const std::optional<FileId> file = session.read(description, Encoding::Utf8);
  if (!file) return std::nullopt;
  const auto document = TomlDocument::parse(*file, session.sources(), session.diagnostics());
  if (!document) return std::nullopt;
  const std::string name =
      document->root().require("control", "a control of Mikroprog, \"mikroprog-s280\"").text();
  if (session.diagnostics().hasErrors()) return std::nullopt;
  const std::optional<MikroprogControl> control = project::loadMikroprogControl(name, session);
  if (!control) return std::nullopt;
  if (!control->isDiameter('X') || control->hasAxis('Y'))
    document->fail(document->root().value("control").range(),
                   "the control is no lathe with the axes X and Z");
  std::string out = LathePost(*document, *control).head(description);
  if (!document->finish()) return std::nullopt;
  for (const KernelFile& one : kernelFiles())
    if (one.name == kFunctions) out += one.text;
  return out;
}

} // namespace dotek::posts
