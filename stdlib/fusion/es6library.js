// More of the library that newer engines have and posts may use. ES5.

(function () {
  var add = dotekEs6.add;

  // Equal elements keep their order: posts sort tools and sections by one of their numbers.
  function merged(values, compare) {
    if (values.length < 2) {
      return values;
    }
    var middle = values.length >> 1;
    var a = merged(values.slice(0, middle), compare);
    var b = merged(values.slice(middle), compare);
    var out = [];
    for (var i = 0, k = 0; i < a.length || k < b.length;) {
      out.push(k >= b.length || (i < a.length && compare(a[i], b[k]) <= 0) ? a[i++] : b[k++]);
    }
    return out;
  }
  function byText(a, b) {
    var left = String(a);
    var right = String(b);
    return left < right ? -1 : left > right ? 1 : 0;
  }
  function sort(compare) {
    if (compare !== undefined && typeof compare !== "function") {
      throw new TypeError("sort: what compares is no function");
    }
    var given = [];
    var without = 0;
    for (var i = 0; i < this.length; ++i) {
      if (i in this && this[i] !== undefined) {
        given.push(this[i]);
      } else if (i in this) {
        ++without;
      }
    }
    // What a comparison gives need not be a number: NaN is 0.
    var out = merged(given, compare === undefined ? byText : function (a, b) { return Number(compare(a, b)) || 0; });
    for (var at = 0; at < this.length; ++at) {
      if (at < out.length) {
        this[at] = out[at];
      } else if (at < out.length + without) {
        this[at] = undefined;
      } else {
        delete this[at];
      }
    }
    return this;
  }
  dotekEs6.method(Array.prototype, "sort", sort);

  function place(i, length) {
    var at = Math.trunc(i) || 0;
    return at < 0 ? Math.max(0, length + at) : Math.min(at, length);
  }
  add(Array.prototype, "toSorted", function (compare) { return sort.call(dotekEs6.list(this).slice(), compare); });
  add(Array.prototype, "toReversed", function () { return dotekEs6.list(this).slice().reverse(); });
  add(Array.prototype, "toSpliced", function () {
    var out = dotekEs6.list(this).slice();
    out.splice.apply(out, arguments);
    return out;
  });
  add(Array.prototype, "with", function (i, value) {
    var at = Math.trunc(i) || 0;
    var out = dotekEs6.list(this).slice();
    if (at < -out.length || at >= out.length) {
      throw new RangeError("with: there is no element " + at);
    }
    out[at < 0 ? out.length + at : at] = value;
    return out;
  });
  add(Array.prototype, "copyWithin", function (to, from, end) {
    var moved = this.slice(place(from, this.length), end === undefined ? this.length : place(end, this.length));
    var start = place(to, this.length);
    for (var i = 0; i < moved.length && start + i < this.length; ++i) {
      this[start + i] = moved[i];
    }
    return this;
  });
  add(Object, "hasOwn", function (of, name) { return Object.prototype.hasOwnProperty.call(of, name); });
  add(String.prototype, "trimLeft", String.prototype.trimStart);
  add(String.prototype, "trimRight", String.prototype.trimEnd);
  add(String, "raw", function (of) {
    var out = "";
    for (var i = 0; i < of.raw.length; ++i) {
      out += of.raw[i] + (i + 1 < of.raw.length && i + 1 < arguments.length ? arguments[i + 1] : "");
    }
    return out;
  });

  var single = new Float32Array(1);
  add(Math, "fround", function (x) {
    single[0] = x;
    return single[0];
  });
  add(Math, "log1p", function (x) {
    var sum = 1 + Number(x);
    return sum === 1 ? Number(x) : sum === Infinity ? sum : Math.log(sum) * (x / (sum - 1));
  });
  add(Math, "expm1", function (x) {
    var power = Math.exp(x);
    return power === 1 ? Number(x) : power - 1 === -1 ? -1 : power === Infinity ? power : (power - 1) * (x / Math.log(power));
  });
  function odd(of) {
    return function (x) {
      return x === 0 || x !== x ? Number(x) : x < 0 ? -of(-x) : of(Number(x));
    };
  }
  add(Math, "sinh", odd(function (x) {
    var less = Math.expm1(x);
    return x > 22 ? Math.exp(x / 2) / 2 * Math.exp(x / 2) : (less + less / (less + 1)) / 2;
  }));
  add(Math, "cosh", function (x) {
    var power = Math.exp(Math.abs(x) / 2);
    return power / 2 * power + 0.5 / power / power;
  });
  add(Math, "tanh", odd(function (x) {
    var less = Math.expm1(2 * x);
    return x > 22 ? 1 : less / (less + 2);
  }));
  add(Math, "asinh", odd(function (x) {
    return x > 1e8 ? Math.log(x) + Math.LN2 : Math.log1p(x + x * x / (1 + Math.sqrt(x * x + 1)));
  }));
  add(Math, "acosh", function (x) {
    return x > 1e8 ? Math.log(x) + Math.LN2 : Math.log1p(x - 1 + Math.sqrt((x - 1) * (x - 1) + 2 * (x - 1)));
  });
  add(Math, "atanh", odd(function (x) { return Math.log1p(2 * x / (1 - x)) / 2; }));
})();

if (typeof Map === "undefined") {
  var Map = (function () {
    function Table(pairs) {
      dotekEs6.hidden(this, {dotekKeys: [], dotekValues: [], size: 0});
      var given = pairs === undefined || pairs === null ? [] : dotekEs6.list(pairs);
      for (var i = 0; i < given.length; ++i) {
        this.set(given[i][0], given[i][1]);
      }
    }
    Table.prototype.dotekAt = function (key) {
      for (var i = 0; i < this.dotekKeys.length; ++i) {
        if (this.dotekKeys[i] === key || (key !== key && this.dotekKeys[i] !== this.dotekKeys[i])) {
          return i;
        }
      }
      return -1;
    };
    Table.prototype.get = function (key) {
      var at = this.dotekAt(key);
      return at < 0 ? undefined : this.dotekValues[at];
    };
    Table.prototype.has = function (key) { return this.dotekAt(key) >= 0; };
    Table.prototype.set = function (key, value) {
      var at = this.dotekAt(key);
      if (at < 0) {
        this.dotekKeys.push(key);
        this.dotekValues.push(value);
        ++this.size;
      } else {
        this.dotekValues[at] = value;
      }
      return this;
    };
    Table.prototype["delete"] = function (key) {
      var at = this.dotekAt(key);
      if (at >= 0) {
        this.dotekKeys.splice(at, 1);
        this.dotekValues.splice(at, 1);
        --this.size;
      }
      return at >= 0;
    };
    Table.prototype.clear = function () {
      this.dotekKeys = [];
      this.dotekValues = [];
      this.size = 0;
    };
    Table.prototype.keys = function () { return this.dotekKeys.slice(); };
    Table.prototype.values = function () { return this.dotekValues.slice(); };
    Table.prototype.entries = function () {
      var values = this.dotekValues;
      return this.dotekKeys.map(function (key, i) { return [key, values[i]]; });
    };
    Table.prototype.dotekList = Table.prototype.entries;
    // What is added on the way is gone through, too.
    Table.prototype.forEach = function (call, self) {
      for (var i = 0; i < this.dotekKeys.length;) {
        var key = this.dotekKeys[i];
        call.call(self, this.dotekValues[i], key, this);
        var at = this.dotekAt(key);
        i = at < 0 ? i : at + 1;
      }
    };
    return Table;
  })();
}

if (typeof Set === "undefined") {
  var Set = (function () {
    function Members(values) {
      dotekEs6.hidden(this, {dotekMap: new Map(), size: 0});
      var given = values === undefined || values === null ? [] : dotekEs6.list(values);
      for (var i = 0; i < given.length; ++i) {
        this.add(given[i]);
      }
    }
    Members.prototype.add = function (value) {
      this.dotekMap.set(value, value);
      this.size = this.dotekMap.size;
      return this;
    };
    Members.prototype.has = function (value) { return this.dotekMap.has(value); };
    Members.prototype["delete"] = function (value) {
      var out = this.dotekMap["delete"](value);
      this.size = this.dotekMap.size;
      return out;
    };
    Members.prototype.clear = function () {
      this.dotekMap.clear();
      this.size = 0;
    };
    Members.prototype.values = function () { return this.dotekMap.keys(); };
    Members.prototype.keys = Members.prototype.values;
    Members.prototype.dotekList = Members.prototype.values;
    Members.prototype.forEach = function (call, self) {
      var own = this;
      this.dotekMap.forEach(function (value) { call.call(self, value, value, own); });
    };
    return Members;
  })();
}

// Nothing is collected while a post runs.
if (typeof WeakMap === "undefined") {
  var WeakMap = Map;
}
if (typeof WeakSet === "undefined") {
  var WeakSet = Set;
}
