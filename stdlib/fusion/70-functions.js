// ---- what posts ask ------------------------------------------------------------------------------------------------

function toRad(degrees) { return degrees / values.DEG; }
function isMillimetre() { return global.unit === values.MM; }

function nameOfProperty(definition) {
  var all = global.properties || {};
  for (var name in all) {
    if (all[name] === definition) {
      return name;
    }
  }
  return undefined;
}

function valueOfProperty(definition) {
  if (definition === null || typeof definition !== "object" || Array.isArray(definition)) {
    return definition;
  }
  if (definition.value !== undefined) {
    return definition.value;
  }
  return isMillimetre() ? definition.default_mm : definition.default_in;
}

// By its name, or the definition itself: posts do both.
function getProperty(name, otherwise) {
  if (name !== null && typeof name === "object") {
    var of = valueOfProperty(name);
    return of === undefined ? otherwise : of;
  }
  var all = global.properties || {};
  if (!Object.prototype.hasOwnProperty.call(all, name)) {
    return otherwise === undefined ? name === undefined ? undefined : name in all ? all[name] : undefined : otherwise;
  }
  var value = valueOfProperty(all[name]);
  return value === undefined ? otherwise : value;
}

function setProperty(name, value) {
  var all = global.properties;
  var key = name !== null && typeof name === "object" ? nameOfProperty(name) : name;
  var of = all[key];
  if (of !== null && typeof of === "object") {
    of.value = value;
  } else {
    all[key] = value;
  }
}

function transformed(position) {
  var out = position;
  if (state.rotation !== undefined) {
    out = state.rotation.multiply(out);
  }
  return state.translation === undefined ? out : Vector.sum(out, state.translation);
}

function moveTo(position) {
  state.position = position;
}

function hasParameter(name) {
  return Object.prototype.hasOwnProperty.call(state.parameters, name);
}

function neighbour(step) {
  return state.sections[(state.section === undefined ? -1 : state.section.dotekId) + step];
}

function movementOf(name) {
  var value = values[name] === undefined ? values["MOVEMENT_" + String(name).toUpperCase()] : values[name];
  if (value === undefined) {
    throw sourceError("`" + name + "` is no movement of the kernel");
  }
  return value;
}

function nameOfConstant(prefix, value) {
  for (var name in values) {
    if (name.indexOf(prefix) === 0 && values[name] === value) {
      return name;
    }
  }
  return "";
}

// ---- arcs

function motion() {
  if (state.motion === undefined) {
    throw sourceError("a question about an arc outside of onCircular");
  }
  return state.motion;
}
function circularPlane() {
  var normal = motion().normal;
  var planes = [["PLANE_XY", new Vector(0, 0, 1)], ["PLANE_ZX", new Vector(0, 1, 0)], ["PLANE_YZ", new Vector(1, 0, 0)]];
  for (var i = 0; i < planes.length; ++i) {
    if (Math.abs(Math.abs(Vector.dot(normal, planes[i][1])) - 1) < 1e-6) {
      return values[planes[i][0]];
    }
  }
  return -1;
}
function circularSweep() {
  var of = motion();
  if (of.full) {
    return 2 * Math.PI;
  }
  var a = Vector.diff(of.start, of.center);
  var b = Vector.diff(of.end, of.center);
  var n = of.normal;
  a = Vector.diff(a, Vector.product(n, Vector.dot(a, n)));
  b = Vector.diff(b, Vector.product(n, Vector.dot(b, n)));
  var angle = Math.atan2(Vector.dot(Vector.cross(a, b), n), Vector.dot(a, b));
  angle = of.clockwise ? -angle : angle;
  return angle <= 1e-12 ? angle + 2 * Math.PI : angle;
}
function circularRadius() {
  var of = motion();
  var a = Vector.diff(of.start, of.center);
  return Vector.diff(a, Vector.product(of.normal, Vector.dot(a, of.normal))).length;
}
function helicalDistance() {
  var of = motion();
  return Vector.dot(Vector.diff(of.end, of.start), of.normal);
}
function pointOfArc(part) {
  var of = motion();
  var angle = circularSweep() * part * (of.clockwise ? -1 : 1);
  var a = Vector.diff(of.start, of.center);
  var along = Vector.product(of.normal, helicalDistance() * part);
  var height = Vector.product(of.normal, Vector.dot(a, of.normal));
  var turned = Matrix.getAxisRotation(of.normal, angle).multiply(Vector.diff(a, height));
  return Vector.sum(Vector.sum(of.center, height), Vector.sum(turned, along));
}
function linearize(tolerance) {
  var of = motion();
  var radius = circularRadius();
  var step = tolerance >= radius ? Math.PI / 2 : 2 * Math.acos(1 - tolerance / radius);
  var count = Math.max(1, Math.ceil(circularSweep() / Math.min(step, Math.PI / 2)));
  for (var i = 1; i <= count; ++i) {
    var to = i === count ? of.end : pointOfArc(i / count);
    callEntry("onLinear", [to.x, to.y, to.z, of.feed]);
    moveTo(to);
  }
}

// ---- cycles that are moves

function expandCyclePoint(x, y, z) {
  global.cycleExpanded = true;
  var type = global.cycleType;
  var cycle = global.cycle;
  if (/^probing|^inspect/.test(type)) {
    throw endRun(new Stop("expand", "the post leaves `" + type + "` to the engine, whose moves no source states"));
  }
  var clearance = numberOf(cycle.clearance, "cycle.clearance");
  var retract = numberOf(cycle.retract === undefined ? cycle.clearance : cycle.retract, "cycle.retract");
  var bottom = cycle.bottom !== undefined ? cycle.bottom : z;
  var feed = cycle.feedrate;
  function rapid(height) {
    callEntry("onRapid", [x, y, height]);
    moveTo(new Vector(x, y, height));
  }
  function feedTo(height, at) {
    callEntry("onLinear", [x, y, height, at === undefined ? feed : at]);
    moveTo(new Vector(x, y, height));
  }
  function dwell() {
    if (cycle.dwell > 0) {
      callEntry("onDwell", [cycle.dwell]);
    }
  }
  rapid(clearance);
  if (retract < clearance) {
    rapid(retract);
  }
  var stock = cycle.stock === undefined ? z : cycle.stock;
  switch (type) {
  case "deep-drilling":
  case "chip-breaking":
    var peck = cycle.incrementalDepth > 0 ? cycle.incrementalDepth : stock - bottom;
    for (var depth = Math.max(bottom, stock - peck);; depth = Math.max(bottom, depth - peck)) {
      feedTo(depth);
      dwell();
      if (depth <= bottom) {
        break;
      }
      if (type === "deep-drilling") {
        rapid(retract);
        rapid(Math.min(retract, depth + settings["peck-clearance"] / (isMillimetre() ? 1 : 25.4)));
      } else {
        rapid(Math.min(retract, depth + (cycle.chipBreakDistance || 0)));
      }
    }
    rapid(clearance);
    break;
  case "reaming":
  case "boring":
  case "tapping":
  case "left-tapping":
  case "right-tapping":
    feedTo(bottom);
    dwell();
    feedTo(retract, cycle.retractFeedrate);
    rapid(clearance);
    break;
  case "drilling":
  case "counter-boring":
  case "stop-boring":
  case "fine-boring":
  case "back-boring":
  case "circular-pocket-milling":
  case "bore-milling":
  case "thread-milling":
  case "tapping-with-chip-breaking":
  default:
    if (type !== "drilling" && type !== "counter-boring" && type !== "break-through-drilling" &&
        type !== "gun-drilling") {
      throw endRun(new Stop("expand", "the post leaves `" + type + "` to the engine, whose moves no source states"));
    }
    feedTo(bottom);
    dwell();
    rapid(clearance);
  }
}

function isDrilling(type) {
  return type !== undefined && type !== "" && !/^probing|^inspect/.test(type);
}

// What holds for the arc that is carried out, by the names of the engine's variables.
function arcVariables() {
  var of = {clockwise: "isClockwise", center: "getCircularCenter", chordLength: "getCircularChordLength",
    fullCircle: "isFullCircle", helical: "isHelical", helicalDistance: "getHelicalDistance",
    helicalOffset: "getHelicalOffset", normal: "getCircularNormal", plane: "getCircularPlane",
    radius: "getCircularRadius", sweep: "getCircularSweep"};
  var out = {end: function () { return motion().end; }, length: function () { return circularRadius() * circularSweep(); }};
  Object.keys(of).forEach(function (name) { out[name] = global[of[name]]; });
  Object.keys(out).forEach(function (name) {
    Object.defineProperty(global, name, {configurable: true, get: out[name], set: function (value) {
      Object.defineProperty(global, name, {configurable: true, enumerable: true, writable: true, value: value});
    }});
  });
}

// A post may call an entry function that it leaves to the engine.
function ownEntries(names) {
  var known = {onExpandedRapid: "onRapid", onExpandedLinear: "onLinear"};
  names.forEach(function (name) {
    if (global[name] !== undefined) {
      return;
    }
    global[name] = function () {
      if (known[name] !== undefined) {
        callEntry(known[name], arguments);
      } else if (!state.told["entry " + name]) {
        state.told["entry " + name] = true;
        warning("the post calls " + name + ", which it does not define; no source states what the engine's own does: nothing is done");
      }
    };
    global[name].dotekOwn = true;
  });
}

function commandName(command) {
  return nameOfConstant("COMMAND_", command);
}

// A move that is no record of the job.
function invoke(name, of) {
  return function () {
    callEntry(name, arguments);
    if (of) {
      moveTo(new Vector(arguments[0], arguments[1], arguments[2]));
    }
  };
}

var TOOL_TYPES = {TOOL_DRILL: "drill", TOOL_DRILL_CENTER: "center drill", TOOL_DRILL_SPOT: "spot drill",
  TOOL_MILLING_END_FLAT: "flat end mill", TOOL_MILLING_END_BALL: "ball end mill",
  TOOL_MILLING_END_BULLNOSE: "bullnose end mill", TOOL_MILLING_CHAMFER: "chamfer mill", TOOL_MILLING_FACE: "face mill",
  TOOL_MILLING_SLOT: "slot mill", TOOL_TAP_RIGHT_HAND: "right hand tap", TOOL_TAP_LEFT_HAND: "left hand tap",
  TOOL_REAMER: "reamer", TOOL_BORING_BAR: "boring bar", TOOL_COUNTER_BORE: "counter bore",
  TOOL_COUNTER_SINK: "counter sink", TOOL_PROBE: "probe", TOOL_MILLING_THREAD: "thread mill"};

give({
  toDeg: function (radians) { return radians * values.DEG; },
  toRad: toRad,
  // 25 mm to the inch: for round defaults only.
  spatial: function (value, from) {
    return from === global.unit ? value : isMillimetre() ? value * 25 : value / 25;
  },
  toUnit: function (value, from) {
    return from === global.unit ? value : isMillimetre() ? value * 25 : value / 25;
  },
  toPreciseUnit: function (value, from) {
    return from === global.unit ? value : isMillimetre() ? value * 25.4 : value / 25.4;
  },
  parseSpatial: function (text) { return numberOf(text, "parseSpatial"); },
  clamp: function (low, value, high) { return Math.min(Math.max(low, value), high); },
  getAsInt: function (value) {
    var number = parseInt(value, 10);
    if (!isFinite(number) || !/^\s*[+-]?\d+\s*$/.test(String(value))) {
      throw sourceError("getAsInt: `" + value + "` is no whole number");
    }
    return number;
  },
  getAsFloat: function (value) { return numberOf(value, "getAsFloat"); },
  getProperty: getProperty, setProperty: setProperty,
  hasParameter: hasParameter,
  getParameter: function (name, otherwise) { return hasParameter(name) ? state.parameters[name] : otherwise; },
  hasGlobalParameter: function (name) { return (state.job.parameters || {})[name] !== undefined; },
  getGlobalParameter: function (name, otherwise) {
    var value = (state.job.parameters || {})[name];
    return value === undefined ? otherwise : value;
  },
  getNumberOfSections: function () { return state.sections.length; },
  getSection: function (i) {
    if (state.sections[i] === undefined) {
      throw sourceError("getSection(" + i + "): there are " + state.sections.length + " sections");
    }
    return state.sections[i];
  },
  getCurrentSectionId: function () { return state.section === undefined ? -1 : state.section.dotekId; },
  isFirstSection: function () { return state.section !== undefined && state.section.dotekId === 0; },
  isLastSection: function () {
    return state.section !== undefined && state.section.dotekId === state.sections.length - 1;
  },
  getPreviousSection: function () { return neighbour(-1); },
  getNextSection: function () { return neighbour(1); },
  hasNextSection: function () { return neighbour(1) !== undefined; },
  getNextTool: function (number) {
    for (var i = (state.section === undefined ? 0 : state.section.dotekId + 1); i < state.sections.length; ++i) {
      if (state.sections[i].dotekTool.number !== number) {
        return state.sections[i].dotekTool;
      }
    }
    return undefined;
  },
  getFirstTool: function () { return state.sections.length === 0 ? undefined : state.sections[0].dotekTool; },
  getToolTable: function () { return new ToolTable(); },
  getTool: function (i) { return new ToolTable().getTool(i); },
  isToolChangeNeeded: function (section) {
    var of = section === undefined || typeof section === "string" ? state.section : section;
    var before = of === undefined ? undefined : state.sections[of.dotekId - 1];
    return before === undefined || before.dotekTool.number !== of.dotekTool.number || of.getForceToolChange();
  },
  isNewWorkOffset: function () {
    var before = neighbour(-1);
    return before === undefined || before.workOffset !== state.section.workOffset;
  },
  isNewWorkPlane: function () {
    var before = neighbour(-1);
    return before === undefined || !isSameDirection(before.workPlane.forward, state.section.workPlane.forward);
  },
  getToolTypeName: function (type) { return TOOL_TYPES[nameOfConstant("TOOL_", type)] || "unspecified"; },
  getCoolantName: function (coolant) {
    return nameOfConstant("COOLANT_", coolant).replace("COOLANT_", "").toLowerCase().replace(/_/g, " ");
  },
  getMaterialName: function (material) {
    return nameOfConstant("MATERIAL_", material).replace("MATERIAL_", "").toLowerCase().replace(/_/g, " ");
  },
  getCommandStringId: function (command) {
    return commandName(command).replace("COMMAND_", "").toLowerCase().replace(/_/g, "-");
  },
  isWellKnownCommand: function (command) { return commandName(command) !== ""; },
  canIgnoreCommand: function () { return false; },
  onUnsupportedCommand: function (command) { warning("the command is not supported: " + commandName(command)); },
  onUnsupportedCoolant: function (coolant) {
    error("the coolant is not supported: " + nameOfConstant("COOLANT_", coolant));
  },
  onImpliedCommand: function () {},
  getCurrentPosition: function () { return state.position || new Vector(); },
  getCurrentGlobalPosition: function () { return state.position || new Vector(); },
  getCurrentDirection: function () { return state.direction || new Vector(0, 0, 1); },
  setCurrentPosition: moveTo,
  setCurrentPositionX: function (x) { moveTo(new Vector(x, global.getCurrentPosition().y, global.getCurrentPosition().z)); },
  setCurrentPositionY: function (y) { moveTo(new Vector(global.getCurrentPosition().x, y, global.getCurrentPosition().z)); },
  setCurrentPositionZ: function (z) { moveTo(new Vector(global.getCurrentPosition().x, global.getCurrentPosition().y, z)); },
  setCurrentDirection: function (direction) { state.direction = direction; },
  setCurrentPositionAndDirection: function (position) { moveTo(position); },
  getCurrentABC: function () { return state.abc || new Vector(); },
  setCurrentABC: function (abc) { state.abc = abc; },
  getFramePosition: transformed,
  getFrameDirection: function (direction) {
    return state.rotation === undefined ? direction : state.rotation.multiply(direction);
  },
  getGlobalPosition: function (position) {
    var of = state.section;
    return of === undefined ? position : Vector.sum(of.workPlane.multiply(position), of.workOrigin);
  },
  getWCSPosition: function (position) { return position; },
  getSectionPosition: function (position) { return position; },
  getPositionU: function (u) {
    var of = state.motion;
    if (of !== undefined && of.center !== undefined) {
      return pointOfArc(u);
    }
    var from = state.position || new Vector();
    return Vector.lerp(from, state.target || from, u);
  },
  setRotation: function (rotation) { state.rotation = rotation; },
  getRotation: function () { return state.rotation || new Matrix(); },
  setTranslation: function (translation) { state.translation = translation; },
  getTranslation: function () { return state.translation || new Vector(); },
  cancelTransformation: function () { state.rotation = undefined; state.translation = undefined; },
  is3D: function () { return !state.sections.some(function (section) { return section.isMultiAxis(); }); },
  isMultiAxis: function () { return state.section !== undefined && state.section.isMultiAxis(); },
  isMilling: function () { return state.section === undefined || state.section.isMilling(); },
  isTurning: function () { return state.section !== undefined && state.section.isTurning(); },
  isJet: function () { return state.section !== undefined && state.section.isJet(); },
  isMultiChannelProgram: function () { return false; },
  isInteractionAllowed: function () { return false; },
  isSpindleActive: function () { return state.spindle === true; },
  isCoolantActive: function () { return false; },
  isClockwiseSpindleDirection: function () { return state.section === undefined || state.section.dotekTool.clockwise; },
  isSpeedFeedSynchronizationActive: function () { return state.synchronized; },
  isExpanding: function () { return state.expanding; },
  isSubSpindleCycle: function () { return false; },
  isWellKnownCycle: function () { return true; },
  isSectionSpecialCycle: function (type) { return (state.special || {})[type] === true; },
  setSectionSpecialCycle: function (type, on) {
    state.special = state.special || {};
    state.special[type] = on;
  },
  isProbingCycle: function (type) {
    return /^probing/.test(type === undefined ? global.cycleType : type);
  },
  isProbeOperation: function (section) {
    var of = section === undefined ? state.section : section;
    return of !== undefined && /^probe/.test(of.getParameter("operation-strategy", of.strategy));
  },
  isInspectionOperation: function (section) {
    var of = section === undefined ? state.section : section;
    return of !== undefined && of.getParameter("operation-strategy", of.strategy) === "inspectSurface";
  },
  isDrillingCycle: function (section, strict) {
    var type = typeof section === "object" ? section.getFirstCycle() : global.cycleType;
    return isDrilling(type) && strict !== null;
  },
  isTappingCycle: function () { return /tapping/.test(global.cycleType); },
  isFirstCyclePoint: function () { return state.cyclePoint === 0; },
  isLastCyclePoint: function () { return state.cyclePoint === state.cyclePoints.length - 1; },
  getCyclePointId: function () { return state.cyclePoint; },
  getNumberOfCyclePoints: function () { return state.cyclePoints.length; },
  getCyclePoint: function (i) { return state.cyclePoints[i]; },
  expandCyclePoint: expandCyclePoint,
  repositionToCycleClearance: function (cycle, x, y) {
    var z = numberOf(cycle.clearance, "cycle.clearance");
    var from = state.position || new Vector(x, y, z);
    if (from.z < z) {
      callEntry("onRapid", [from.x, from.y, z]);
      moveTo(new Vector(from.x, from.y, z));
    }
    callEntry("onRapid", [x, y, z]);
    moveTo(new Vector(x, y, z));
  },
  expandManualNC: function (command, value) {
    // onParameter gets what has a text and is no block: the reference names these parameters.
    var told = [[values.COMMAND_ACTION, "action"], [values.COMMAND_PRINT_MESSAGE, "print"],
      [values.COMMAND_DISPLAY_MESSAGE, "display"]].filter(function (one) { return one[0] === command; });
    if (told.length > 0) {
      parameter(told[0][1], value);
    } else if (command === values.COMMAND_COMMENT) {
      callEntry("onComment", [value]);
    } else if (command === values.COMMAND_PASS_THROUGH) {
      handOn("onPassThrough", [value]);
    } else {
      handOn("onCommand", [command]);
    }
  },
  skipRemainingSection: function () { state.skip = true; },
  invokeOnRapid: invoke("onRapid", true),
  invokeOnRapid5D: invoke("onRapid5D", true), invokeOnLinear5D: invoke("onLinear5D", true),
  getCircularPlane: circularPlane, getCircularSweep: circularSweep, getCircularRadius: circularRadius,
  getCircularStartRadius: circularRadius, getHelicalDistance: helicalDistance,
  getCircularCenter: function () { return motion().center; },
  getCircularNormal: function () { return motion().normal; },
  getCircularChordLength: function () { return Vector.diff(motion().end, motion().start).length; },
  getHelicalOffset: function () { return Vector.product(motion().normal, helicalDistance()); },
  getHelicalPitch: function () { return helicalDistance() * 2 * Math.PI / circularSweep(); },
  isHelical: function () { return Math.abs(helicalDistance()) > 1e-6; },
  isFullCircle: function () { return motion().full; },
  isSpiral: function () { return false; },
  isClockwise: function () { return motion().clockwise; },
  linearize: linearize,
  canLinearize: function () { return true; },
  getLength: function () { return state.motion ? circularRadius() * circularSweep() : 0; },
  getFeedrate: function () { return state.feed || 0; },
  getMovement: function () { return global.movement; },
  getSpindleSpeed: function () { return global.spindleSpeed; },
  getRadiusCompensation: function () { return global.radiusCompensation; },
  getPower: function () { return state.power === true; },
  getCompensationOffset: function () { return state.section === undefined ? 0 : state.section.dotekTool.diameterOffset; },
  getPlane: circularPlane,
  getISOPlane: function (plane) {
    return [[values.PLANE_XY, 17], [values.PLANE_ZX, 18], [values.PLANE_YZ, 19]].reduce(function (found, one) {
      return one[0] === plane ? one[1] : found;
    }, 17);
  },
  getNextRecord: function () { return recordOf(state.record + 1); },
  getPreviousRecord: function () { return recordOf(state.record - 1); },
  hasNextRecord: function () { return state.section !== undefined && state.record + 1 < state.section.dotekRecords.length; },
  hasPreviousRecord: function () { return state.record > 0; },
  getCurrentRecordId: function () { return state.record === undefined ? -1 : state.record; },
  getNumberOfRecords: function () { return state.section === undefined ? 0 : state.section.dotekRecords.length; },
  getRecord: recordOf,
  isPolarModeActive: function () { return false; },
  activateAutoPolarMode: function () {},
  activatePolarMode: function () { throw sourceError("polar mode is not carried out by Dotek's kernel"); },
  deactivatePolarMode: function () {},
  getPolarPosition: function (x, y, z) {
    return {first: new Vector(x, y, z), second: new Vector(), oldPosition: state.position || new Vector()};
  },
  getAxisLimit: function () { return undefined; },
  getOutputUnit: function () { return global.unit; },
  setOutputUnit: function (unit) { global.unit = unit; },
  getSystemUnit: function () { return values.MM; },
  getWorkpiece: function () {
    var of = state.job.workpiece || [[0, 0, 0], [0, 0, 0]];
    return new BoundingBox(vectorOf(of[0], true), vectorOf(of[1], true));
  },
  getFixture: function () { return new BoundingBox(); },
  isWorkpieceDefined: function () { return state.job.workpiece !== undefined; },
  getHeaderVersion: function () { return ""; }, getHeaderDate: function () { return ""; },
  getHeaderDate2: function () { return ""; }, getHeaderCommit: function () { return ""; },
  getHeader: function () { return ""; }, getHeaderSnippet: function () { return ""; },
  getVendor: function () { return global.vendor || ""; }, getVendorUrl: function () { return global.vendorUrl || ""; },
  getVersion: function () { return "Dotek"; }, getProduct: function () { return "Dotek"; },
  getProductUri: function () { return "dotek"; }, getProductUrl: function () { return ""; },
  getPlatform: function () { return "LINUX"; }, getLangId: function () { return "en"; },
  getSecurityLevel: function () { return 0; }, getNumberOfChannels: function () { return 1; },
  getOutputPath: function () { return "program." + (global.extension || "nc"); },
  getIntermediatePath: function () { return "job.cnc"; }, getCascadingPath: function () { return ""; },
  getConfigurationFolder: function () { return ""; }, getConfigurationPath: function () { return "post.cps"; },
  getPostProcessorFolder: function () { return ""; }, getPostProcessorPath: function () { return "post.cps"; },
  getSimulationStreamPath: function () { return ""; }, findFile: function () { return ""; },
  getHighFeedrate: function () { return global.highFeedrate; },
  setHighFeedrate: function (feed) { global.highFeedrate = feed; },
  getHighFeedMapping: function () { return global.highFeedMapping; },
  setHighFeedMapping: function (mapping) { global.highFeedMapping = mapping; },
  setDogLeg: function () {}, getDogLeg: function () { return false; },
  getQuadrant: function (angle) { return ((Math.floor(angle / (Math.PI / 2)) % 4) + 4) % 4; },
  // Of the system a run knows nothing.
  hasRegistryValue: function () { return false; }, getRegistryString: function () { return ""; },
  getEnvironmentVariable: function () { return ""; },
  hasSymbol: function (name) { return name in global; },
  loadLocale: function () { return true; },
  interval: function (a, b) { return new Range(a, b); }, range: function (a, b) { return new Range(a, b); },
  registerPostProcessing: function () {},
  createToolRenderer: function () { return undefined; },
  include: function (name) {
    var text = (state.includes || {})[String(name)];
    if (text === undefined) {
      throw sourceError("include: `" + name + "` was not read; a post includes files by a text in quotes");
    }
    // A file may include one that includes it, once; only its depth tells that there is no end.
    var open = state.including = state.including || [];
    if (open.length >= 24) {
      throw sourceError("include: `" + name + "` is nested " + (open.length + 1) + " deep: .., " +
                        open.slice(-4).join(", ") + "; a file that includes itself has no end");
    }
    open.push(String(name));
    try {
      (0, eval)(text);
    } finally {
      open.pop();
    }
  }
});

// Codes by number, written once until they change.
function Table(list, specifiers, text) {
  this.list = list;
  this.given = specifiers || {};
  this.current = this.given.initial;
  this.text = text;
}
Table.prototype.lookup = function (i) {
  if (this.list[i] === undefined) {
    error(this.text === undefined ? "the table has no entry " + i : this.text);
  }
  if (this.current === i && !this.given.force) {
    return undefined;
  }
  this.current = i;
  return this.list[i];
};
Table.prototype.reset = function () { this.current = undefined; };

function Color(red, green, blue) {
  this.red = red;
  this.green = green;
  this.blue = blue;
}

// Files of the system: a run has none.
var FileSystem = {
  isFile: function () { return false; }, isFolder: function () { return false; },
  getFolderPath: function (path) { return String(path).replace(/[\\/][^\\/]*$/, ""); },
  getFilename: function (path) { return String(path).replace(/^.*[\\/]/, ""); },
  replaceExtension: function (path, extension) { return String(path).replace(/\.[^.\\/]*$/, "") + "." + extension; },
  getCombinedPath: function (a, b) { return a === "" ? b : a + "/" + b; },
  getTemporaryFolder: function () { return ""; }, getTemporaryFile: function () { return ""; }
};
["makeFolder", "remove", "copyFile", "moveFile"].forEach(function (name) {
  FileSystem[name] = function () { unproven("the post calls FileSystem." + name + ": a run touches no file"); };
});
give({FileSystem: FileSystem, Table: Table, Color: Color});

function recordOf(i) {
  var types = {rapid: "RECORD_LINEAR", linear: "RECORD_LINEAR", circular: "RECORD_CIRCULAR", cycle: "RECORD_CYCLE",
    dwell: "RECORD_DWELL", comment: "RECORD_COMMENT", parameter: "RECORD_PARAMETER",
    command: "RECORD_WELL_KNOWN_COMMAND", linear5: "RECORD_LINEAR_5D", rapid5: "RECORD_LINEAR_5D"};
  var of = state.section === undefined ? undefined : state.section.dotekRecords[i];
  var type = of === undefined ? values.RECORD_INVALID : values[types[of.record] || "RECORD_INVALID"];
  return {
    getType: function () { return type; },
    isMotion: function () { return of !== undefined && of.to !== undefined; },
    isValid: function () { return of !== undefined; },
    getCategory: function () { return type; },
    getId: function () { return i; }
  };
}
