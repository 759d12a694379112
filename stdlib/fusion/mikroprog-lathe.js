// ---- functions of the post; what the control and the machine are is in `control` and `texts` above

var spatialFormat = createFormat({decimals: control.decimals});
var xFormat = createFormat({decimals: control.decimals, scale: 2}); // X is a diameter
var feedFormat = createFormat({decimals: 3});
var speedFormat = createFormat({decimals: 0});
var secondFormat = createFormat({decimals: 3});
var minuteFormat = createFormat({decimals: 2});
var toolFormat = createFormat({decimals: 0});

var gFormat = createFormat({prefix: "G", decimals: 0});
var mFormat = createFormat({prefix: "M", decimals: 0});
var xOutput = createVariable({prefix: "X"}, xFormat);
var zOutput = createVariable({prefix: "Z"}, spatialFormat);
var feedOutput = createVariable({prefix: "F"}, feedFormat);
var feedModeModal = createModal({}, gFormat);

var blockNumber;
var spindleOn = false;
var spindleClockwise; // undefined: it has not turned yet
var spindleSpeedWritten;
var pendingLimit; // of a G96 that is written where the cut begins
var currentTool;
var currentCoolant = COOLANT_OFF;
var feeds = []; // {number, title, value} of parametric feed, by movement
var feedWritten = false; // a G1, G2 or G3 has given the control a feed
var pendingCompensation = false;

function writeBlock() {
  var text = formatWords(arguments);
  if (!text) {
    return;
  }
  if (getProperty("showNumbers")) {
    writeWords("N" + blockNumber, text);
    blockNumber += getProperty("numberStep");
  } else {
    writeWords(text);
  }
}

// The control is of the days of DOS.
function plain(text) {
  return String(text).replace(/[^\x20-\x7e]/g, "?");
}

function writeComment(text) {
  writeln(";" + plain(text));
}

function withComment(text) {
  return ";" + plain(text);
}

function stopsOfSections() {
  return getProperty("m1EverySection") || getProperty("optionalStop");
}

function onOpen() {
  if (unit == IN) {
    error(localize(texts.inches));
    return;
  }
  blockNumber = getProperty("firstNumber");
  writeHeader();
  writeBlock(gFormat.format(control.plane), gFormat.format(control.absolute));
  if (stopsOfSections()) {
    writeBlock(mFormat.format(control.setCondition), "H2" + control.condition, withComment(texts.stopField));
    writeBlock(mFormat.format(control.setCondition), "H" + control.condition);
  }
  if (getProperty("writeG98")) {
    writeBlock(gFormat.format(control.reference));
  }
}

function writeHeader() {
  var seconds = 0;
  for (var i = 0; i < getNumberOfSections(); ++i) {
    seconds += getSection(i).getCycleTime();
  }
  var values = {
    cam: getGlobalParameter("generated-by", "Fusion"),
    author: getProperty("author"),
    date: String(new Date()),
    project: getGlobalParameter("job-description", ""),
    program: programName,
    comment: programComment,
    minutes: minuteFormat.format(seconds / 60)
  };
  texts.header.forEach(function (line) {
    writeComment(line.replace(/\{(\w+)\}/g, function (all, name) {
      return values[name];
    }));
  });
}

function onSection() {
  var comment = getParameter("operation-comment", "");
  if (comment) {
    writeComment(comment);
  }
  if (currentSection.getType() != TYPE_TURNING) {
    error(localize(texts.milling));
    return;
  }
  feeds = getProperty("parametricFeed") ? parametricFeeds() : [];
  feeds.forEach(function (one) {
    writeBlock("P" + one.number + "=" + feedFormat.format(one.value), withComment(one.title));
  });
  if (stopsOfSections() && (getProperty("m1EverySection") || !isFirstSection())) {
    writeOptionalStop();
  }
  if (currentTool === undefined || currentTool != tool.number || currentSection.getForceToolChange()) {
    writeToolBlock(mFormat.format(control.toolChange), "T" + toolFormat.format(tool.number));
  }
  feedModeModal.reset();
  writeBlock(feedModeModal.format(currentSection.feedMode == FEED_PER_REVOLUTION ? control.feedPerRevolution :
    control.feedPerMinute));
  startSpindle(getFramePosition(currentSection.getInitialPosition()).x * 2);
  setCoolant(tool.coolant);
  xOutput.reset();
  zOutput.reset();
  feedOutput.reset();
  feedWritten = false;
}

function writeOptionalStop() {
  writeBlock(mFormat.format(control.stopIf), getProperty("stopCondition"));
}

// The control has no place of its own for the change: the turret goes to the safe point before and after M6.
function writeToolBlock() {
  if (tool.number < 1 || tool.number > control.tools) {
    error(subst(localize(texts.toolNumber), tool.number, control.tools));
    return;
  }
  // The turret stops neither of them.
  setCoolant(COOLANT_OFF);
  if (spindleOn) {
    writeBlock(mFormat.format(control.spindleOff));
    spindleOn = false;
  }
  var x = getProperty("safeX") / 2; // a diameter, as programs have it
  var z = getProperty("safeZ");
  xOutput.reset();
  zOutput.reset();
  writeBlock(gFormat.format(control.rapid), xOutput.format(x), zOutput.format(z), withComment(texts.safePosition));
  writeBlock(arguments);
  xOutput.reset();
  zOutput.reset();
  writeBlock(gFormat.format(control.rapid), xOutput.format(x), zOutput.format(z));
  currentTool = tool.number;
}

function feedOf(name) {
  var perRevolution = currentSection.feedMode == FEED_PER_REVOLUTION;
  return getParameter("operation:" + name + (perRevolution ? "Rel" : ""), undefined);
}

function parametricFeeds() {
  var all = [
    {number: 1, title: "Cutting Feed", name: "tool_feedCutting", movements: [MOVEMENT_CUTTING, MOVEMENT_FINISH_CUTTING,
      MOVEMENT_LINK_TRANSITION, MOVEMENT_EXTENDED, MOVEMENT_REDUCED]},
    {number: 4, title: "Entry Feed", name: "tool_feedEntry", movements: [MOVEMENT_LEAD_IN]},
    {number: 5, title: "Exit Feed", name: "tool_feedExit", movements: [MOVEMENT_LEAD_OUT]},
    {number: 6, title: "Direct Feed", name: "tool_feedCutting", movements: [MOVEMENT_LINK_DIRECT]}
  ];
  all.forEach(function (one) { one.value = feedOf(one.name); });
  return all.filter(function (one) { return one.value !== undefined; });
}

function getFeed(feed) {
  for (var i = 0; i < feeds.length; ++i) {
    if (feeds[i].movements.indexOf(movement) >= 0 && !feedFormat.areDifferent(feeds[i].value, feed)) {
      feedOutput.reset();
      return "FP" + feeds[i].number;
    }
  }
  return feedOutput.format(feed);
}

function speedLimit() {
  var limit = getProperty("maximumSpindleSpeed");
  return tool.maximumSpindleSpeed > 0 ? Math.min(limit, tool.maximumSpindleSpeed) : limit;
}

function speedAt(diameter) {
  return xFormat.isSignificant(diameter / 2) ? Math.min(tool.surfaceSpeed / (Math.PI * Math.abs(diameter)), speedLimit()) :
    speedLimit();
}

// Constant surface speed: S is the speed at the first diameter, and G96 follows where the cut begins.
function startSpindle(firstDiameter) {
  var surface = tool.getSpindleMode() == SPINDLE_CONSTANT_SURFACE_SPEED;
  writeSpindle(surface ? speedAt(firstDiameter) : Math.min(tool.spindleRPM, speedLimit()));
  pendingLimit = surface ? speedLimit() : undefined;
}

// The control waits too short by itself where the direction changes.
function writeSpindle(speed) {
  var reversed = spindleClockwise !== undefined && spindleClockwise != tool.clockwise;
  writeBlock(mFormat.format(tool.clockwise ? control.spindleRight : control.spindleLeft), "S" + speedFormat.format(speed));
  if (reversed) {
    onDwell(control.reversalSeconds);
  }
  spindleOn = true;
  spindleClockwise = tool.clockwise;
  spindleSpeedWritten = speed;
}

// The control keeps the cutting speed that it has at this block, with the diameter and the speed of the moment.
function beginCut() {
  if (pendingLimit === undefined) {
    return;
  }
  var speed = speedAt(getCurrentPosition().x * 2);
  if (speedFormat.areDifferent(speed, spindleSpeedWritten)) {
    writeSpindle(speed);
  }
  writeBlock(gFormat.format(control.surfaceSpeed), "A" + speedFormat.format(pendingLimit));
  pendingLimit = undefined;
}

function onSpindleSpeed(speed) {
  pendingLimit = undefined;
  writeSpindle(Math.min(speed, speedLimit()));
}

function onDwell(seconds) {
  writeBlock(gFormat.format(control.dwell), "E" + secondFormat.format(seconds));
}

function setCoolant(mode) {
  if (mode != COOLANT_OFF && mode != COOLANT_FLOOD) {
    warning(localize(texts.coolant));
    return;
  }
  if (mode != currentCoolant) {
    writeBlock(mFormat.format(mode == COOLANT_OFF ? control.coolantOff : control.coolantOn));
    currentCoolant = mode;
  }
}

function onRadiusCompensation() {
  pendingCompensation = true;
}

// G41: the surface is on the right of the path, as in the CAM.
function compensationWord() {
  if (!pendingCompensation) {
    return "";
  }
  pendingCompensation = false;
  switch (radiusCompensation) {
  case RADIUS_COMPENSATION_LEFT:
    return gFormat.format(control.compensationLeft);
  case RADIUS_COMPENSATION_RIGHT:
    return gFormat.format(control.compensationRight);
  default:
    return gFormat.format(control.compensationOff);
  }
}

// G0 and G1 stand in each block on purpose: a block may be the first after a stop.
function onRapid(_x, _y, _z) {
  var x = xOutput.format(_x);
  var z = zOutput.format(_z);
  if (x || z) {
    writeBlock(gFormat.format(control.rapid), compensationWord(), x, z);
    feedOutput.reset();
  }
}

function onLinear(_x, _y, _z, feed) {
  if (isSpeedFeedSynchronizationActive()) {
    writeThreadPass(_x, _z, threadPitchOf());
    return;
  }
  var x = xOutput.format(_x);
  var z = zOutput.format(_z);
  if (x || z) {
    beginCut();
    writeBlock(gFormat.format(control.feed), compensationWord(), x, z, getFeed(feed));
    feedWritten = true;
  }
}

// By its radius: whether I and K count from the start is not known. An arc of more than 180 degrees has no radius.
function onCircular(clockwise, cx, cy, cz, x, y, z, feed) {
  if (isSpeedFeedSynchronizationActive()) {
    error(localize(texts.threadArc));
    return;
  }
  if (pendingCompensation) {
    error(localize(texts.compensationArc));
    return;
  }
  if (getCircularPlane() != PLANE_ZX || isFullCircle() || getCircularSweep() > Math.PI + 1e-6) {
    linearize(tolerance);
    return;
  }
  beginCut();
  xOutput.reset();
  zOutput.reset();
  writeBlock(gFormat.format(clockwise ? control.arcClockwise : control.arcCounterclockwise), xOutput.format(x),
    zOutput.format(z), "R" + spatialFormat.format(getCircularRadius()), getFeed(feed));
  feedWritten = true;
}

// ---- threads

function threadPitchOf() {
  return getParameter("operation:threadPitch", tool.threadPitch);
}

function checkPitch(pitch, limit) {
  if (!(pitch > 0)) {
    error(localize(texts.noPitch));
    return false;
  }
  if (limit !== undefined && pitch > limit) {
    error(subst(localize(texts.pitch), spatialFormat.format(pitch), spatialFormat.format(limit)));
    return false;
  }
  return true;
}

function writeThreadPass(x, z, pitch) {
  if (!checkPitch(pitch, undefined)) {
    return;
  }
  xOutput.reset();
  zOutput.reset();
  writeBlock(gFormat.format(control.thread), xOutput.format(x), zOutput.format(z), "K" + spatialFormat.format(pitch));
  feedOutput.reset();
}

// One pass after the other, from the clearance diameter and back to it.
function writeThreadPasses(x, z) {
  var start = z - cycle.incrementalZ;
  onRapid(cycle.clearance, 0, start);
  onRapid(x, 0, start);
  writeThreadPass(x, z, cycle.pitch);
  onRapid(cycle.clearance, 0, z);
  onRapid(cycle.clearance, 0, start);
}

// The whole thread in one block. Its infeed needs a feed, per minute, from before or in the block.
function writeThreadCycle(x, z) {
  if (!isLastCyclePoint()) {
    return;
  }
  if (!checkPitch(cycle.pitch, control.pitchLimit)) {
    return;
  }
  var depth = getParameter("operation:threadDepth", undefined);
  if (depth === undefined) {
    error(localize(texts.threadDepth));
    return;
  }
  var first = depth - Math.abs(getCyclePoint(0).x - x);
  onRapid(x + depth, 0, z - cycle.incrementalZ);
  var perMinute = feedModeModal.format(control.feedPerMinute);
  if (perMinute) {
    writeBlock(perMinute);
    feedWritten = false;
  }
  xOutput.reset();
  zOutput.reset();
  writeBlock(gFormat.format(control.threadCycle), xOutput.format(x), zOutput.format(z), "U" + spatialFormat.format(first),
    "K" + spatialFormat.format(cycle.pitch), conditional(!feedWritten, "F" + feedFormat.format(control.threadFeed)));
  feedWritten = true;
  feedOutput.reset();
}

// ---- cycles

// Each of them is one block, from where the tool is and back to there.
function writeDrilling(code, x, z, words) {
  onRapid(x, 0, cycle.retract);
  writeBlock(gFormat.format(code), "Z" + spatialFormat.format(z), words, getFeed(cycle.feedrate));
  feedWritten = true;
}

function onCyclePoint(x, y, z) {
  if (cycleType != "thread-turning" && (xFormat.isSignificant(x) || spatialFormat.isSignificant(y))) {
    error(localize(texts.offAxis));
    return;
  }
  switch (cycleType) {
  case "thread-turning":
    if (spatialFormat.isSignificant(cycle.incrementalX)) {
      error(localize(texts.taper));
      return;
    }
    if (getProperty("threads") == "cycle") {
      writeThreadCycle(x, z);
    } else {
      writeThreadPasses(x, z);
    }
    return;
  case "drilling":
    writeDrilling(control.drill, x, z, "");
    return;
  case "deep-drilling":
    writeDrilling(control.peck, x, z, "W" + spatialFormat.format(cycle.incrementalDepth));
    return;
  case "reaming":
    if (!(cycle.dwell > 0)) {
      writeDrilling(control.ream, x, z, "");
      return;
    }
    break;
  case "tapping":
  case "left-tapping":
  case "right-tapping":
  case "tapping-with-chip-breaking":
  case "left-tapping-with-chip-breaking":
  case "right-tapping-with-chip-breaking":
    error(localize(texts.tapping));
    return;
  default:
    break;
  }
  expandCyclePoint(x, y, z);
}

// ---- what is written by hand

function onComment(text) {
  writeComment(text);
}

// A comma begins the next block.
function onPassThrough(text) {
  String(text).split(",").forEach(function (one) {
    writeBlock(one.trim());
  });
}

function unsupported(name) {
  warning(subst(localize(texts.unsupported), name));
}

function writeStop(text) {
  writeBlock(mFormat.format(control.stop), text === undefined ? "" : withComment(text));
}

// What the machine lacks is a warning, in the words of the description.
// dotek: ignore post-command-not-reported
function onCommand(command) {
  switch (command) {
  case COMMAND_STOP:
    writeStop(undefined);
    return;
  case COMMAND_OPTIONAL_STOP:
    writeOptionalStop();
    return;
  case COMMAND_BREAK_CONTROL:
    writeStop(texts.checkTool);
    return;
  case COMMAND_CLEAN:
    writeStop(texts.clean);
    return;
  case COMMAND_ALERT:
    writeStop(texts.alert);
    return;
  case COMMAND_COOLANT_ON:
    setCoolant(COOLANT_FLOOD);
    return;
  case COMMAND_COOLANT_OFF:
    setCoolant(COOLANT_OFF);
    return;
  case COMMAND_STOP_SPINDLE:
    writeBlock(mFormat.format(control.spindleOff));
    spindleOn = false;
    return;
  case COMMAND_ACTIVATE_SPEED_FEED_SYNCHRONIZATION:
  case COMMAND_DEACTIVATE_SPEED_FEED_SYNCHRONIZATION:
    return;
  case COMMAND_TOOL_MEASURE:
    unsupported("TOOL_MEASURE");
    return;
  case COMMAND_CALIBRATE:
    unsupported("CALIBRATE");
    return;
  case COMMAND_VERIFY:
    unsupported("VERIFY");
    return;
  case COMMAND_ALARM:
    unsupported("ALARM");
    return;
  default:
    unsupported(getCommandStringId(command));
  }
}

function onParameter(name, value) {
  switch (name) {
  case "action":
    unsupported("action");
    return;
  case "print":
  case "display":
    writeBlock(mFormat.format(control.writeText) + " @scr.sou" + withComment(value));
    return;
  default:
  }
}

function onSectionEnd() {
  pendingCompensation = false;
}

function onClose() {
  setCoolant(COOLANT_OFF);
  writeBlock(mFormat.format(control.spindleOff));
  writeBlock(mFormat.format(control.end));
}
