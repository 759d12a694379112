// What posts take for granted of ES6 and the engine lacks, and what their lowered text calls (frontend/fusion).
// ES5.

var dotekEs6 = (function () {
  function list(of) {
    if (of === undefined || of === null) {
      throw new TypeError(of + " has no elements");
    }
    if (Array.isArray(of)) {
      for (var at = 0; at < of.length; ++at) {
        if (!(at in of)) { // a hole is an element to who goes through them
          return filled(of);
        }
      }
      return of;
    }
    if (typeof of === "string") {
      return of.match(/[\uD800-\uDBFF][\uDC00-\uDFFF]|[\s\S]/g) || [];
    }
    if (typeof of.dotekList === "function") {
      return of.dotekList();
    }
    if (typeof of.length === "number") {
      return filled(of);
    }
    throw new TypeError("a value without elements is read as a list");
  }
  function filled(of) {
    var out = [];
    for (var i = 0; i < of.length; ++i) {
      out.push(of[i]);
    }
    return out;
  }
  function made(self, type) {
    if (!(self instanceof type)) {
      throw new TypeError("a class is made with `new`");
    }
  }
  // What an assignment to a const is written to.
  function constant(name) {
    return {
      get value() { return undefined; },
      set value(given) { throw new TypeError("`" + name + "` is const and keeps its first value"); }
    };
  }
  // Members that are no names for JSON and for..in.
  function hidden(to, members) {
    for (var name in members) {
      Object.defineProperty(to, name, {value: members[name], writable: true, configurable: true, enumerable: false});
    }
  }
  // Methods of a class are none of the names that for..in goes through.
  function method(object, name, body) {
    Object.defineProperty(object, name, {value: body, writable: true, configurable: true, enumerable: false});
  }
  function assign(to) {
    for (var i = 1; i < arguments.length; ++i) {
      var from = arguments[i];
      if (from === undefined || from === null) {
        continue;
      }
      for (var key in from) {
        if (Object.prototype.hasOwnProperty.call(from, key)) {
          to[key] = from[key];
        }
      }
    }
    return to;
  }
  // Parts of a literal in their order: its accessors stay accessors, those of a spread are read.
  function Part(kind, value) {
    this.kind = kind;
    this.value = value;
  }
  function define(to, key, part) {
    var had = Object.getOwnPropertyDescriptor(to, key);
    if (part.value === undefined && !("value" in part) && had !== undefined && !("value" in had)) {
      part.get = part.get || had.get;
      part.set = part.set || had.set;
    }
    Object.defineProperty(to, key, part);
  }
  function object(to) {
    for (var i = 1; i < arguments.length; ++i) {
      var part = arguments[i];
      if (!(part instanceof Part)) {
        Object.getOwnPropertyNames(part).forEach(function (key) {
          define(to, key, Object.getOwnPropertyDescriptor(part, key));
        });
      } else if (part.kind === "spread") {
        if (part.value !== undefined && part.value !== null) {
          Object.keys(Object(part.value)).forEach(function (key) {
            define(to, key, {value: part.value[key], writable: true, enumerable: true, configurable: true});
          });
        }
      } else if (part.value === null || typeof part.value === "object" || typeof part.value === "function") {
        Object.setPrototypeOf(to, part.value);
      }
    }
    return to;
  }
  function spread(value) { return new Part("spread", value); }
  function prototype(value) { return new Part("prototype", value); }
  function computed(key, kind, body) {
    var out = {};
    var how = {enumerable: true, configurable: true};
    how[kind] = body;
    Object.defineProperty(out, key, how);
    return out;
  }
  function rest(of, taken) {
    var out = {};
    for (var key in of) {
      if (Object.prototype.hasOwnProperty.call(of, key) && taken.indexOf(key) < 0) {
        out[key] = of[key];
      }
    }
    return out;
  }
  function pair(key, value) {
    var out = {};
    out[key] = value;
    return out;
  }
  function extend(made, base) {
    made.prototype = Object.create(base.prototype);
    method(made.prototype, "constructor", made);
    Object.setPrototypeOf(made, base); // static members are inherited, too
  }
  function init(base, self, values) {
    var out = base.apply(self, values);
    if (self instanceof Error && out instanceof Error) {
      self.message = out.message;
    }
    return self;
  }
  function make(type, values) {
    var out = Object.create(type.prototype);
    var given = type.apply(out, values);
    return given !== null && typeof given === "object" ? given : out;
  }
  function accessor(object, name, kind, body) {
    var had = Object.getOwnPropertyDescriptor(object, name) || {configurable: true, enumerable: false};
    var now = {configurable: true, enumerable: false, get: had.get, set: had.set};
    now[kind] = body;
    Object.defineProperty(object, name, now);
  }

  function add(type, name, body) {
    if (type[name] === undefined) {
      Object.defineProperty(type, name, {value: body, writable: true, configurable: true, enumerable: false});
    }
  }
  function same(a, b) {
    return a === b || (a !== a && b !== b);
  }
  add(Array.prototype, "includes", function (value) {
    for (var i = 0; i < this.length; ++i) {
      if (same(this[i], value)) {
        return true;
      }
    }
    return false;
  });
  add(Array.prototype, "find", function (test, self) {
    for (var i = 0; i < this.length; ++i) {
      if (test.call(self, this[i], i, this)) {
        return this[i];
      }
    }
    return undefined;
  });
  add(Array.prototype, "findIndex", function (test, self) {
    for (var i = 0; i < this.length; ++i) {
      if (test.call(self, this[i], i, this)) {
        return i;
      }
    }
    return -1;
  });
  add(Array.prototype, "fill", function (value, from, to) {
    var end = to === undefined ? this.length : to < 0 ? this.length + to : Math.min(to, this.length);
    for (var i = from === undefined ? 0 : from < 0 ? this.length + from : from; i < end; ++i) {
      this[i] = value;
    }
    return this;
  });
  add(Array.prototype, "flat", function (depth) {
    var out = [];
    var most = depth === undefined ? 1 : depth;
    this.forEach(function (one) {
      if (Array.isArray(one) && most > 0) {
        out = out.concat(one.flat(most - 1));
      } else {
        out.push(one);
      }
    });
    return out;
  });
  add(Array.prototype, "flatMap", function (call, self) { return this.map(call, self).flat(); });
  add(Array.prototype, "findLastIndex", function (test, self) {
    for (var i = this.length; i-- > 0;) {
      if (test.call(self, this[i], i, this)) {
        return i;
      }
    }
    return -1;
  });
  add(Array.prototype, "findLast", function (test, self) { return this[this.findLastIndex(test, self)]; });
  add(Object, "fromEntries", function (pairs) {
    var out = {};
    list(pairs).forEach(function (one) { out[one[0]] = one[1]; });
    return out;
  });
  add(Array, "from", function (of, map) {
    var out = list(of).slice();
    return map === undefined ? out : out.map(function (value, i) { return map(value, i); });
  });
  add(Array, "of", function () {
    return Array.prototype.slice.call(arguments);
  });
  add(Object, "assign", assign);
  add(Object, "values", function (of) {
    return Object.keys(of).map(function (key) { return of[key]; });
  });
  add(Object, "entries", function (of) {
    return Object.keys(of).map(function (key) { return [key, of[key]]; });
  });
  add(String.prototype, "includes", function (text, from) {
    return this.indexOf(text, from) >= 0;
  });
  add(String.prototype, "startsWith", function (text, from) {
    var at = from || 0;
    return this.substring(at, at + String(text).length) === String(text);
  });
  add(String.prototype, "endsWith", function (text, length) {
    var all = length === undefined ? String(this) : this.substring(0, length);
    return all.substring(all.length - String(text).length) === String(text);
  });
  add(String.prototype, "repeat", function (count) {
    var out = "";
    for (var i = 0; i < count; ++i) {
      out += this;
    }
    return out;
  });
  function padding(text, length, fill) {
    var out = "";
    var unit = fill === undefined ? " " : String(fill);
    while (unit !== "" && out.length < length - text.length) {
      out += unit;
    }
    return out.substring(0, Math.max(0, length - text.length));
  }
  add(String.prototype, "padStart", function (length, fill) {
    return padding(this, length, fill) + this;
  });
  add(String.prototype, "padEnd", function (length, fill) {
    return this + padding(this, length, fill);
  });
  add(String.prototype, "trimStart", function () { return this.replace(/^\s+/, ""); });
  add(String.prototype, "trimEnd", function () { return this.replace(/\s+$/, ""); });
  add(String.prototype, "replaceAll", function (from, to) {
    var escaped = String(from).replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
    return this.replace(from instanceof RegExp ? from : new RegExp(escaped, "g"), to);
  });
  add(String.prototype, "matchAll", function (by) {
    var out = [];
    var of = new RegExp(by.source, (by.ignoreCase ? "i" : "") + (by.multiline ? "m" : "") + "g");
    for (var found; (found = of.exec(this)) !== null;) {
      out.push(found);
      if (found[0] === "") {
        ++of.lastIndex;
      }
    }
    return out;
  });
  function place(list, i) { return i < 0 ? list.length + Math.ceil(i) : Math.floor(i || 0); }
  add(String.prototype, "at", function (i) { var at = place(this, i); return at in Object(this) ? this.charAt(at) : undefined; });
  add(Array.prototype, "at", function (i) { return this[place(this, i)]; });
  add(Array.prototype, "keys", function () { return list(this).map(function (one, i) { return i; }); });
  add(Array.prototype, "values", function () { return list(this).slice(); });
  add(Array.prototype, "entries", function () { return list(this).map(function (one, i) { return [i, one]; }); });
  add(Math, "sign", function (x) { return x > 0 ? 1 : x < 0 ? -1 : Number(x); });
  add(Math, "trunc", function (x) { return x < 0 ? Math.ceil(x) : Math.floor(x); });
  add(Math, "hypot", function () {
    var sum = 0;
    for (var i = 0; i < arguments.length; ++i) {
      sum += arguments[i] * arguments[i];
    }
    return Math.sqrt(sum);
  });
  add(Math, "log10", function (x) { return Math.log(x) / Math.LN10; });
  add(Math, "log2", function (x) { return Math.log(x) / Math.LN2; });
  Math.cbrt = function (x) { // the engine's own misses whole results
    var root = x < 0 ? -Math.pow(-x, 1 / 3) : Math.pow(x, 1 / 3);
    var whole = Math.round(root);
    return whole * whole * whole === x ? whole : root;
  };
  add(Number, "isFinite", function (x) { return typeof x === "number" && isFinite(x); });
  add(Number, "isNaN", function (x) { return x !== x; });
  add(Number, "isInteger", function (x) { return typeof x === "number" && isFinite(x) && Math.floor(x) === x; });
  add(Number, "parseFloat", parseFloat);
  add(Number, "parseInt", parseInt);
  add(Number, "EPSILON", 2.220446049250313e-16);
  add(Number, "MAX_SAFE_INTEGER", 9007199254740991);
  add(Number, "MIN_SAFE_INTEGER", -9007199254740991);

  return {
    list: list, assign: assign, object: object, spread: spread, prototype: prototype, computed: computed, rest: rest, pair: pair, extend: extend, init: init, make: make, accessor: accessor, constant: constant, made: made, method: method, hidden: hidden, add: add
  };
})();
