// ---- text ------------------------------------------------------------------------------------------------------

function Stop(kind, text) { // what ends a run early
  this.dotekStop = kind;
  this.text = text;
  this.stack = new Error(text).stack;
}
Stop.prototype = Object.create(Error.prototype);
Stop.prototype.toString = function () { // read where a post stops as it is loaded
  return "dotek-stop " + this.dotekStop + " " + this.text;
};

// A post may catch what ends it: the run fails by the first one all the same.
var loading = false;
var loadFault;
function endRun(stop) {
  if (loading) {
    loadFault = loadFault || stop;
  }
  stop.section = loading ? undefined : state.section;
  stop.cycle = loading ? undefined : global.cycleType;
  state.stopped = state.stopped || stop;
  return stop;
}

function placesOfStack(stack) {
  var out = [];
  String(stack).split("\n").forEach(function (line) {
    var match = /at (.*?)\s*\(?((?:post|include)[^():]*):(\d+)(?::\d+)?\)?/.exec(line);
    if (match !== null) {
      out.push({name: match[1].replace(/^Object\./, ""), source: match[2], line: Number(match[3])});
    }
  });
  // The outermost is the entry, whatever its function is called; of a deep stack the engine keeps only the inner calls.
  var called = state === undefined ? undefined : state.entry;
  if (called !== undefined && out.length > 0 && out[out.length - 1].name !== called) {
    if (out[out.length - 1].name === "[anon]") {
      out[out.length - 1].name = called;
    } else {
      out.push({name: called, source: "post", line: 0});
    }
  }
  return out;
}

function begin(job) {
  state = {job: job, text: [], size: 0, most: job.most || 1000000, places: [], line: "", redirected: [], files: {},
    separator: " ", eol: "\n", warnings: [], log: [], told: {}, notes: {}, handlers: [],
    position: undefined, direction: undefined, rotation: undefined, translation: undefined, section: undefined,
    record: undefined, parameters: {}, cyclePoint: 0, cyclePoints: [], expanding: false, skip: false, motion: undefined,
    synchronized: false, buffered: {}, entry: undefined, closed: false};
}

// Lines of a buffer and who wrote them, by their text: who writes the buffer out is not their author.
function remember(line, places) {
  var key = "line " + line;
  (state.buffered[key] = state.buffered[key] || []).push(places);
}
function authorOf(line, places) {
  var of = state.buffered["line " + line];
  return of === undefined ? places : of.length > 1 ? of.shift() : of[0];
}

// Each line knows who wrote its last piece.
function put(to, text, places, whole) {
  var parts = (to.line + text).split("\n");
  for (var i = 0; i + 1 < parts.length; ++i) {
    var of = whole ? authorOf(parts[i], places) : places;
    if (to.places !== undefined) {
      to.places.push(of);
    } else {
      remember(parts[i], of);
    }
  }
  to.line = parts[parts.length - 1];
  to.last = whole ? authorOf(to.line, places) : places;
}

// `whole`: what the post wrote, not words that are joined here, may be lines of a buffer.
function write(text, whole) {
  var piece = String(text);
  state.size += piece.length;
  if (state.size > state.most) {
    throw endRun(new Stop("output", ""));
  }
  var places = state.job.map ? placesOfStack(new Error("").stack) : undefined;
  var to = state.redirected[state.redirected.length - 1];
  if (to !== undefined) {
    to.text.push(piece);
  } else if (state.closed) {
    unproven("the program is closed before onTerminate, and what the post writes there is in no file", "closed");
    return;
  } else {
    state.text.push(piece);
  }
  if (state.job.map) {
    put(to || state, piece, places, whole !== false);
  }
}

function writeln(text, whole) {
  write((text === undefined ? "" : String(text)) + state.eol, whole);
}

// What is in a buffer; its last line may have no end yet.
function bufferText() {
  var last = state.redirected[state.redirected.length - 1];
  if (last === undefined) {
    return "";
  }
  if (state.job.map && last.line !== "") {
    remember(last.line, last.last);
  }
  last.text = [last.text.join("")];
  return last.text[0];
}

// Words of arrays and of `arguments` too; what is empty is left out.
function wordsOf(list, into) {
  for (var i = 0; i < list.length; ++i) {
    var one = list[i];
    if (one === undefined || one === null || one === "") {
      continue;
    }
    if (typeof one === "object" && typeof one.length === "number") {
      wordsOf(one, into);
    } else {
      into.push(String(one));
    }
  }
  return into;
}

function formatWords() {
  return wordsOf(arguments, []).join(state.separator);
}
function writeWords() {
  var text = wordsOf(arguments, []).join(state.separator);
  if (text !== "") {
    writeln(text, false);
  }
}
function writeWords2(first) {
  var rest = wordsOf(Array.prototype.slice.call(arguments, 1), []);
  if (rest.length > 0) {
    writeln(wordsOf([first], []).concat(rest).join(state.separator), false);
  }
}

function subst(text) {
  var parameters = arguments;
  return String(text).replace(/%(\d+)/g, function (all, digits) {
    var value = parameters[Number(digits)];
    return value === undefined ? all : String(value);
  });
}

function error(text) {
  var stop = endRun(new Stop("error", String(text)));
  if (settings["error-stops"]) {
    throw stop;
  }
}

function warning(text) {
  state.warnings.push({text: String(text), places: placesOfStack(new Error("").stack)});
}

function redirectTo(name) {
  state.redirected.push({name: name, text: [], line: ""});
}
function closeRedirection() {
  var last = state.redirected.pop();
  if (last === undefined) {
    throw sourceError("closeRedirection: nothing is redirected");
  }
  if (last.name !== undefined) {
    state.files[last.name] = (state.files[last.name] || "") + last.text.join("");
  }
}

function isSafeText(text, permitted) {
  return String(text).split("").every(function (c) { return permitted.indexOf(c) >= 0; });
}

give({
  write: write, writeln: writeln, writeWords: writeWords, writeWords2: writeWords2, formatWords: formatWords,
  subst: subst, error: error, warning: warning,
  setWordSeparator: function (text) { state.separator = String(text); },
  getWordSeparator: function () { return state.separator; },
  setEOL: function (text) { state.eol = String(text).replace(/\r\n?/g, "\n"); },
  conditional: function (test, text) { return test ? (text === undefined ? "" : text) : ""; },
  localize: function (text) { return text === undefined ? "" : String(text); },
  localize2: function (section, text) { return String(text); },
  translateText: function (text, from, to) {
    var out = String(text);
    return out.split("").map(function (c) {
      var at = from.indexOf(c);
      return at < 0 ? c : to.charAt(at);
    }).join("");
  },
  warningOnce: function (text, id) {
    var key = id === undefined ? "text " + text : "id " + id;
    if (!state.told[key]) {
      state.told[key] = true;
      warning(text);
    }
  },
  log: function (text) { state.log.push(String(text)); },
  debug: function (text) { state.log.push(String(text)); },
  alert: function (title, text) { warning(text === undefined ? title : title + ": " + text); },
  validate: function (test, text) {
    if (!test) {
      error(text === undefined ? "validate: a condition of the post does not hold" : text);
    }
  },
  cycleNotSupported: function () { error("the cycle is not supported: " + global.cycleType); },
  redirectToBuffer: function () { redirectTo(undefined); },
  redirectToFile: function (name) { redirectTo(String(name)); },
  getRedirectionBuffer: function (clear) {
    var last = state.redirected[state.redirected.length - 1];
    var text = bufferText();
    if (last !== undefined && clear !== false) {
      last.text = [];
      last.line = "";
    }
    return text;
  },
  getRedirectionBuffer2: function (clear) {
    var last = state.redirected[state.redirected.length - 1];
    var text = bufferText();
    if (last !== undefined && clear) {
      last.text = [];
      last.line = "";
    }
    return text;
  },
  closeRedirection: closeRedirection,
  isRedirecting: function () { return state.redirected.length > 0; },
  isSafeText: isSafeText,
  filterText: function (text, permitted) {
    return String(text).split("").filter(function (c) { return permitted.indexOf(c) >= 0; }).join("");
  },
  isTextSupported: function () { return true; },
  isSupportedText: function () { return true; },
  flatten: function () { return wordsOf(arguments, []); },
  registerTerminationHandler: function (call) { state.handlers.push(call); },
  setExitCode: function () {},
  setWriteInvocations: function () {}, setWriteStack: function () {},
  setCodePage: function (page) { if (state !== undefined) { state.codePage = page; } },
  getCodePage: function () { return (state && state.codePage) || "ascii"; }
});

var StringBuffer = function (text) {
  this.text = text === undefined ? "" : String(text);
};
StringBuffer.prototype.append = function (text) { this.text += text; return this; };
StringBuffer.prototype.toString = function () { return this.text; };
StringBuffer.prototype.getLength = function () { return this.text.length; };

var StringSubstitution = function (table) {
  this.table = table || {};
};
StringSubstitution.prototype.setValue = function (name, value) { this.table[name] = value; };
StringSubstitution.prototype.substitute = function (text) {
  var table = this.table;
  return String(text).replace(/\$\{([^}]*)\}/g, function (all, name) {
    return table[name] === undefined ? all : String(table[name]);
  });
};
function Template(text) {
  this.text = String(text);
}
Template.prototype.substitute = function (table) { return new StringSubstitution(table).substitute(this.text); };
give({StringBuffer: StringBuffer, StringSubstitution: StringSubstitution, Template: Template});
