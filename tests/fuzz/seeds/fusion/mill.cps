// A post of the tests: the probing blocks that shared/reference states as golden, written for these tests.
description = "Probing mill";
vendor = "Tests";
extension = "nc";
minimumRevision = 45892;
capabilities = CAPABILITY_MILLING | CAPABILITY_INSPECTION;

properties = {
  showNumbers: {title: "Block numbers", group: "formats", type: "boolean", value: false, scope: "post"},
  firstNumber: {title: "First number", group: "formats", type: "integer", value: 10, scope: "post"}
};
groupDefinitions = {formats: {title: "Formats", order: 1}};

let blockNumber = 0;
const lengths = createFormat({decimals: unit == MM ? 3 : 4, type: FORMAT_REAL});
const plain = createFormat({decimals: 3});
const feeds = createFormat({decimals: 0, type: FORMAT_REAL});
const xOutput = createOutputVariable({prefix: "X"}, lengths);
const yOutput = createOutputVariable({prefix: "Y"}, lengths);
const zOutput = createOutputVariable({prefix: "Z"}, lengths);
const feedOutput = createOutputVariable({prefix: "F"}, feeds);

function writeBlock(...words) {
  const text = formatWords(words);
  if (!text) {
    return;
  }
  if (getProperty("showNumbers")) {
    writeWords2(`N${blockNumber}`, text);
    blockNumber += 5;
  } else {
    writeWords(text);
  }
}

function onOpen() {
  blockNumber = getProperty("firstNumber");
  writeln("%");
  writeln(`O${programName}${programComment ? " (" + programComment + ")" : ""}`);
}

function onSection() {
  writeBlock("(" + getParameter("operation-comment", "") + ")");
  for (const one of [xOutput, yOutput, zOutput, feedOutput]) {
    one.reset();
  }
  const {x, y, z} = getFramePosition(currentSection.getInitialPosition());
  writeBlock("G0", xOutput.format(x), yOutput.format(y), zOutput.format(z));
}

function onRapid(x, y, z) {
  const words = formatWords(xOutput.format(x), yOutput.format(y), zOutput.format(z));
  writeBlock(words && "G0", words);
}

function onLinear(x, y, z, feed) {
  writeBlock("G1", xOutput.format(x), yOutput.format(y), zOutput.format(z), feedOutput.format(feed));
}

function onCircular(clockwise, cx, cy, cz, x, y, z, feed) {
  const start = getCurrentPosition();
  writeBlock(clockwise ? "G2" : "G3", xOutput.format(x), yOutput.format(y), zOutput.format(z),
    "I" + lengths.format(cx - start.x), "J" + lengths.format(cy - start.y), feedOutput.format(feed));
}

function onDwell(seconds) {
  writeBlock("G4", "P" + plain.format(seconds * 1000));
}

function onCommand(command) {
  switch (command) {
  case COMMAND_STOP:
    writeBlock("M0");
    return;
  default:
    onUnsupportedCommand(command);
  }
}

function onComment(text) {
  writeBlock("(" + text + ")");
}

function safely(x, y, z) {
  const down = z < getCurrentPosition().z;
  const words = [xOutput.format(x), yOutput.format(y)].filter((word) => word !== "");
  const height = zOutput.format(z);
  if (height && !down) {
    writeBlock("G65", "P9810", height, feedOutput.format(cycle.feedrate));
  }
  if (words.length > 0) {
    writeBlock("G65", "P9810", words, feedOutput.format(5000));
  }
  if (height && down) {
    writeBlock("G65", "P9810", height, feedOutput.format(cycle.feedrate));
  }
}

const sign = (direction) => (direction == "positive" ? 1 : -1);
const word = (letter, value) => letter + lengths.format(value);

function tail(withOffset = true) {
  const out = ["Q" + lengths.format(cycle.probeOvertravel)];
  if (withOffset && currentSection.strategy == "probe") {
    out.push("S" + createFormat({decimals: 0, type: FORMAT_REAL}).format(currentSection.probeWorkOffset));
  }
  return out;
}

function onCyclePoint(x, y, z) {
  if (!isProbingCycle(cycleType)) {
    expandCyclePoint(x, y, z);
    return;
  }
  const depth = z - cycle.depth;
  const reach = (at, direction) => at + sign(direction) * (cycle.probeClearance + tool.diameter / 2);
  const inside = /hole$|channel$|corner$|angle$|^probing-[xy]$/.test(cycleType) && !/pcd/.test(cycleType);
  safely(x, y, z);
  if (inside) {
    safely(x, y, depth);
  } else if (cycleType == "probing-z") {
    safely(x, y, Math.min(depth + cycle.probeClearance, cycle.retract));
  }
  const [q, s = ""] = tail();
  const island = /island/.test(cycleType);
  const radius = word("R", island ? -cycle.probeClearance : cycle.probeClearance);
  const arc = () => [word("A", cycle.partialCircleAngleA), word("B", cycle.partialCircleAngleB), word("C", cycle.partialCircleAngleC)];
  switch (cycleType) {
  case "probing-x": writeBlock("G65", "P9811", word("X", reach(x, cycle.approach1)), q, s); break;
  case "probing-y": writeBlock("G65", "P9811", word("Y", reach(y, cycle.approach1)), q, s); break;
  case "probing-z": writeBlock("G65", "P9811", word("Z", depth), q, s); break;
  case "probing-x-wall":
  case "probing-x-channel-with-island": writeBlock("G65", "P9812", word("X", cycle.width1), word("Z", depth), q, radius, s); break;
  case "probing-y-wall":
  case "probing-y-channel-with-island": writeBlock("G65", "P9812", word("Y", cycle.width1), word("Z", depth), q, radius, s); break;
  case "probing-x-channel": writeBlock("G65", "P9812", word("X", cycle.width1), q, s); break;
  case "probing-y-channel": writeBlock("G65", "P9812", word("Y", cycle.width1), q, s); break;
  case "probing-xy-circular-boss": writeBlock("G65", "P9814", word("D", cycle.width1), word("Z", depth), q, radius, s); break;
  case "probing-xy-circular-hole": writeBlock("G65", "P9814", word("D", cycle.width1), q, s); break;
  case "probing-xy-circular-hole-with-island": writeBlock("G65", "P9814", word("Z", depth), word("D", cycle.width1), q, radius, s); break;
  case "probing-xy-circular-partial-boss": writeBlock("G65", "P9823", arc(), word("D", cycle.width1), word("Z", depth), q, radius, s); break;
  case "probing-xy-circular-partial-hole": writeBlock("G65", "P9823", arc(), word("D", cycle.width1), q, s); break;
  case "probing-xy-circular-partial-hole-with-island": writeBlock("G65", "P9823", word("Z", depth), arc(), word("D", cycle.width1), q, radius, s); break;
  case "probing-xy-rectangular-hole":
    writeBlock("G65", "P9812", word("X", cycle.width1), q, s);
    writeBlock("G65", "P9812", word("Y", cycle.width2), q, s);
    break;
  case "probing-xy-rectangular-boss":
    writeBlock("G65", "P9812", word("Z", depth), word("X", cycle.width1), radius, q, s);
    writeBlock("G65", "P9812", word("Z", depth), word("Y", cycle.width2), radius, q, s);
    break;
  case "probing-xy-rectangular-hole-with-island":
    writeBlock("G65", "P9812", word("Z", depth), word("X", cycle.width1), q, radius, s);
    writeBlock("G65", "P9812", word("Z", depth), word("Y", cycle.width2), q, radius, s);
    break;
  case "probing-xy-inner-corner":
  case "probing-xy-outer-corner":
    writeBlock("G65", cycleType == "probing-xy-inner-corner" ? "P9815" : "P9816", word("X", reach(x, cycle.approach1)),
      word("Y", reach(y, cycle.approach2)), conditional(cycle.probeSpacing != 0, word("I", cycle.probeSpacing)),
      conditional(cycle.probeSpacing != 0, word("J", cycle.probeSpacing)), q, s);
    break;
  case "probing-x-plane-angle":
    writeBlock("G65", "P9843", word("X", reach(x, cycle.approach1)), word("D", cycle.probeSpacing), q, word("A", cycle.nominalAngle));
    break;
  case "probing-y-plane-angle":
    writeBlock("G65", "P9843", word("Y", reach(y, cycle.approach1)), word("D", cycle.probeSpacing), q, word("A", cycle.nominalAngle));
    break;
  case "probing-xy-pcd-hole":
  case "probing-xy-pcd-boss":
    writeBlock("G65", "P9819", word("A", cycle.pcdStartingAngle), word("B", cycle.numberOfSubfeatures), word("C", cycle.widthPCD),
      word("D", cycle.widthFeature), word(cycleType == "probing-xy-pcd-hole" ? "K" : "Z", depth), q,
      conditional(cycleType == "probing-xy-pcd-boss", radius));
    break;
  default:
    cycleNotSupported();
  }
}

function onCycleEnd() {
  if (isProbingCycle(cycleType)) {
    zOutput.reset();
    writeBlock("G65", "P9810", zOutput.format(cycle.retract));
  }
}

function onClose() {
  writeBlock("M30");
  writeln("%");
}
