// ---- number formats: createFormat ---------------------------------------------------------------------------

var FORMAT_MEMBERS = {decimals: 6, trim: true, trimLeadZero: false, forceDecimal: false, forceSign: false,
  zeropad: false, width: 0, separator: ".", scale: 1, offset: 0, cyclicLimit: 0, cyclicSign: 0, prefix: "",
  suffix: "", type: undefined, minDigitsLeft: 0, minDigitsRight: 0, base: 10, minimum: undefined,
  maximum: undefined};

function Format(specifiers) {
  var given = specifiers || {};
  for (var name in FORMAT_MEMBERS) {
    this[name] = FORMAT_MEMBERS[name];
    if (given.inherit !== undefined) {
      this[name] = given.inherit[name];
    }
    if (given[name] !== undefined) {
      this[name] = given[name];
    }
  }
  this.prefix = String(this.prefix);
  this.suffix = String(this.suffix);
}

function padded(text, width) {
  while (text.length < width) {
    text = "0" + text;
  }
  return text;
}

function placesOf(format) {
  return format.type === values.FORMAT_INTEGER ? 0 : Math.max(0, format.decimals);
}

function scaledOf(format, value) {
  var of = value;
  if (format.cyclicLimit > 0) { // in the unit of what is given: posts write 2 * Math.PI beside `scale: DEG`
    of = of % format.cyclicLimit;
    if (format.cyclicSign > 0 && of < 0) {
      of += format.cyclicLimit;
    }
    if (format.cyclicSign < 0 && of > 0) {
      of -= format.cyclicLimit;
    }
  }
  return settings["offset-after-scale"] ? of * format.scale + format.offset : (of + format.offset) * format.scale;
}

// What an engine does of a value that its format does not allow, no source states.
function checkBounds(format, value) {
  if (value < format.minimum || value > format.maximum) {
    unproven("a format has `minimum` or `maximum`, and a value lies beyond: it is printed as it is given");
  }
}

// How often the last decimal place is in the value, half away from zero; never -0.
function unitsOf(format, value) {
  var scaled = scaledOf(format, value);
  var units = Math.floor(Math.abs(scaled) * Number("1e" + placesOf(format)) + 0.5);
  return scaled < 0 && units !== 0 ? -units : units;
}

// The digits of a whole number, also of one that JavaScript writes with an exponent.
function digitsOf(units) {
  var text = String(Math.abs(units));
  var match = /^(\d)(?:\.(\d+))?e\+(\d+)$/.exec(text);
  if (match === null) {
    return text;
  }
  var digits = match[1] + (match[2] || "");
  while (digits.length <= Number(match[3])) {
    digits += "0";
  }
  return digits;
}

Format.prototype.format = function (given) {
  var value = numberOf(given, "format");
  checkBounds(this, value);
  var places = placesOf(this);
  var units = unitsOf(this, value);
  var sign = units < 0 ? "-" : this.forceSign ? "+" : "";
  if (this.base !== 10 && places === 0) {
    return this.prefix + sign + padded(Math.abs(units).toString(this.base).toUpperCase(), this.width) + this.suffix;
  }
  var digits = padded(digitsOf(units), places + 1);
  var whole = digits.substring(0, digits.length - places);
  var fraction = digits.substring(digits.length - places);
  if (this.type === values.FORMAT_LZS || this.type === values.FORMAT_TZS) {
    whole = padded(whole, this.minDigitsLeft);
    var text = whole + fraction;
    text = this.type === values.FORMAT_LZS ? text.replace(/^0+/, "") : text.replace(/0+$/, "");
    return this.prefix + sign + (text === "" ? "0" : text) + this.suffix;
  }
  if (this.type !== undefined || this.trim) {
    fraction = fraction.replace(/0+$/, "");
  }
  while (fraction.length < this.minDigitsRight) {
    fraction += "0";
  }
  whole = padded(whole, Math.max(this.minDigitsLeft, this.zeropad ? this.width : 0));
  var point = fraction !== "" || this.forceDecimal || this.type === values.FORMAT_REAL;
  if (this.trimLeadZero && /^0+$/.test(whole) && fraction !== "") {
    whole = "";
  }
  return this.prefix + sign + whole + (point ? this.separator : "") + fraction + this.suffix;
};
Format.prototype.getResultingValue = function (value) {
  return Number(unitsOf(this, numberOf(value, "getResultingValue")) + "e-" + placesOf(this));
};
// What was given less what is printed, without what the subtraction adds.
Format.prototype.getError = function (value) {
  return Number((scaledOf(this, value) - this.getResultingValue(value)).toFixed(12));
};
Format.prototype.isSignificant = function (value) {
  return unitsOf(this, numberOf(value, "isSignificant")) !== 0;
};
// Posts compare a code with that of a variable that has none yet.
Format.prototype.areDifferent = function (a, b) {
  if (a === undefined || b === undefined) {
    return a !== b;
  }
  return unitsOf(this, numberOf(a, "areDifferent")) !== unitsOf(this, numberOf(b, "areDifferent"));
};
Format.prototype.getMinimumValue = function () {
  return Number("1e-" + placesOf(this)) / Math.abs(this.scale || 1);
};
Format.prototype.toString = function () {
  return "[format]";
};

(function () {
  var accessors = {NumberOfDecimals: "decimals", Decimals: "decimals", Trim: "trim", TrimLeadZero: "trimLeadZero",
    ForceDecimal: "forceDecimal", ForceSign: "forceSign", ZeroPad: "zeropad", Width: "width",
    DecimalSymbol: "separator", Separator: "separator", Scale: "scale", Offset: "offset", Prefix: "prefix",
    Suffix: "suffix", Type: "type", MinDigitsLeft: "minDigitsLeft", MinDigitsRight: "minDigitsRight",
    CyclicLimit: "cyclicLimit", CyclicSign: "cyclicSign", CyclicMapping: "cyclicLimit", Base: "base",
    Minimum: "minimum", Maximum: "maximum"};
  Object.keys(accessors).forEach(function (name) {
    var member = accessors[name];
    Format.prototype["get" + name] = function () {
      return this[member];
    };
    Format.prototype["set" + name] = function (value) {
      this[member] = value;
      return this;
    };
  });
}());

give({
  createFormat: function (specifiers) {
    return new Format(specifiers);
  },
  FormatNumber: Format,
  Format: Format
});
