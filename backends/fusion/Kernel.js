// A double of the post kernel: as much of it as the probing part of a post calls, with the rules of
// docs/fusion.md, "The kernel double". ES5. dotekRun(input) runs one operation; the value of the whole text is
// the function that Dotek calls.

var MM = 1, IN = 0; // as of run-post (stdlib/fusion/kernel.toml)
var X = 0, Y = 1, Z = 2;
var DEG = 180 / Math.PI;
var EOL = "\r\n", SP = " ", TAB = "\t";
var FORMAT_INTEGER = 0, FORMAT_REAL = 1, FORMAT_LZS = 2, FORMAT_TZS = 3;
var CONTROL_CHANGED = 0, CONTROL_FORCE = 1, CONTROL_NONZERO = 2;
var TYPE_ABSOLUTE = 0, TYPE_INCREMENTAL = 1, TYPE_DIRECTIONAL = 2;
var CAPABILITY_MILLING = 1, CAPABILITY_INSPECTION = 8;
var TOOL_PROBE = 37;

var unit = MM;
var properties = {};
var groupDefinitions = {};
var tool = {};
var cycle = {};
var cycleType = "";
var currentSection;

// ---- number formats -------------------------------------------------------------------------------------

function dotekPower10(exponent) {
  return Number("1e" + exponent);
}

// `text` with zeros before it up to `width` characters.
function dotekPadded(text, width) {
  while (text.length < width) {
    text = "0" + text;
  }
  return text;
}

function DotekFormat(specifiers) {
  var names = ["decimals", "trim", "trimLeadZero", "forceDecimal", "forceSign", "zeropad", "width", "separator",
    "scale", "offset", "cyclicLimit", "cyclicSign", "prefix", "suffix", "type", "minDigitsLeft",
    "minDigitsRight", "base", "minimum", "maximum"];
  var given = specifiers || {};
  var from = given.inherit;
  this.decimals = 6;
  this.trim = true;
  this.trimLeadZero = false;
  this.forceDecimal = false;
  this.forceSign = false;
  this.zeropad = false;
  this.width = 0;
  this.separator = ".";
  this.scale = 1;
  this.offset = 0;
  this.cyclicLimit = 0;
  this.cyclicSign = 0;
  this.prefix = "";
  this.suffix = "";
  this.type = undefined;
  this.minDigitsLeft = 0;
  this.minDigitsRight = 0;
  this.base = 0;
  this.minimum = undefined;
  this.maximum = undefined;
  for (var i = 0; i < names.length; ++i) {
    if (from !== undefined) {
      this[names[i]] = from[names[i]];
    }
    if (given[names[i]] !== undefined) {
      this[names[i]] = given[names[i]];
    }
  }
}

// Digits that the value is rounded to; an integer has none.
DotekFormat.prototype.dotekDecimals = function () {
  return this.type === FORMAT_INTEGER ? 0 : this.decimals;
};

// Units of the last decimal place, a whole number with sign: rounded half away from zero.
DotekFormat.prototype.dotekUnits = function (value) {
  var scaled = value * this.scale + this.offset;
  if (this.cyclicLimit > 0) {
    scaled = scaled % this.cyclicLimit;
    if (this.cyclicSign > 0 && scaled < 0) {
      scaled += this.cyclicLimit;
    }
    if (this.cyclicSign < 0 && scaled > 0) {
      scaled -= this.cyclicLimit;
    }
  }
  var units = Math.floor(Math.abs(scaled) * dotekPower10(this.dotekDecimals()) + 0.5);
  return scaled < 0 && units !== 0 ? -units : units;
};

DotekFormat.prototype.getResultingValue = function (value) {
  return Number(this.dotekUnits(value) + "e-" + this.dotekDecimals());
};
DotekFormat.prototype.getError = function (value) {
  return value * this.scale + this.offset - this.getResultingValue(value);
};
DotekFormat.prototype.isSignificant = function (value) {
  return this.dotekUnits(value) !== 0;
};
DotekFormat.prototype.areDifferent = function (a, b) {
  return this.dotekUnits(a) !== this.dotekUnits(b);
};
DotekFormat.prototype.getMinimumValue = function () {
  return Number("1e-" + this.dotekDecimals());
};

DotekFormat.prototype.format = function (value) {
  if (typeof value !== "number" || !isFinite(value)) {
    throw new Error("format: " + value + " is no number");
  }
  var decimals = this.dotekDecimals();
  var units = this.dotekUnits(value);
  var digits = dotekPadded(String(Math.abs(units)), decimals + 1);
  var whole = digits.substring(0, digits.length - decimals);
  var fraction = digits.substring(digits.length - decimals);
  var sign = units < 0 ? "-" : this.forceSign ? "+" : "";
  var text;
  if (this.type === FORMAT_LZS || this.type === FORMAT_TZS) {
    // Without a point; zeros of one side are dropped.
    text = whole + fraction;
    text = this.type === FORMAT_LZS ? text.replace(/^0+/, "") : text.replace(/0+$/, "");
    return this.prefix + sign + (text === "" ? "0" : text) + this.suffix;
  }
  var keepTrailing = this.type === undefined ? !this.trim : false;
  if (!keepTrailing) {
    fraction = fraction.replace(/0+$/, "");
  }
  while (fraction.length < this.minDigitsRight) {
    fraction += "0";
  }
  if (this.type !== undefined) {
    whole = dotekPadded(whole, this.minDigitsLeft);
  } else if (this.zeropad) {
    whole = dotekPadded(whole, this.width);
  }
  var point = fraction !== "" || (this.type === undefined ? this.forceDecimal : this.type === FORMAT_REAL);
  if (this.trimLeadZero && whole === "0" && fraction !== "") {
    whole = "";
  }
  return this.prefix + sign + whole + (point ? this.separator : "") + fraction + this.suffix;
};

(function () {
  // getScale, setScale and their like.
  var accessors = {NumberOfDecimals: "decimals", Trim: "trim", TrimLeadZero: "trimLeadZero",
    ForceDecimal: "forceDecimal", ForceSign: "forceSign", ZeroPad: "zeropad", Width: "width",
    DecimalSymbol: "separator", Scale: "scale", Offset: "offset", Prefix: "prefix", Suffix: "suffix",
    Type: "type", MinDigitsLeft: "minDigitsLeft", MinDigitsRight: "minDigitsRight"};
  function add(name, member) {
    DotekFormat.prototype["get" + name] = function () {
      return this[member];
    };
    DotekFormat.prototype["set" + name] = function (value) {
      this[member] = value;
    };
  }
  for (var name in accessors) {
    if (accessors.hasOwnProperty(name)) {
      add(name, accessors[name]);
    }
  }
}());

function createFormat(specifiers) {
  return new DotekFormat(specifiers);
}

// ---- variables: when a word is printed ------------------------------------------------------------------

// kind: "variable", "modal", "reference", "incremental" or "output".
function DotekVariable(kind, specifiers, format) {
  var given = specifiers || {};
  this.kind = kind;
  this.formatter = format;
  this.prefix = given.prefix;
  this.suffix = given.suffix;
  this.control = given.control === undefined ? CONTROL_CHANGED : given.control;
  if (given.force) {
    this.control = CONTROL_FORCE;
  }
  this.type = given.type === undefined ? TYPE_ABSOLUTE : given.type;
  if (kind === "incremental") {
    this.type = TYPE_INCREMENTAL;
  }
  this.tolerance = given.tolerance || 0;
  this.onchange = given.onchange;
  this.enabled = true;
  this.stored = kind === "incremental" ? given.first : given.current;
}

DotekVariable.prototype.dotekWord = function (value) {
  var replaces = this.prefix !== undefined && (this.kind === "modal" || this.kind === "output");
  var plain = this.formatter.format(value);
  var own = replaces ? this.formatter.getPrefix() : "";
  return (this.prefix === undefined ? "" : this.prefix) + plain.substring(own.length) +
    (this.suffix === undefined ? "" : this.suffix);
};

DotekVariable.prototype.dotekSame = function (a, b) {
  return a !== undefined && b !== undefined &&
    (!this.formatter.areDifferent(a, b) || Math.abs(a - b) < this.tolerance);
};

DotekVariable.prototype.format = function (value, reference) {
  var before = this.stored;
  var shown = value;
  var same;
  this.stored = value;
  if (this.kind === "reference") {
    same = this.dotekSame(value, reference);
  } else if (this.type === TYPE_INCREMENTAL) {
    shown = value - (before === undefined ? 0 : before);
    same = !this.formatter.isSignificant(shown);
  } else if (this.control === CONTROL_NONZERO) {
    same = !this.formatter.isSignificant(value);
  } else {
    same = this.dotekSame(value, before);
  }
  if (!this.enabled || (same && this.control !== CONTROL_FORCE)) {
    return "";
  }
  if (this.onchange !== undefined) {
    this.onchange();
  }
  if (this.type === TYPE_DIRECTIONAL && before !== undefined && value < before) {
    return this.dotekWord(-Math.abs(value));
  }
  return this.dotekWord(shown);
};
DotekVariable.prototype.reset = function () {
  if (this.type !== TYPE_INCREMENTAL) {
    this.stored = undefined;
  }
};
DotekVariable.prototype.disable = function () {
  this.enabled = false;
};
DotekVariable.prototype.getCurrent = function () {
  return this.stored;
};
DotekVariable.prototype.setPrefix = function (prefix) {
  this.prefix = prefix;
};

function createVariable(specifiers, format) {
  return new DotekVariable("variable", specifiers, format);
}
function createModal(specifiers, format) {
  return new DotekVariable("modal", specifiers, format);
}
function createReferenceVariable(specifiers, format) {
  return new DotekVariable("reference", specifiers, format);
}
function createIncrementalVariable(specifiers, format) {
  return new DotekVariable("incremental", specifiers, format);
}
function createOutputVariable(specifiers, format) {
  var out = new DotekVariable("output", specifiers, format);
  out.enable = function () {
    this.enabled = true;
  };
  out.isEnabled = function () {
    return this.enabled;
  };
  out.setCurrent = function (value) {
    this.stored = value;
  };
  out.setControl = function (control) {
    this.control = control;
  };
  out.setType = function (type) {
    this.type = type;
  };
  out.setFormat = function (other) {
    this.formatter = other;
  };
  out.getResultingValue = function (value) {
    return this.formatter.getResultingValue(value);
  };
  out.areDifferent = function (a, b) {
    return this.formatter.areDifferent(a, b);
  };
  out.isSignificant = function (value) {
    return this.formatter.isSignificant(value);
  };
  return out;
}

function DotekModalGroup(specifiers, groups, format) {
  this.given = specifiers || {};
  this.groups = groups;
  this.formatter = format;
  this.active = [];
}
DotekModalGroup.prototype.format = function (code) {
  for (var i = 0; i < this.groups.length; ++i) {
    if (this.groups[i].indexOf(code) < 0) {
      continue;
    }
    if (this.active[i] === code && !this.given.force) {
      return "";
    }
    this.active[i] = code;
    return this.formatter.format(code);
  }
  if (this.given.strict) {
    throw new Error("modal group: no code " + code);
  }
  return this.formatter.format(code);
};
DotekModalGroup.prototype.reset = function () {
  this.active = [];
};
function createModalGroup(specifiers, groups, format) {
  return new DotekModalGroup(specifiers, groups, format);
}

// ---- text -----------------------------------------------------------------------------------------------

// The text that is written, its end in `text`: of long texts, all before is in `before`.
var dotekState = {text: "", before: [], size: 0, most: undefined, flood: false, buffer: null, separator: " ",
  eol: "\n", errors: [], warnings: [], log: [], afterError: false, told: {}, point: 0};

function write(text) {
  if (dotekState.buffer !== null) {
    dotekState.buffer += text;
    return;
  }
  if (dotekState.errors.length > 0) {
    dotekState.afterError = true;
  }
  dotekState.text += text;
  if (dotekState.text.length > 4096) {
    dotekState.before.push(dotekState.text);
    dotekState.size += dotekState.text.length;
    dotekState.text = "";
    if (dotekState.size > dotekState.most) {
      dotekState.flood = true;
      throw new Error("more text than is taken");
    }
  }
}
function writeln(text) {
  write((text === undefined ? "" : text) + dotekState.eol);
}

// Non-empty words of nested arrays and argument lists, in order.
function dotekFlat(list, out) {
  for (var i = 0; i < list.length; ++i) {
    var one = list[i];
    if (one === undefined || one === null || one === "") {
      continue;
    }
    if (typeof one === "object" && one.length !== undefined) {
      dotekFlat(one, out);
    } else {
      out.push(String(one));
    }
  }
  return out;
}
function formatWords() {
  return dotekFlat(arguments, []).join(dotekState.separator);
}
function writeWords() {
  var text = formatWords(arguments);
  if (text !== "") {
    writeln(text);
  }
}
function writeWords2(first) {
  var rest = Array.prototype.slice.call(arguments, 1);
  if (formatWords(rest) !== "") {
    writeWords(first, rest);
  }
}
function setWordSeparator(separator) {
  dotekState.separator = separator;
}
function setEOL(eol) {
  dotekState.eol = eol;
}
function conditional(condition, text) {
  return condition ? text : "";
}
function subst(text) {
  for (var i = arguments.length - 1; i > 0; --i) {
    text = text.split("%" + i).join(String(arguments[i]));
  }
  return text;
}
function localize(text) {
  return text;
}
function redirectToBuffer() {
  dotekState.buffer = "";
}
function getRedirectionBuffer() {
  return dotekState.buffer;
}
function closeRedirection() {
  dotekState.buffer = null;
}

function isFirstCyclePoint() {
  return dotekState.point === 0;
}

// Whether the kernel stops a script here is unproven: the double goes on and says what was written after it.
function error(text) {
  dotekState.errors.push(String(text));
}
function warning(text) {
  dotekState.warnings.push(String(text));
}
function warningOnce(text, id) {
  if (!dotekState.told[id]) {
    dotekState.told[id] = true;
    warning(text);
  }
}
function log(text) {
  dotekState.log.push(String(text));
}
function validate(condition, text) {
  if (!condition) {
    throw new Error(text === undefined ? "validation failed" : text);
  }
}
function cycleNotSupported() {
  throw new Error("the cycle `" + cycleType + "` is not supported");
}
function setCodePage() {
}

// ---- units, angles, properties --------------------------------------------------------------------------

function toRad(degrees) {
  return degrees / DEG;
}
function toDeg(radians) {
  return radians * DEG;
}
function toPreciseUnit(value, given) {
  return given === unit ? value : unit === MM ? value * 25.4 : value / 25.4;
}
// The kernel's rule for round defaults: 25 mm an inch.
function spatial(value, given) {
  return given === unit ? value : unit === MM ? value * 25 : value / 25;
}
function toUnit(value, given) {
  return spatial(value, given);
}

var dotekValues = {};

function getProperty(name, otherwise) {
  if (dotekValues.hasOwnProperty(name)) {
    return dotekValues[name];
  }
  var property = properties[name];
  if (property === undefined) {
    return otherwise;
  }
  return typeof property === "object" && property !== null ? property.value : property;
}
function setProperty(name, value) {
  dotekValues[name] = value;
}

// ---- running one operation ------------------------------------------------------------------------------

// Outputs of a post, whose values are forgotten by who writes words without them.
var dotekOutputs = ["xOutput", "yOutput", "zOutput", "feedOutput", "gMotionModal"];

// input: {unit, properties: {name: value}, points: [[x, y, z]], tool, cycle, cycleType, entry: function name,
// most: characters of text, strategy}. With `entry`, that function alone is called for each point; else the
// entry functions of a post in their order. Gives {text, errors, warnings, afterError}; with `entry` also
// `taken`, what its last call returned, `defined`, values of the properties' definitions, and `kept`, names of
// outputs that have not forgotten what was printed before.
function dotekRun(input) {
  var global = (function () {
    return this;
  }()) || globalThis;
  function call(name, list) {
    if (typeof global[name] === "function") {
      return global[name].apply(null, list || []);
    }
  }
  var taken, kept = [], defined = {}, offered = [], scopes = {}, titles = {}, groups = {}, entries, entry;
  for (var name in input.entry === undefined ? {} : properties) {
    if (typeof properties[name] === "object" && properties[name] !== null &&
      typeof properties[name].title === "string") {
      titles[name] = properties[name].title;
    }
    if (typeof properties[name] === "object" && properties[name] !== null &&
      typeof properties[name].group === "string" && groupDefinitions[properties[name].group] === undefined) {
      for (var group in groupDefinitions) {
        if (group.toLowerCase() === properties[name].group.toLowerCase()) {
          groups[name] = properties[name].group;
        }
      }
    }
    if (typeof properties[name] === "object" && properties[name] !== null &&
      properties[name].value !== undefined) {
      defined[name] = properties[name].value;
      scopes[name] = properties[name].scope;
      entries = properties[name].values;
      for (entry = 0; entries && entry < entries.length; ++entry) {
        offered[offered.length] = name + "=" + entries[entry].id + "=" + entries[entry].title;
      }
    }
  }
  unit = input.unit === undefined ? MM : input.unit;
  dotekValues = input.properties || {};
  dotekState.most = input.most;
  tool = input.tool || {};
  cycle = input.cycle || {};
  cycleType = input.cycleType || "";
  currentSection = {
    workOffset: 1,
    probeWorkOffset: 1,
    strategy: input.strategy || "drill",
    getTool: function () {
      return tool;
    },
    getProperty: getProperty,
    getId: function () {
      return 0;
    },
    getNumberOfCyclePoints: function () {
      return input.points.length;
    }
  };
  if (input.entry === undefined) {
    call("onMachine");
    call("onOpen");
    call("onSection");
    call("onCycle");
  } else if (typeof global[input.entry] !== "function") {
    throw new Error("there is no function `" + input.entry + "`");
  }
  for (var i = 0; i < input.points.length; ++i) {
    dotekState.point = i;
    for (var j = 0; input.entry !== undefined && j < dotekOutputs.length; ++j) {
      if (global[dotekOutputs[j]] !== undefined) {
        global[dotekOutputs[j]].format(1);
      }
    }
    taken = call(input.entry === undefined ? "onCyclePoint" : input.entry, input.points[i]);
  }
  for (var k = 0; input.entry !== undefined && k < dotekOutputs.length; ++k) {
    if (global[dotekOutputs[k]] !== undefined && global[dotekOutputs[k]].getCurrent() !== undefined) {
      kept.push(dotekOutputs[k]);
    }
  }
  if (input.entry === undefined) {
    call("onCycleEnd");
    call("onSectionEnd");
    call("onClose");
    call("onTerminate");
  }
  return {text: dotekState.before.join("") + dotekState.text, errors: dotekState.errors,
    warnings: dotekState.warnings, afterError: dotekState.afterError, taken: taken, kept: kept,
    defined: defined, offered: offered, scopes: scopes, titles: titles, groups: groups};
}

// ---- what Dotek calls -----------------------------------------------------------------------------------

// A function of the input that gives texts: ["flood"], or the NC text, "late" or "", then each error after an
// "e", each warning after a "w", each output that was kept after a "k", each definition of a property as
// "dNAME=VALUE", its scope as "sNAME=SCOPE", "t" where the entry function returned true. A post that replaces what the double works with is refused: what it does on
// the double says nothing of the kernel.
(function () {
  var global = (function () {
    return this;
  }()) || globalThis;
  var run = dotekRun, state = dotekState, Failure = Error;
  var watched = [];
  function watch(owner, path, names) {
    for (var i = 0; i < names.length; ++i) {
      watched[watched.length] = {owner: owner, path: path, name: names[i], value: owner[names[i]]};
    }
  }
  for (var name in global) {
    if (typeof global[name] === "function") {
      watch(global, "", [name]);
    }
  }
  watch(global, "", ["dotekState", "Math", "Number", "String", "Error", "Array", "isFinite"]);
  watch(Math, "Math.", ["abs", "floor"]);
  watch(Array.prototype, "Array.prototype.", ["indexOf", "join", "push", "slice"]);
  watch(String.prototype, "String.prototype.", ["replace", "split", "substring"]);
  watch(Function.prototype, "Function.prototype.", ["apply", "call"]);
  watch(Object.prototype, "Object.prototype.", ["hasOwnProperty"]);
  return function (input) {
    var result, thrown, threw = false, out, i;
    try {
      result = run(input);
    } catch (e) {
      threw = true;
      thrown = e;
    }
    for (i = 0; i < watched.length; ++i) {
      if (watched[i].owner[watched[i].name] !== watched[i].value) {
        throw new Failure("it replaces `" + watched[i].path + watched[i].name +
          "`, which the double of the post kernel works with");
      }
    }
    if (state.flood) {
      return ["flood"];
    }
    if (threw) {
      throw thrown;
    }
    out = [result.text, result.afterError ? "late" : ""];
    for (i = 0; i < result.errors.length; ++i) {
      out[out.length] = "e" + result.errors[i];
    }
    for (i = 0; i < result.warnings.length; ++i) {
      out[out.length] = "w" + result.warnings[i];
    }
    for (i = 0; i < result.kept.length; ++i) {
      out[out.length] = "k" + result.kept[i];
    }
    for (name in result.defined) {
      out[out.length] = "d" + name + "=" + result.defined[name];
    }
    for (name in result.scopes) {
      out[out.length] = "s" + name + "=" + result.scopes[name];
    }
    for (name in result.titles) {
      out[out.length] = "n" + name + "=" + result.titles[name];
    }
    for (name in result.groups) {
      out[out.length] = "g" + name + "=" + result.groups[name];
    }
    for (i = 0; i < result.offered.length; ++i) {
      out[out.length] = "o" + result.offered[i];
    }
    if (result.taken === true) {
      out[out.length] = "t";
    }
    return out;
  };
}());
