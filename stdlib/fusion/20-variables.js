// ---- variables: when a word is printed -----------------------------------------------------------------------

// `kind`: "variable", "modal", "reference", "incremental", "output".
function Variable(kind, specifiers, format) {
  var given = specifiers || {};
  this.dotekKind = kind;
  this.dotekFormat = format;
  this.prefix = given.prefix === undefined ? undefined : String(given.prefix);
  this.suffix = given.suffix === undefined ? undefined : String(given.suffix);
  this.control = given.force ? values.CONTROL_FORCE : given.control === undefined ? values.CONTROL_CHANGED
    : given.control;
  this.type = kind === "incremental" ? values.TYPE_INCREMENTAL : given.type === undefined ? values.TYPE_ABSOLUTE
    : given.type;
  this.tolerance = given.tolerance || 0;
  this.cyclicLimit = given.cyclicLimit || 0;
  this.cyclicSign = given.cyclicSign || 0;
  this.onchange = given.onchange;
  this.enabled = true;
  this.stored = kind === "incremental" && given.first !== undefined ? given.first : given.current;
}

// The word, without its prefix where the variable has one of its own that replaces it.
function wordOf(variable, value) {
  var format = variable.dotekFormat;
  var text = format.format(value);
  if (variable.prefix !== undefined && (variable.dotekKind === "modal" || variable.dotekKind === "output")) {
    text = text.substring(String(format.prefix).length);
  }
  return (variable.prefix === undefined ? "" : variable.prefix) + text +
    (variable.suffix === undefined ? "" : variable.suffix);
}

function sameFor(variable, a, b) {
  if (a === undefined || b === undefined) {
    return false;
  }
  if (!variable.dotekFormat.areDifferent(a, b)) {
    return true;
  }
  return variable.tolerance > 0 && Math.abs(a - b) < variable.tolerance;
}

Variable.prototype.format = function (given, reference) {
  if (given === undefined || given === null) {
    throw sourceError("format: " + given + " is no number");
  }
  var value = numberOf(given, "format");
  var before = this.stored;
  var shown = value;
  var same;
  this.stored = value;
  if (this.dotekKind === "reference") {
    same = sameFor(this, value, reference === undefined ? 0 : reference);
  } else if (this.type === values.TYPE_INCREMENTAL) {
    shown = value - (before === undefined ? 0 : before);
    same = !this.dotekFormat.isSignificant(shown);
  } else if (this.control === values.CONTROL_NONZERO) {
    same = !this.dotekFormat.isSignificant(value);
  } else {
    same = sameFor(this, value, before);
  }
  if (!this.enabled || (same && this.control !== values.CONTROL_FORCE)) {
    return "";
  }
  if (typeof this.onchange === "function") {
    this.onchange(value);
  }
  if (this.cyclicLimit > 0 || this.type === values.TYPE_DIRECTIONAL) {
    unproven(this.cyclicLimit > 0 ? "cyclicLimit of a variable: the value is printed as it is given"
      : "TYPE_DIRECTIONAL: a value below the last one is printed with a minus");
  }
  if (this.type === values.TYPE_DIRECTIONAL && before !== undefined && value < before) {
    return wordOf(this, -Math.abs(value));
  }
  return wordOf(this, shown);
};
Variable.prototype.reset = function () {
  if (this.type !== values.TYPE_INCREMENTAL) {
    this.stored = undefined;
  }
};
Variable.prototype.enable = function () {
  this.enabled = true;
};
Variable.prototype.disable = function () {
  this.enabled = false;
};
Variable.prototype.isEnabled = function () {
  return this.enabled;
};
Variable.prototype.getCurrent = function () {
  return this.stored;
};
Variable.prototype.setCurrent = function (value) {
  this.stored = value;
};
Variable.prototype.setPrefix = function (prefix) {
  this.prefix = prefix;
};
Variable.prototype.getPrefix = function () {
  return this.prefix;
};
Variable.prototype.setSuffix = function (suffix) {
  this.suffix = suffix;
};
Variable.prototype.setControl = function (control) {
  this.control = control;
};
Variable.prototype.getControl = function () {
  return this.control;
};
Variable.prototype.setForce = function (force) {
  this.control = force ? values.CONTROL_FORCE : values.CONTROL_CHANGED;
};
Variable.prototype.setType = function (type) {
  this.type = type;
};
Variable.prototype.getType = function () {
  return this.type;
};
Variable.prototype.setFormat = function (format) {
  this.dotekFormat = format;
};
Variable.prototype.getFormat = function () {
  return this.dotekFormat;
};
Variable.prototype.setTolerance = function (tolerance) {
  this.tolerance = tolerance;
};
Variable.prototype.setCyclicLimit = function (limit) {
  this.cyclicLimit = limit;
};
Variable.prototype.setCyclicSign = function (sign) {
  this.cyclicSign = sign;
};
["getResultingValue", "areDifferent", "isSignificant", "getError", "getMinimumValue"].forEach(function (name) {
  Variable.prototype[name] = function (a, b) {
    return this.dotekFormat[name](a, b);
  };
});

function ModalGroup(specifiers, groups, format) {
  this.given = specifiers || {};
  this.groups = (groups || []).map(function (group) { return group.slice(); });
  this.dotekFormat = format;
  this.active = [];
  this.enabled = true;
}
ModalGroup.prototype.format = function (code) {
  if (!this.enabled) {
    return "";
  }
  for (var i = 0; i < this.groups.length; ++i) {
    if (this.groups[i].indexOf(code) < 0) {
      continue;
    }
    var was = this.active[i];
    this.active[i] = code;
    return was === code && !this.given.force ? "" : this.dotekFormat.format(code);
  }
  if (this.given.strict) {
    throw sourceError("modal group: the code " + code + " is in no group");
  }
  return this.dotekFormat.format(code);
};
ModalGroup.prototype.reset = function () {
  this.active = [];
};
ModalGroup.prototype.resetGroup = function (code) {
  for (var i = 0; i < this.groups.length; ++i) {
    if (this.groups[i].indexOf(code) >= 0) {
      this.active[i] = undefined;
    }
  }
};
ModalGroup.prototype.isActiveCode = function (code) {
  return this.active.indexOf(code) >= 0;
};
ModalGroup.prototype.getActiveCode = function (group) {
  return this.active[group];
};
ModalGroup.prototype.isCodeDefined = function (code) {
  return this.groups.some(function (group) { return group.indexOf(code) >= 0; });
};
ModalGroup.prototype.hasActiveCode = function (group) {
  return this.active[group] !== undefined;
};
ModalGroup.prototype.getNumberOfGroups = function () {
  return this.groups.length;
};
ModalGroup.prototype.createGroup = function () {
  return this.groups.push([]) - 1;
};
ModalGroup.prototype.addCode = function (group, code) {
  this.groups[group].push(code);
};
ModalGroup.prototype.removeCode = function (code) {
  this.groups.forEach(function (group) {
    if (group.indexOf(code) >= 0) {
      group.splice(group.indexOf(code), 1);
    }
  });
};
ModalGroup.prototype.setForce = function (force) {
  this.given.force = force;
};
ModalGroup.prototype.enable = function () {
  this.enabled = true;
};
ModalGroup.prototype.disable = function () {
  this.enabled = false;
};

function maker(kind) {
  return function (specifiers, format) {
    var of = format === undefined && specifiers ? specifiers.format || new Format({}) : format;
    if (of === undefined || of === null || typeof of.format !== "function") {
      throw sourceError("a variable without a format");
    }
    return new Variable(kind, specifiers, of);
  };
}

give({
  createVariable: maker("variable"),
  createModal: maker("modal"),
  createReferenceVariable: maker("reference"),
  createIncrementalVariable: maker("incremental"),
  createOutputVariable: maker("output"),
  createModalGroup: function (specifiers, groups, format) {
    return new ModalGroup(specifiers, groups, format);
  },
  IncrementalVariable: Variable, ReferenceVariable: Variable, OutputVariable: Variable, Modal: Variable,
  ModalGroup: ModalGroup
});
