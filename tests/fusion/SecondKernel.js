// A second kernel, written from the reference alone (formats 1.2, variables 1.3, text 1.4, properties 1.5, values of the
// golden blocks 2.5): node SecondKernel.js POST prints the table of `dotek run-post POST --matrix probing`. What it does
// not know is a stub.
"use strict";
const fs = require("fs");
const vm = require("vm");

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
  areDifferent(a, b) { return this.getResultingValue(a) !== this.getResultingValue(b); }
  getMinimumValue() { return Number("1e-" + this.decimals); }
}

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
}

const words = (list) => Array.from(list).flatMap((one) => one === undefined || one === null || one === "" ? []
  : typeof one === "object" && "length" in one ? words(one) : [String(one)]);

function runOne(text, type) {
  const lines = [];
  let pending = "";
  let separator = " ";
  const write = (piece) => {
    const frames = new Error().stack.split("\n").map((line) => /at (?:\w+\.)?(\w+) \(post:/.exec(line)).filter(Boolean);
    pending += piece;
    for (let end; (end = pending.indexOf("\n")) >= 0; pending = pending.slice(end + 1)) {
      lines.push({text: pending.slice(0, end), cycle: frames.some((frame) => frame[1] === "onCyclePoint")});
    }
  };
  const line = (one) => write(one + "\n");
  const cycle = {...VALUES};
  if (/angle/.test(type)) { Object.assign(cycle, {probeSpacing: 20, nominalAngle: type === "probing-x-plane-angle" ? 90 : 0}); }
  const tool = {number: 7, diameter: 6, description: "probe", spindleRPM: 50, type: "probe", lengthOffset: 7, diameterOffset: 7};
  const parameters = {"operation-strategy": "probe", "operation-comment": type};
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
    getProperty: (name) => valueOf(typeof name === "object" ? name : context.properties[name]),
    hasParameter: section.hasParameter, getParameter: section.getParameter,
    getFramePosition: (one) => one, getCurrentPosition: () => position, isProbingCycle: (one) => one.startsWith("probing")};
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
let out = "";
for (const type of TYPES) {
  out += type.padEnd(width) + "  ";
  try {
    const blocks = runOne(post, type);
    ++printed;
    out += `${blocks.length} block${blocks.length === 1 ? "" : "s"}\n` + blocks.map((one) => "    " + one + "\n").join("");
  } catch (problem) {
    if (!(problem instanceof Refused)) { throw problem; }
    ++refused;
    out += `refused: ${problem.message} (line ${/\(post:(\d+)/.exec(problem.stack)[1]})\n`;
  }
}
process.stdout.write(out + `${printed} of 24 cycles are printed, ${refused} refused, 0 fail\n`);
