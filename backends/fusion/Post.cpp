// The smallest post that runs a fragment.
#include "backends/fusion/Script.h"

namespace dotek::backends::fusion {

namespace {

constexpr std::string_view kHeader = R"(description = "Probing cycles";
vendor = "Dotek";
extension = "nc";
minimumRevision = 45811;
capabilities = CAPABILITY_MILLING;
tolerance = 0.002;
setCodePage("ascii");

properties = {};

var gFormat = createFormat({prefix: "G", decimals: 0});
var xyzFormat = createFormat({decimals: 3, forceDecimal: true});
var feedFormat = createFormat({decimals: 3, forceDecimal: true});
var gMotionModal = createModal({}, gFormat);
var xOutput = createVariable({prefix: "X"}, xyzFormat);
var yOutput = createVariable({prefix: "Y"}, xyzFormat);
var zOutput = createVariable({prefix: "Z"}, xyzFormat);
var feedOutput = createVariable({prefix: "F"}, feedFormat);

// Block numbers would appear here.
function writeBlock() {
  writeWords(arguments);
}
)";

constexpr std::string_view kEntries = R"(
function onOpen() {
  writeln("%");
}

// Tool, offsets and the path to the first point are the operator's.
function onSection() {
  if (unit !== MM) {
    error(localize("the post prints millimetres, the document is not in millimetres"));
    return;
  }
  writeBlock("G17 G21 G40 G80 G90 G94");
}

function onRapid(x, y, z) {
  writeBlock(gMotionModal.format(0), xOutput.format(x), yOutput.format(y), zOutput.format(z));
}

function onLinear(x, y, z, feed) {
  writeBlock(gMotionModal.format(1), xOutput.format(x), yOutput.format(y), zOutput.format(z),
    feedOutput.format(feed));
}
)";

} // namespace

std::vector<EmittedLine> postHead() {
  Script script;
  script.text(kHeader);
  return script.lines();
}

std::vector<EmittedLine> postTail(const std::vector<std::string>& prefixes,
                                  const std::vector<std::string>& closing) {
  Script script;
  // Nothing else is printed by this post.
  if (!prefixes.empty()) script.add("properties.dotekCycle.value = " + quoted(prefixes.front()) + ";");
  script.text(kEntries);
  script.blank();
  script.open("function onCyclePoint(x, y, z) {");
  for (const std::string& prefix : prefixes) {
    script.open("if (" + prefix + "_dispatch(x, y, z)) {");
    script.add("return;");
    script.close();
  }
  script.add("error(localize(\"the operation names no probing cycle: its property dotekCycle\"));");
  script.close();
  script.blank();
  script.open("function onClose() {");
  script.add("writeBlock(\"M30\");");
  for (const std::string& prefix : closing)
    script.add(prefix + "_close();");
  script.add("writeln(\"%\");");
  script.close();
  return script.lines();
}

std::vector<EmittedLine> postAround(const std::vector<std::vector<EmittedLine>>& fragments,
                                    const std::vector<std::string>& prefixes,
                                    const std::vector<std::string>& closing) {
  Script script;
  script.append(postHead());
  for (const auto& fragment : fragments) {
    script.blank();
    script.append(fragment);
  }
  script.append(postTail(prefixes, closing));
  return script.lines();
}

} // namespace dotek::backends::fusion
