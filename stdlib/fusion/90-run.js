// ---- a run ---------------------------------------------------------------------------------------------------------

var CYCLE_LENGTHS = ["clearance", "retract", "stock", "depth", "bottom", "probeClearance", "probeOvertravel", "width1",
  "width2", "probeSpacing", "widthPCD", "widthFeature", "incrementalDepth", "minimumIncrementalDepth",
  "incrementalDepthReduction", "accumulatedDepth", "chipBreakDistance", "diameter", "pitch", "shift", "plungeDistance",
  "backBoreDistance", "incrementalX", "incrementalZ"];

function parameter(name, value) {
  state.parameters[name] = value;
  callEntry("onParameter", [name, value]);
}

function parameters(of) {
  for (var name in of) {
    if (Object.prototype.hasOwnProperty.call(of, name)) {
      parameter(name, of[name]);
    }
  }
}

function commandOf(name) {
  var value = values[name] === undefined ? values["COMMAND_" + String(name).toUpperCase().replace(/-/g, "_")] : values[name];
  if (value === undefined) {
    throw sourceError("`" + name + "` is no command of the kernel");
  }
  return value;
}

// Between these two the feed follows the spindle: passes of a thread.
function command(which) {
  if (which === values.COMMAND_ACTIVATE_SPEED_FEED_SYNCHRONIZATION) {
    state.synchronized = true;
  } else if (which === values.COMMAND_DEACTIVATE_SPEED_FEED_SYNCHRONIZATION) {
    state.synchronized = false;
  }
  handOn("onCommand", [which]);
}

// What the engine does of a record for which the post has no function, no source states. Moves of five axes are
// not left out: nothing else would tell of them.
function handOn(name, parameters) {
  if (callEntry(name, parameters)) {
    return;
  }
  if (/5D$/.test(name)) {
    throw endRun(new Stop("expand", "the post has no " + name + ": moves of five axes are left to the engine, and no source states what it does"));
  }
  unproven("the job comes to " + name + ", which the post does not have; nothing is printed there");
}

// What stands between operations or in them by hand.
function manual(record) {
  var command = commandOf(record.command);
  if (entry("onManualNC") !== undefined) {
    callEntry("onManualNC", [command, record.value]);
  } else {
    global.expandManualNC(command, record.value);
  }
}

function circular(record) {
  var to = transformed(vectorOf(record.to, true));
  var center = transformed(vectorOf(record.center, true));
  var normals = {XY: new Vector(0, 0, 1), ZX: new Vector(0, 1, 0), YZ: new Vector(1, 0, 0)};
  var normal = record.normal ? vectorOf(record.normal) : normals[record.plane || "XY"];
  var start = state.position || new Vector();
  state.motion = {start: start, end: to, center: center, normal: normal, clockwise: Boolean(record.clockwise),
    feed: record.feed, full: record.full === true};
  handOn("onCircular", [Boolean(record.clockwise), center.x, center.y, center.z, to.x, to.y, to.z, record.feed]);
  state.motion = undefined;
  moveTo(to);
}

function cycleRecord(record) {
  var cycle = {};
  Object.keys(record.cycle).forEach(function (name) {
    cycle[name] = CYCLE_LENGTHS.indexOf(name) < 0 ? record.cycle[name] : rounded(record.cycle[name]);
  });
  global.cycle = cycle;
  global.cycleType = record.type;
  global.cycleExpanded = false;
  state.cyclePoints = record.points.map(function (point) { return transformed(vectorOf(point, true)); });
  state.cyclePoint = 0;
  state.expanding = false;
  callEntry("onCycle");
  state.cyclePoints.forEach(function (point, i) {
    state.cyclePoint = i;
    if (entry("onCyclePoint") !== undefined) {
      callEntry("onCyclePoint", [point.x, point.y, point.z]);
    } else {
      expandCyclePoint(point.x, point.y, point.z);
    }
    if (global.cycleExpanded) {
      return; // the moves have led it where it is
    }
    // After a cycle the tool is at the height of its end, over the point.
    var height = cycle.retract === undefined ? cycle.clearance : cycle.retract;
    moveTo(new Vector(point.x, point.y, height === undefined ? point.z : height));
  });
  callEntry("onCycleEnd");
  // Both keep their values: posts ask for the last cycle afterwards.
}

function carryOut(record) {
  var to;
  if (record.to !== undefined) {
    to = transformed(vectorOf(record.to, true));
    state.target = to;
  }
  if (record.feed !== undefined) {
    state.feed = record.feed;
    global.feedrate = record.feed;
  }
  switch (record.record) {
  case "rapid":
    global.movement = values.MOVEMENT_RAPID;
    handOn("onRapid", [to.x, to.y, to.z]);
    moveTo(to);
    break;
  case "linear":
    handOn("onLinear", [to.x, to.y, to.z, record.feed]);
    moveTo(to);
    break;
  case "rapid5":
  case "linear5":
    var axis = vectorOf(record.axis);
    if (record.record === "rapid5") {
      handOn("onRapid5D", [to.x, to.y, to.z, axis.x, axis.y, axis.z]);
    } else {
      handOn("onLinear5D", [to.x, to.y, to.z, axis.x, axis.y, axis.z, record.feed, values.FEED_FPM]);
    }
    state.direction = axis;
    moveTo(to);
    break;
  case "circular": circular(record); break;
  case "cycle": cycleRecord(record); break;
  case "dwell": handOn("onDwell", [record.seconds]); break;
  case "spindle":
    global.spindleSpeed = record.rpm;
    handOn("onSpindleSpeed", [record.rpm]);
    break;
  case "command": command(commandOf(record.command)); break;
  case "manual": manual(record); break;
  case "comment": callEntry("onComment", [record.text]); break;
  case "passthrough": handOn("onPassThrough", [record.text]); break;
  case "parameter": parameter(record.name, record.value); break;
  case "movement":
    global.movement = movementOf(record.movement);
    callEntry("onMovement", [global.movement]);
    break;
  case "power":
    state.power = record.on === true;
    callEntry("onPower", [state.power]);
    break;
  case "compensation":
    global.radiusCompensation = values["RADIUS_COMPENSATION_" + String(record.side).toUpperCase()];
    handOn("onRadiusCompensation");
    break;
  default: throw sourceError("`" + record.record + "` is no record of a job");
  }
}

function runSection(section) {
  checkClaim(section);
  (section.dotek.before || []).forEach(carryOut);
  state.parameters = {};
  state.skip = false;
  state.synchronized = false;
  state.section = section;
  state.record = -1;
  global.currentSection = section;
  global.tool = section.dotekTool;
  global.spindleSpeed = section.dotekTool.spindleRPM;
  global.radiusCompensation = values.RADIUS_COMPENSATION_OFF;
  global.movement = values.MOVEMENT_RAPID;
  parameters(section.dotekParameters);
  state.position = section.getInitialPosition();
  var type = section.getFirstCycle();
  var special = type !== "" && section.doesStrictCycle(type) && state.special !== undefined && state.special[type];
  callEntry(special ? "onSectionSpecialCycle" : "onSection");
  for (var i = 0; i < section.dotekRecords.length && !state.skip; ++i) {
    state.record = i;
    carryOut(section.dotekRecords[i]);
  }
  callEntry(special ? "onSectionEndSpecialCycle" : "onSectionEnd");
}

function setProperties(of) {
  checkProperties(of);
  Object.keys(of).forEach(function (name) { setProperty(name, of[name]); });
}

function runJob(job) {
  setProperties(job.properties || {});
  global.programName = job.programName === undefined ? "1001" : job.programName;
  global.programComment = job.programComment === undefined ? "" : job.programComment;
  state.includes = job.includes || {};
  state.sections = [];
  (job.sections || []).forEach(function (one) { checkProperties(one.properties); });
  (job.sections || []).forEach(function (one, i) { state.sections.push(new Section(one, i)); });
  if (global.dotekUnits !== undefined) {
    global.dotekUnits();
  }
  callEntry("onMachine");
  callEntry("onOpen");
  parameters(job.parameters || {});
  state.sections.forEach(runSection);
  (job.after || []).forEach(carryOut);
  // Posts ask for the last section in onClose.
  callEntry("onClose");
  state.closed = true;
  callEntry("onTerminate");
  state.handlers.reverse().forEach(function (call) { call(); });
  if (state.redirected.length > 0) {
    warning("the post ends while its text is redirected; what is in the buffer is lost");
  }
}

function faultOf(thrown) {
  if (thrown instanceof Stop) {
    return {kind: thrown.dotekStop, text: thrown.text, stack: thrown.stack, section: thrown.section, cycle: thrown.cycle};
  }
  var is = thrown !== null && typeof thrown === "object" && thrown.message !== undefined;
  return {kind: "thrown", text: is ? String(thrown) : "it throws " + String(thrown),
    stack: is ? thrown.stack : "", section: state.section, cycle: global.cycleType};
}

function at(places) {
  return places.map(function (one) { return one.source + "\t" + one.line + "\t" + one.name; }).join("\n");
}

// What a program of the job needs of a machine: number and diameter in mm of the probe, and the work offsets.
function probeOf() {
  var probes = state.sections.filter(function (one) { return one.dotekTool.type === values.TOOL_PROBE; });
  if (probes.length === 0) {
    return [];
  }
  var tool = probes[0].dotekTool;
  var offsets = {};
  state.sections.forEach(function (one) { offsets[one.workOffset || 1] = true; });
  return ["T" + [tool.number, tool.diameter * (isMillimetre() ? 1 : 25.4)].concat(Object.keys(offsets)).join("\n")];
}

// The list: of each text the first letter says what it is. N: the program; M: a line of the map; F: a file; W: a
// warning; L: the log; E: what ended the run, with places and circumstances; T: the probe; P: a property; C: a
// capability.
function run(job) {
  var against = replaced();
  if (against !== "") {
    return [replacedFault(against)];
  }
  loading = false;
  begin(job);
  if (job.list === "properties") {
    return propertiesOf();
  }
  var out = [];
  var fault;
  try {
    runJob(job);
  } catch (thrown) {
    fault = faultOf(thrown);
  }
  against = replaced();
  if (against !== "") {
    return [replacedFault(against)];
  }
  if (loadFault !== undefined || state.stopped !== undefined) {
    fault = faultOf(loadFault || state.stopped);
  }
  // A post that catches the engine's bounds prints what depends on them.
  if (fault === undefined && boundOf() !== undefined) {
    fault = {kind: "thrown", text: "Error: " + boundOf(), stack: "", section: undefined, cycle: undefined};
  }
  if (fault === undefined) { // of one that fails there is no program
    out.push("N" + state.text.join(""));
    state.places.forEach(function (places) { out.push("M" + at(places || [])); });
    out = out.concat(probeOf());
  }
  Object.keys(state.files).forEach(function (name) { out.push("F" + name + "\n" + state.files[name]); });
  state.warnings.forEach(function (one) { out.push("W" + one.text.replace(/\n/g, " ") + "\n" + at(one.places)); });
  state.log.forEach(function (text) { out.push("L" + text); });
  if (fault !== undefined) {
    var of = fault.section;
    out.push("E" + [fault.kind, fault.text.replace(/\n/g, " "), of === undefined ? "" : String(of.dotekId + 1),
      of === undefined ? "" : String(of.getParameter("operation-comment", "")),
      fault.cycle === undefined ? "" : fault.cycle].join("\n") + "\n" + at(placesOfStack(fault.stack)));
  }
  return out;
}

function propertiesOf() {
  var all = global.properties || {};
  var about = global.propertyDefinitions || {};
  var out = [];
  Object.keys(all).forEach(function (name) {
    var of = all[name] !== null && typeof all[name] === "object" ? all[name] : about[name] || {};
    var choices = (of.values || []).map(function (one) {
      return one !== null && typeof one === "object" ? one.id : one;
    });
    out.push("P" + [name, JSON.stringify(valueOfProperty(all[name])), of.title || "", choices.join(" ")].join("\n"));
  });
  ["MILLING", "TURNING", "JET", "ADDITIVE"].forEach(function (name) {
    if ((global.capabilities & values["CAPABILITY_" + name]) !== 0) {
      out.push("C" + name.toLowerCase());
    }
  });
  return out;
}

// The machine simulation of Fusion: nobody looks.
function simulationOf() {
  var out = {};
  ["moveToTargetInMachineCoords", "moveToTargetInWorkCoords", "performToolChangeCycle", "retractAlongToolAxisToLimit",
    "setFeedrate", "setMotionToLinear", "setMotionToRapid", "setTCPModeOff", "setTCPModeOn",
    "setTWPModeAlignToCurrentPose", "setTWPModeByEulerAngles", "setTWPModeOff", "setTargetA", "setTargetB", "setTargetC",
    "setTargetX", "setTargetY", "setTargetZ"].forEach(function (name) { out[name] = function () {}; });
  return out;
}

// Called by what is loaded between the kernel and the post: constants, settings, the unit.
global.dotekPrepare = function (setup) {
  settings = setup.settings;
  values = setup.values;
  values.MM = settings.mm;
  values.IN = settings["in"];
  values.X = 0;
  values.Y = 1;
  values.Z = 2;
  values.A = 3;
  values.B = 4;
  values.C = 5;
  values.ABC = 6;
  values.DEG = 180 / Math.PI;
  values.EOL = "\n";
  values.PATH_SEPARATOR = "/";
  ["NUL", "SOH", "STX", "ETX", "EOT", "ENQ", "ACK", "BEL", "BS", "TAB", "LF", "VT", "FF", "CR", "SO", "SI", "DLE", "DC1",
    "DC2", "DC3", "DC4", "NAK", "SYN", "ETB", "CAN", "EM", "SUB", "ESC", "FS", "GS", "RS", "US", "SP"].forEach(
    function (name, i) { values[name] = String.fromCharCode(i); });
  for (var name in values) {
    global[name] = values[name];
  }
  Object.keys(values).forEach(function (one) {
    if (one.indexOf("EULER_") === 0) {
      Object.defineProperty(Matrix.prototype, "euler" + one.substring(6), {
        configurable: true, get: function () { return this.getEuler2(values[one]); }
      });
    }
  });
  arcVariables();
  ownEntries(setup.entries);
  setup.missing.forEach(function (one) {
    if (global[one] === undefined) {
      global[one] = function () {
        throw sourceError("`" + one + "` of Fusion is not carried out by Dotek's kernel");
      };
    }
  });
  watch();
  begin({});
  loading = true;
  state.includes = setup.includes || {};
  state.sections = [];
  give({unit: setup.inch ? values.IN : values.MM, revision: settings.revision, version: "Dotek", properties: {},
    machineConfiguration: new MachineConfiguration(), cycleType: "", cycleExpanded: false, programName: "1001",
    programComment: "", movement: values.MOVEMENT_RAPID, radiusCompensation: values.RADIUS_COMPENSATION_OFF,
    spindleSpeed: 0, feedrate: 0, highFeedrate: setup.inch ? 200 : 5000,
    highFeedMapping: values.HIGH_FEED_NO_MAPPING, tolerance: setup.inch ? 0.0001 : 0.002, extension: "nc",
    capabilities: 0, description: "", vendor: "", vendorUrl: "", legal: "", longDescription: "",
    minimumRevision: 0, certificationLevel: 0, programNameIsInteger: false, mapWorkOrigin: true, mapToWCS: true,
    preventPost: false, modelImagePath: "", setupImagePath: "", model: "", debugMode: false, outputUnit: setup.inch ? values.IN : values.MM, lineNumber: 0,
    currentSection: undefined, tool: undefined, cycle: undefined, allowedCircularPlanes: undefined,
    allowHelicalMoves: true, allowSpiralMoves: false, minimumChordLength: 0, minimumCircularRadius: 0,
    maximumCircularRadius: 0, minimumCircularSweep: 0, maximumCircularSweep: 0, simulation: simulationOf(),
    probeMultipleFeatures: false, allowMachineChangeOnSection: false, safeRetractDistance: 0, safeRetractFeed: 0,
    safePlungeFeed: 0, bufferRotaryMoves: false, spindleAxis: values.Z, abortOnDeprecation: false,
    allowFeedPerRevolutionDrilling: false, allowRotatedToolpath: false, deprecated: false, filename: "", keywords: "",
    supportedFeatures: 0, groupDefinitions: undefined, propertyDefinitions: undefined, wcsDefinitions: undefined});
};

return run;
})((function () { return this; }()) || Function("return this")());
