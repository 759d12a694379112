// The kernel of Fusion's posts as far as public sources tell it; docs/fusion-kernel.md lists what is proven. ES5. The
// files of this folder are one script, in the order of their names; its value is the function that runs a job.
(function (global) {
"use strict";

var settings = {};
var values = {}; // of constants, by name
var state; // of one run

// Which bound of the engine was met, if one was: of an engine that tells.
var boundOf = global.dotekBound || function () { return undefined; };
delete global.dotekBound;

function sourceError(text) {
  return new Error(text);
}

// Everything that posts see is a property of the global object, and may be replaced by a post: the kernel itself
// calls the functions of this scope.
function give(names) {
  for (var name in names) {
    if (Object.prototype.hasOwnProperty.call(names, name)) {
      global[name] = names[name];
    }
  }
}

// The engine's own, where a post has none, is no entry of the post.
function entry(name) {
  var of = global[name];
  return typeof of === "function" && !of.dotekOwn ? of : undefined;
}

function callEntry(name, parameters) {
  var of = entry(name);
  if (of !== undefined) {
    var outer = state.entry;
    state.entry = outer === undefined ? name : outer;
    try {
      of.apply(global, parameters || []);
    } finally {
      state.entry = outer;
    }
  }
  return of !== undefined;
}

function numberOf(value, where) {
  if (typeof value === "string" && value !== "" && isFinite(value)) {
    return Number(value);
  }
  if (typeof value === "boolean") {
    return value ? 1 : 0;
  }
  if (typeof value !== "number" || !isFinite(value)) {
    throw sourceError(where + ": " + value + " is no number");
  }
  return value;
}

// Jobs hold positions, heights and diameters as 32-bit floats. Values of an exact job are as stored already.
var single = new Float32Array(1);
function rounded(value) {
  if (typeof value !== "number" || (state !== undefined && state.job.exact)) {
    return value;
  }
  single[0] = value;
  return single[0];
}

// A program depends on the post and the job alone: the clock stands at the beginning of 2000, and chance is the same
// in each run.
var EngineDate = Date;
function FixedDate(year, month, day, hours, minutes, seconds, ms) {
  var out = arguments.length === 0 ? new EngineDate(2000, 0, 1, 0, 0, 0)
    : arguments.length === 1 ? new EngineDate(year)
      : new EngineDate(year, month, day === undefined ? 1 : day, hours || 0, minutes || 0, seconds || 0, ms || 0);
  return this instanceof FixedDate ? out : String(new EngineDate(2000, 0, 1, 0, 0, 0));
}
FixedDate.prototype = EngineDate.prototype;
FixedDate.now = function () { return new EngineDate(2000, 0, 1, 0, 0, 0).getTime(); };
FixedDate.parse = EngineDate.parse;
FixedDate.UTC = EngineDate.UTC;
global.Date = FixedDate;
var chance = 1;
Math.random = function () {
  chance = chance * 16807 % 2147483647;
  return chance / 2147483647;
};
