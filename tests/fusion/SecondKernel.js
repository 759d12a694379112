// A second kernel, written from the reference alone (formats 1.2, variables 1.3, text 1.4, properties 1.5, values of the
// golden blocks 2.5): node SecondKernel.js POST prints the table of `dotek run-post POST --matrix probing`. The rest of the
// engine is SecondEngine.js.
"use strict";
const fs = require("fs");
const path = require("path");
const vm = require("vm");
const {engine, lackingNames} = require("./SecondEngine.js");

const TYPES = `x y z x-wall y-wall x-channel y-channel x-channel-with-island y-channel-with-island xy-circular-boss
  xy-circular-hole xy-circular-hole-with-island xy-circular-partial-boss xy-circular-partial-hole
  xy-circular-partial-hole-with-island xy-rectangular-hole xy-rectangular-boss xy-rectangular-hole-with-island
  xy-inner-corner xy-outer-corner x-plane-angle y-plane-angle xy-pcd-hole xy-pcd-boss`.split(/\s+/).map((one) => "probing-" + one);
const VALUES = {clearance: 20, retract: 8, stock: 0, depth: 5, bottom: -5, feedrate: 1000, probeClearance: 4,
  probeOvertravel: 10, width1: 40, width2: 30, approach1: "positive", approach2: "negative", partialCircleAngleA: 10,
  partialCircleAngleB: 130, partialCircleAngleC: 250, pcdStartingAngle: 15, numberOfSubfeatures: 4, widthPCD: 60,
  widthFeature: 8, probeSpacing: 0, probeOrientation: 0};

class Refused extends Error {}

// Digits by decimal text, half away from zero.
function roundedText(value, decimals) {
  let [whole, fraction = ""] = Math.abs(value).toFixed(Math.min(20, decimals + 9)).split(".");
  fraction = fraction.padEnd(decimals + 1, "0");
  let digits = BigInt(whole + fraction.slice(0, decimals));
  if (fraction[decimals] >= "5") { digits += 1n; }
  const text = digits.toString().padStart(decimals + 1, "0");
  const cut = text.length - decimals;
  return {whole: text.slice(0, cut), fraction: text.slice(cut), negative: value < 0 && digits !== 0n};
}

class NumberFormat {
  constructor(given = {}) {
    Object.assign(this, {decimals: 6, trim: true, scale: 1, offset: 0, prefix: "", suffix: "", separator: ".", width: 0,
      minDigitsLeft: 0, minDigitsRight: 0}, given.inherit, given);
  }
  parts(value) {
    return roundedText(value * this.scale + this.offset, this.type === "integer" ? 0 : this.decimals);
  }
  format(value) {
    if (!Number.isFinite(value)) { throw new Error("no number"); }
    const {whole, fraction, negative} = this.parts(value);
    let right = this.trim || this.type ? fraction.replace(/0+$/, "") : fraction;
    right = right.padEnd(this.minDigitsRight, "0");
    const left = whole.padStart(Math.max(this.minDigitsLeft, this.zeropad ? this.width : 0), "0");
    const point = right || this.forceDecimal || this.type === "real" ? this.separator : "";
    return this.prefix + (negative ? "-" : this.forceSign ? "+" : "") + (this.trimLeadZero && right && left === "0" ? "" : left) +
      point + right + this.suffix;
  }
  getResultingValue(value) {
    const {whole, fraction, negative} = this.parts(value);
    return Number((negative ? "-" : "") + whole + "." + (fraction || "0"));
  }
  isSignificant(value) { return this.getResultingValue(value) !== 0; }
  areDifferent(a, b) {
    return a === undefined || b === undefined ? a !== b : this.getResultingValue(a) !== this.getResultingValue(b);
  }
  getMinimumValue() { return Number("1e-" + this.decimals); }
}
for (const name of ["decimals", "trim", "trimLeadZero", "forceDecimal", "forceSign", "width", "separator", "scale", "offset", "prefix",
  "suffix", "type", "minDigitsLeft", "minDigitsRight"]) {
  const title = name[0].toUpperCase() + name.slice(1);
  NumberFormat.prototype["set" + title] = function (value) { this[name] = value; };
  NumberFormat.prototype["get" + title] = function () { return this[name]; };
}
NumberFormat.prototype.setNumberOfDecimals = NumberFormat.prototype.setDecimals;
NumberFormat.prototype.getNumberOfDecimals = NumberFormat.prototype.getDecimals;
NumberFormat.prototype.setZeroPad = function (value) { this.zeropad = value; };

class Word {
  constructor(kind, given = {}, format) {
    Object.assign(this, {kind, given, by: format, on: true, last: given.current});
    this.control = given.force ? "force" : given.control || "changed";
  }
  text(value) {
    let text = this.by.format(value);
    const {prefix, suffix = ""} = this.given;
    if (prefix !== undefined && (this.kind === "modal" || this.kind === "output")) { text = text.slice(this.by.prefix.length); }
    return (prefix || "") + text + suffix;
  }
  format(value, reference = 0) {
    const before = this.last;
    this.last = value;
    let quiet = before !== undefined && !this.by.areDifferent(value, before);
    let shown = value;
    if (this.kind === "reference") { quiet = !this.by.areDifferent(value, reference); }
    if (this.control === "nonzero") { quiet = !this.by.isSignificant(value); }
    if (this.kind === "incremental" || this.given.type === "incremental") {
      shown = value - (before === undefined ? 0 : before);
      quiet = !this.by.isSignificant(shown);
    }
    if (!this.on || (quiet && this.control !== "force")) { return ""; }
    if (this.given.onchange) { this.given.onchange(); }
    return this.text(shown);
  }
  reset() { if (this.kind !== "incremental") { this.last = undefined; } }
  enable() { this.on = true; }
  disable() { this.on = false; }
  isEnabled() { return this.on; }
  getCurrent() { return this.last; }
  setCurrent(value) { this.last = value; }
  setPrefix(prefix) { this.given = {...this.given, prefix}; }
  getPrefix() { return this.given.prefix; }
  setSuffix(suffix) { this.given = {...this.given, suffix}; }
  setFormat(format) { this.by = format; }
  getFormat() { return this.by; }
  setControl(control) { this.control = control; }
  setForce(force) { this.control = force ? "force" : "changed"; }
  setType(type) { this.given = {...this.given, type}; }
  areDifferent(a, b) { return this.by.areDifferent(a, b); }
  isSignificant(value) { return this.by.isSignificant(value); }
  getResultingValue(value) { return this.by.getResultingValue(value); }
}

const words = (list) => Array.from(list).flatMap((one) => one === undefined || one === null || one === "" ? []
  : typeof one === "object" && "length" in one ? words(one) : [String(one)]);

function runOne(text, type) {
  const lines = [];
  const kept = new Map(); // lines that were written to a buffer within a cycle, and how often
  let pending = "";
  let buffer;
  let open = {text: "", cycle: false}; // the last line of the buffer
  let separator = " ";
  const write = (piece) => {
    const cycle = new Error().stack.split("\n").some((line) => /at (?:\w+\.)?onCyclePoint \(post:/.test(line));
    if (buffer !== undefined) {
      buffer += piece;
      String(piece).split("\n").forEach((one, i) => {
        if (i > 0) {
          if (open.cycle) { kept.set(open.text, (kept.get(open.text) || 0) + 1); }
          open = {text: "", cycle: false};
        }
        open.text += one;
        open.cycle = open.cycle || (cycle && one !== "");
      });
      return;
    }
    pending += piece;
    for (let end; (end = pending.indexOf("\n")) >= 0; pending = pending.slice(end + 1)) {
      const one = pending.slice(0, end);
      const times = cycle ? 0 : kept.get(one) || 0;
      if (times > 0) { kept.set(one, times - 1); }
      lines.push({text: one, cycle: cycle || times > 0});
    }
  };
  const line = (one) => write(one + "\n");
  const cycle = {...VALUES};
  if (/angle/.test(type)) { Object.assign(cycle, {probeSpacing: 20, nominalAngle: type === "probing-x-plane-angle" ? 90 : 0}); }
  const tool = {number: 7, diameter: 6, description: "probe", spindleRPM: 50, lengthOffset: 7, diameterOffset: 7};
  const parameters = {"operation-strategy": "probe", "operation-comment": type, "operation:tool_feedCutting": cycle.feedrate,
    "operation:tool_feedProbeLink": cycle.feedrate, "operation:tool_feedProbeMeasure": cycle.feedrate,
    "operation:tool_feedEntry": cycle.feedrate};
  let position = {x: 100, y: 50, z: 20};
  const section = {workOffset: 1, probeWorkOffset: 1, strategy: "probe", getTool: () => tool, getId: () => 0,
    getParameter: (name, other) => name in parameters ? parameters[name] : other, hasParameter: (name) => name in parameters,
    getInitialPosition: () => position, isMultiAxis: () => false};
  const valueOf = (of) => of !== null && typeof of === "object" ? of.value : of;
  const world = {unit: "mm", MM: "mm", IN: "in", DEG: 180 / Math.PI, EOL: "\n", SP: " ", cycle, tool, currentSection: section,
    cycleType: type, properties: {}, programName: "1001", programComment: "",
    CAPABILITY_MILLING: 1, CAPABILITY_INSPECTION: 2, COMMAND_STOP: "stop", toPreciseUnit: (one) => one,
    FORMAT_REAL: "real", FORMAT_INTEGER: "integer", CONTROL_FORCE: "force", CONTROL_NONZERO: "nonzero", CONTROL_CHANGED: "changed",
    TYPE_INCREMENTAL: "incremental", TYPE_ABSOLUTE: "absolute",
    createFormat: (given) => new NumberFormat(given),
    createVariable: (given, format) => new Word("variable", given, format),
    createModal: (given, format) => new Word("modal", given, format),
    createOutputVariable: (given, format) => new Word("output", given, format),
    createReferenceVariable: (given, format) => new Word("reference", given, format),
    createIncrementalVariable: (given, format) => new Word("incremental", given, format),
    write, writeln: line, setWordSeparator: (one) => { separator = one; },
    formatWords: (...list) => words(list).join(separator),
    writeWords: (...list) => { const out = words(list); if (out.length) { line(out.join(separator)); } },
    writeWords2: (first, ...list) => { const out = words(list); if (out.length) { line(words([first]).concat(out).join(separator)); } },
    conditional: (test, one) => test ? one : "", localize: (one) => one,
    subst: (one, ...list) => one.replace(/%(\d+)/g, (all, i) => list[i - 1]),
    error: (one) => { throw new Refused(one); },
    validate: (test, one) => { if (!test) { throw new Refused(one); } },
    cycleNotSupported: () => { throw new Refused("the cycle is not supported: " + type); },
    toRad: (one) => one * Math.PI / 180, toDeg: (one) => one * 180 / Math.PI,
    getProperty: (name, other) => {
      const value = valueOf(typeof name === "object" ? name : context.properties[name]);
      return value === undefined ? other : value;
    },
    redirectToBuffer: () => { buffer = ""; }, redirectToFile: () => { buffer = ""; }, closeRedirection: () => { buffer = undefined; },
    getRedirectionBuffer: () => buffer, isRedirecting: () => buffer !== undefined, include: (name) => {
      vm.runInContext(fs.readFileSync(path.join(path.dirname(process.argv[2]), name), "utf8"), context, {filename: "included"});
    },
    hasParameter: section.hasParameter, getParameter: section.getParameter,
    getFramePosition: (one) => one, getCurrentPosition: () => position, invokeOnRapid: (...to) => call("onRapid", ...to),
    invokeOnLinear: (...to) => call("onLinear", ...to)};
  Object.assign(world, engine(world, section, tool, (problem) => { throw new Refused(problem); }));
  lackingNames(text, world);
  const context = vm.createContext(world);
  vm.runInContext(text, context, {filename: "post"});
  const call = (name, ...list) => { if (typeof context[name] === "function") { context[name](...list); } };
  const moved = (x, y, z) => { position = {x, y, z}; };
  call("onOpen");
  for (const name of Object.keys(parameters)) { call("onParameter", name, parameters[name]); }
  call("onSection");
  call("onRapid", 100, 50, 20);
  moved(100, 50, 20);
  call("onCycle");
  if (typeof context.onCyclePoint !== "function") { context.expandCyclePoint(); }
  call("onCyclePoint", 100, 50, 0);
  moved(100, 50, cycle.retract);
  call("onCycleEnd");
  call("onSectionEnd");
  call("onClose");
  return lines.filter((one) => one.cycle).map((one) => one.text);
}

const post = fs.readFileSync(process.argv[2], "utf8");
const width = Math.max(...TYPES.map((one) => one.length));
let printed = 0;
let refused = 0;
let fail = 0;
let out = "";
for (const type of TYPES) {
  out += type.padEnd(width) + "  ";
  try {
    const blocks = runOne(post, type);
    ++printed;
    out += `${blocks.length} block${blocks.length === 1 ? "" : "s"}\n` + blocks.map((one) => "    " + one + "\n").join("");
  } catch (problem) {
    const line = /\bpost:(\d+)/.exec(problem.stack);
    if (problem instanceof Refused) { ++refused; } else { ++fail; }
    out += `${problem instanceof Refused ? "refused" : "fails"}: ${problem.message}` + (line ? ` (line ${line[1]})\n` : "\n");
  }
}
process.stdout.write(out + `${printed} of 24 cycles are printed, ${refused} refused, ${fail} fail\n`);
