// A lathe post of the tests: what a post asks of a turning operation.
description = "Lathe";
capabilities = CAPABILITY_TURNING;
allowedCircularPlanes = 1 << PLANE_ZX;

properties = {
  frontTurret: {title: "Turret before the axis", group: "machine", type: "boolean", value: false, scope: "post"}
};
groupDefinitions = {machine: {title: "Machine", order: 1}};

var lengths = createFormat({decimals: 3});
var xOutput = createOutputVariable({prefix: "X"}, createFormat({decimals: 3, scale: 2}));
var zOutput = createOutputVariable({prefix: "Z"}, lengths);
var feedOutput = createOutputVariable({prefix: "F"}, createFormat({decimals: 3}));
var speeds = createFormat({decimals: 0});
var wantsCompensation = false;

function writeBlock() {
  writeWords(arguments);
}

function onOpen() {
  writeln("%");
  writeln("O" + programName);
}

function onSection() {
  var surface = tool.getSpindleMode() == SPINDLE_CONSTANT_SURFACE_SPEED;
  writeBlock("T0" + tool.number + "0" + tool.compensationOffset);
  writeBlock(currentSection.feedMode == FEED_PER_REVOLUTION ? "G99" : "G98");
  if (surface) {
    writeBlock("G50", "S" + speeds.format(tool.maximumSpindleSpeed));
    writeBlock("G96", "S" + speeds.format(tool.surfaceSpeed / 1000), tool.clockwise ? "M3" : "M4");
  } else {
    writeBlock("G97", "S" + speeds.format(tool.spindleRPM), tool.clockwise ? "M3" : "M4");
  }
  if (surface != (getParameter("operation:tool_useConstantSurfaceSpeed") == 1) ||
      (currentSection.feedMode == FEED_PER_REVOLUTION) != (getParameter("operation:tool_useFeedPerRevolution") == 1)) {
    error(localize("The parameters say something else."));
    return;
  }
  if (currentSection.tailstock) {
    writeBlock("M21");
  }
  [xOutput, zOutput, feedOutput].forEach(function (one) { one.reset(); });
}

function onRapid(x, y, z) {
  writeBlock("G0", xOutput.format(x), zOutput.format(z));
}

function onLinear(x, y, z, feed) {
  if (isSpeedFeedSynchronizationActive()) {
    writeBlock("G32", xOutput.format(x), zOutput.format(z), "F" + lengths.format(getParameter("operation:threadPitch")));
    feedOutput.reset();
    return;
  }
  var side = "";
  if (wantsCompensation) {
    wantsCompensation = false;
    side = radiusCompensation == RADIUS_COMPENSATION_LEFT ? "G41" :
      radiusCompensation == RADIUS_COMPENSATION_RIGHT ? "G42" : "G40";
  }
  writeBlock("G1", side, xOutput.format(x), zOutput.format(z), feedOutput.format(feed));
}

function onCircular(clockwise, cx, cy, cz, x, y, z, feed) {
  var start = getCurrentPosition();
  writeBlock(clockwise != getProperty("frontTurret") ? "G2" : "G3", xOutput.format(x), zOutput.format(z),
    "I" + lengths.format(cx - start.x), "K" + lengths.format(cz - start.z), feedOutput.format(feed));
}

function onRadiusCompensation() {
  wantsCompensation = true;
}

function onDwell(seconds) {
  writeBlock("G4", "U" + lengths.format(seconds));
}

function onCommand(command) {
  switch (command) {
  case COMMAND_ACTIVATE_SPEED_FEED_SYNCHRONIZATION:
  case COMMAND_DEACTIVATE_SPEED_FEED_SYNCHRONIZATION:
    return;
  default:
    onUnsupportedCommand(command);
  }
}

function onCyclePoint(x, y, z) {
  switch (cycleType) {
  case "thread-turning":
    zOutput.reset();
    writeBlock("G92", xOutput.format(x - cycle.incrementalX), zOutput.format(z), "F" + lengths.format(cycle.pitch));
    return;
  case "drilling":
    writeBlock("G74", "Z" + lengths.format(z - cycle.depth), feedOutput.format(cycle.feedrate));
    return;
  default:
    expandCyclePoint(x, y, z);
  }
}

function onSectionEnd() {
  writeBlock("M5");
}

function onClose() {
  writeBlock("M30");
  writeln("%");
}
