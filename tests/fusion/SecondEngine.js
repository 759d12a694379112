// What whole posts ask of the engine beside formats, words and text, for SecondKernel.js: one operation on a machine of
// three axes. What is not known answers as an object that has nothing: no axis, no pattern, no further section.
"use strict";

class Vector {
  constructor(x = 0, y = 0, z = 0) { Object.assign(this, {x, y, z}); }
  get length() { return Math.hypot(this.x, this.y, this.z); }
  get abs() { return new Vector(Math.abs(this.x), Math.abs(this.y), Math.abs(this.z)); }
  get negated() { return this.getNegated(); }
  get normalized() { return this.getNormalized(); }
  getX() { return this.x; }
  getY() { return this.y; }
  getZ() { return this.z; }
  getCoordinate(i) { return [this.x, this.y, this.z][i]; }
  setCoordinate(i, value) { this["xyz"[i]] = value; }
  isZero() { return this.length === 0; }
  isNonZero() { return this.length !== 0; }
  getNegated() { return Vector.product(this, -1); }
  getNormalized() { return this.isZero() ? this : Vector.product(this, 1 / this.length); }
  negate() { Object.assign(this, this.getNegated()); }
  normalize() { Object.assign(this, this.getNormalized()); }
  static sum(a, b) { return new Vector(a.x + b.x, a.y + b.y, a.z + b.z); }
  static diff(a, b) { return new Vector(a.x - b.x, a.y - b.y, a.z - b.z); }
  static product(a, by) { return new Vector(a.x * by, a.y * by, a.z * by); }
  static dot(a, b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  static cross(a, b) { return new Vector(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }
  static lerp(a, b, t) { return Vector.sum(a, Vector.product(Vector.diff(b, a), t)); }
}

// Nothing is tilted here.
class Matrix {
  constructor() { Object.assign(this, {right: new Vector(1), up: new Vector(0, 1), forward: new Vector(0, 0, 1)}); }
  getRight() { return this.right; }
  getUp() { return this.up; }
  getForward() { return this.forward; }
  isIdentity() { return true; }
  isZero() { return false; }
  multiply(by) { return by; }
  getTransposed() { return this; }
  getElement(row, column) { return Math.trunc(row) === Math.trunc(column) ? 1 : 0; }
  getColumn(i) { return [this.right, this.up, this.forward][i]; }
  getRow(i) { return this.getColumn(i); }
  getEuler2() { return new Vector(); }
  getTurnAndTilt() { return new Vector(); }
  normalize() {}
}
for (const name of ["getXRotation", "getYRotation", "getZRotation", "getAxisRotation", "getXYZRotation"]) {
  Matrix[name] = () => new Matrix();
}

class Range {
  constructor(minimum = 0, maximum = 0) { Object.assign(this, {minimum, maximum, 0: minimum, 1: maximum}); }
  getMinimum() { return this.minimum; }
  getMaximum() { return this.maximum; }
  expandTo(value) { this.expandToRange(new Range(value, value)); }
  expandToRange(other) {
    this.minimum = Math.min(this.minimum, other.minimum);
    this.maximum = Math.max(this.maximum, other.maximum);
  }
  isWithin(value) { return value >= this.minimum && value <= this.maximum; }
}

class Group {
  constructor(given, lists, format) { Object.assign(this, {given: given || {}, lists: lists || [], by: format, active: new Map(), on: true}); }
  groupOf(code) { return this.lists.findIndex((list) => list.includes(code)); }
  format(code) {
    const group = this.groupOf(code);
    if (!this.on || (group >= 0 && this.active.get(group) === code && !this.given.force)) { return ""; }
    if (group >= 0) { this.active.set(group, code); }
    return this.by.format(code);
  }
  reset() { this.active.clear(); }
  resetGroup(code) { this.active.delete(this.groupOf(code)); }
  isActiveCode(code) { return [...this.active.values()].includes(code); }
  getActiveCode(group) { return this.active.get(group); }
  makeActiveCode(code) { this.active.set(this.groupOf(code), code); }
  createGroup() { return this.lists.push([]) - 1; }
  addCode(group, code) { this.lists[group].push(code); }
  setForce(force) { this.given.force = force; }
  enable() { this.on = true; }
  disable() { this.on = false; }
}

// Members that are not known: questions are answered with no, the rest with nothing.
function loose(known) {
  return new Proxy(known, {get: (of, name) => name in of || typeof name === "symbol" ? of[name]
    : /^(is|has|use|can)[A-Z]/.test(name) ? () => false
    : /^(get|set|add|to|check|remove|optimize|enable|disable|reset|activate|deactivate)[A-Z0-9]/.test(name) ? () => undefined : undefined});
}

const none = (...names) => Object.fromEntries(names.map((name) => [name, () => undefined]));
const all = (value, ...names) => Object.fromEntries(names.map((name) => [name, value]));

function machine() {
  const axis = loose({getCoordinate: () => 0, getRange: () => new Range()});
  return loose({...all(() => axis, "getAxisU", "getAxisV", "getAxisW", "getAxisX", "getAxisY", "getAxisZ"), getNumberOfAxes: () => 3,
    ...all(() => new Vector(), "getABC", "getABCByPreference", "getABCByDirection", "remapABC", "remapToABC", "getPreferredABC"),
    ...all(() => new Matrix(), "getOrientation", "getRemainingOrientation"),
    ...all(() => new Vector(0, 0, 1), "getDirection", "getSpindleAxis"), getHeadABC: () => new Vector(),
    ...all(() => "", "getVendor", "getModel", "getDescription", "getControl"), isABCSupported: () => true, getMilling: () => true,
    ...all(() => 0, "getMaximumSpindleSpeed", "getRetractPlane", "getHomePositionX", "getHomePositionY", "getMultiAxisFeedrateMode", "getToolChangerSlots")});
}

// The members of the one section, whose cycle is `world.cycleType`.
function sectionMembers(world, last) {
  const first = () => new Vector(100, 50, 20);
  const up = () => new Vector(0, 0, 1);
  return {workPlane: new Matrix(), wcsPlane: new Matrix(), workOrigin: new Vector(), wcsOrigin: new Vector(), wcs: "G54", wcsIndex: 1,
    type: world.TYPE_MILLING, getType: () => world.TYPE_MILLING, unit: world.unit, getUnit: () => world.unit, jobId: 0, channel: 0,
    spindle: "SPINDLE_PRIMARY", feedMode: "FEED_PER_MINUTE", dynamicWorkOffset: 0, polarMode: "POLAR_MODE_OFF", properties: {},
    getInitialPosition: first, getFirstPosition: first, getFinalPosition: () => last, hasWellDefinedPosition: () => true,
    getGlobalZRange: () => new Range(20, 20), getGlobalRange: () => new Range(20, 20),
    ...all(() => new Range(), "getGlobalXRange", "getGlobalYRange"), getBoundingBox: () => ({lower: new Vector(), upper: new Vector()}),
    ...all(up, "getGlobalInitialToolAxis", "getGlobalFinalToolAxis", "getInitialToolAxis", "getFinalToolAxis"),
    ...all(() => new Vector(), "getABC", "getInitialToolAxisABC", "getFinalToolAxisABC", "getModelOrigin"), getModelPlane: () => new Matrix(),
    ...all(() => 50, "getMaximumSpindleSpeed", "getInitialSpindleSpeed"), getMaximumFeedrate: () => 0, getTool: () => world.tool,
    ...all(() => 0, "getMovements", "getCycleTime", "getCuttingDistance", "getRapidDistance", "getPatternId", "getInternalPatternId",
      "getChannel", "getDynamicWorkOffset", "getOptimizedTCPMode"), getNumberOfCyclePoints: () => 1, getNumberOfCycles: () => 1,
    getFirstCycle: () => world.cycleType, hasAnyCycle: () => true, hasCycle: (type) => type === world.cycleType,
    doesStrictCycle: (type) => type === world.cycleType, isMilling: () => true, isZOriented: () => true, is3D: () => true,
    getProperty: (name, other) => world.getProperty(name, other)};
}

// What a post finds of the engine. `refuse` is called with a text where a post leaves moves to it.
function engine(world, section, tool, refuse) {
  const origin = new Vector();
  Object.assign(world, {X: 0, Y: 1, Z: 2, ABC: 3, PLANE_XY: 0, PLANE_ZX: 1, PLANE_YZ: 2, TYPE_MILLING: "TYPE_MILLING", TAB: "\t",
    TOOL_PROBE: "TOOL_PROBE", COOLANT_OFF: "COOLANT_OFF", COOLANT_DISABLED: "COOLANT_OFF"});
  world.currentSection = loose(Object.assign(section, sectionMembers(world, new Vector(100, 50, 8))));
  Object.assign(tool, {type: world.TOOL_PROBE, coolant: world.COOLANT_OFF, clockwise: true, ...all("", "comment", "vendor", "productId", "toolId"),
    ...all(0, "taperAngle", "cornerRadius", "turret", "spindleMode", "maximumSpindleSpeed", "tipDiameter"), bodyLength: 50, fluteLength: 20,
    shaftDiameter: 6, holderLength: 30, numberOfFlutes: 2, compensationOffset: 7, breakControl: false, manualToolChange: false,
    jetTool: false, isLiveTool: () => true, getType: () => world.TOOL_PROBE, getToolId: () => ""});
  world.tool = loose(tool);
  const isCycle = (one) => (typeof one === "string" ? one : world.cycleType).startsWith("probing");
  return {Vector, Matrix, Range, Axis: class {}, BoundingBox: class { constructor(lower, upper) { Object.assign(this, {lower, upper}); } },
    Table: class { constructor(values) { this.values = values; } lookup(i) { return this.values[i]; } reset() {} },
    Template: class { constructor(text) { this.text = String(text); }
      substitute(table) { return this.text.replace(/\$\{([^}]*)\}/g, (found, name) => name in table ? table[name] : found); } },
    StringBuffer: class { constructor() { this.text = ""; } append(piece) { this.text += piece; } toString() { return this.text; } },
    MachineConfiguration: function () { return machine(); }, machineConfiguration: machine(), getMachineConfiguration: machine,
    createAxis: () => loose({}), createModalGroup: (...given) => new Group(...given), isWellKnownCycle: () => true,
    radiusCompensation: "RADIUS_COMPENSATION_OFF", spindleSpeed: 50, movement: 0, power: false, feedrate: 0, spindleAxis: 2,
    ...all("", "modelImagePath", "programComment", "description",
      "longDescription", "vendor", "vendorUrl", "legal"), highFeedMapping: "HIGH_FEED_NO_MAPPING", highFeedrate: 0, cycleExpanded: false, simulation: loose({}), revision: 50000,
    machineParameters: {}, FileSystem: loose({isFile: () => false, ...all(() => "", "getFolderPath", "getCombinedPath", "getFilename")}),
    spatial: (value, of) => of === world.IN ? value * 25 : value, toUnit: (value, of) => of === world.IN ? value * 25 : value,
    clamp: (low, value, high) => Math.max(low, Math.min(value, high)), isSameDirection: (a, b) => Vector.diff(a, b).length < 1e-6,
    getCodePage: () => "ascii", getAsInt: (text) => parseInt(text, 10), getAsFloat: parseFloat, getSystemUnit: () => world.unit,
    getOutputUnit: () => world.unit, getVersion: () => 50000, getGlobalParameter: (name, other) => other,
    ...all((text) => text, "filterText", "translateText"), ...all(() => true, "isFirstSection", "isLastSection", "isFirstCyclePoint",
      "isLastCyclePoint", "isMilling", "is3D", "isNewWorkPlane", "isNewWorkOffset", "isToolChangeNeeded", "isSafeText", "isTextSupported"),
    ...all(() => false, "isTurning", "isJet", "isMultiAxis", "hasNextSection", "isDrillingCycle", "isTappingCycle", "isSubSpindleCycle",
      "hasGlobalParameter", "isInteractionAllowed", "isPolarModeActive", "isWorkpieceDefined", "isSpeedFeedSynchronizationActive"),
    ...all(() => "", "getOutputPath", "getProgramName", "getProduct", "getHeaderVersion", "getSimulationStreamPath", "getCoolantName",
      "getMaterialName", "getCommandStringId", "loadText", "getIntermediatePath", "getPlatform", "getConfigurationFolder", "getConfigurationPath", "findFile"),
    ...all(() => 0, "getCurrentSectionId", "getCyclePointId", "getCompensationOffset", "getPolarMode", "getFeedrate", "getCircularPlane"),
    ...all(() => 1, "getNumberOfSections", "getNumberOfCyclePoints", "getNumberOfRecords"), getSection: () => world.currentSection,
    getToolTable: () => ({getNumberOfTools: () => 1, getTool: () => world.tool}), getFirstTool: () => world.tool,
    ...all(() => ({lower: origin, upper: origin}), "getWorkpiece", "getFixture"), getLangId: () => "us", getHeaderDate: () => new Date(0),
    ...all(() => new Matrix(), "getRotation"), ...all(() => new Vector(), "getTranslation", "getCurrentABC"),
    ...all(() => new Vector(0, 0, 1), "getCurrentDirection"), ...all((one) => one, "getWCSPosition", "getGlobalPosition"), isInspectionOperation: () => false,
    getToolTypeName: () => "probe", getRadiusCompensation: () => "RADIUS_COMPENSATION_OFF",
    isProbeOperation: () => true, expandManualNC() {}, setProperty: (name, value) => {
      const key = typeof name === "string" ? world.properties[name] : name;
      if (key !== null && typeof key === "object") { key.value = value; } else { world.properties[name] = value; }
    },
    expandCyclePoint: () => refuse(`the post leaves \`${world.cycleType}\` to the engine, whose moves no source states`),
    isProbingCycle: isCycle, ...none("setCodePage", "setEOL", "setRotation", "setTranslation", "cancelTransformation", "setCurrentDirection",
      "setCurrentABC", "setCurrentPosition", "setMachineConfiguration", "optimizeMachineAngles", "optimizeMachineAngles2",
      "optimizeMachineAnglesByMachine", "warning", "warningOnce", "log", "debug", "alert", "setWriteStack", "setWriteInvocations",
      "registerPostProcessing", "registerTerminationHandler", "getPreviousSection", "getNextSection", "getNextTool", "getNextRecord",
      "activateAutoPolarMode", "setDogLeg", "getDogLeg", "loadLocale", "setExitCode", "setSectionSpecialCycle", "unwindABC", "createToolRenderer", "exportToolRenderer",
      "repositionToCycleClearance", "setCurrentPositionX", "setCurrentPositionY", "setCurrentPositionZ", "setPolarFeedMode", "executeCommand")};
}

// Constants by their names, and entries that the post calls and does not define.
function lackingNames(text, world) {
  for (const [name] of text.matchAll(/\b[A-Z][A-Z0-9]*_[A-Z0-9_]+\b/g)) {
    if (!(name in world)) { world[name] = name; }
  }
  for (const [, name] of text.matchAll(/\b(on[A-Z]\w*)\s*\(/g)) {
    if (!(name in world) && !new RegExp(`\\btypeof\\s*\\(?\\s*${name}\\b`).test(text)) { world[name] = () => undefined; }
  }
}

module.exports = {engine, lackingNames, Group};
