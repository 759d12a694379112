// ---- what a run says beside the program --------------------------------------------------------------------------

// Once a run, or once of a kind.
function unproven(text, kind) {
  var key = "unproven " + (kind === undefined ? text : kind);
  if (!state.told[key]) {
    state.told[key] = true;
    warning(text);
  }
}

// Why a property cannot have the value; "" where it can.
function againstProperty(name, value) {
  var given = (global.properties || {})[name];
  var of = given !== null && typeof given === "object" ? given : (global.propertyDefinitions || {})[name];
  if (of === undefined || of === null || typeof of !== "object") {
    return "";
  }
  if (of.type === "boolean" && typeof value !== "boolean") {
    return "it is true or false";
  }
  if (/^(integer|number|spatial|angle)$/.test(of.type) && typeof value !== "number") {
    return "it is a number";
  }
  if (of.type === "integer" && Math.floor(value) !== value) {
    return "it is a whole number";
  }
  if (of.type === "enum" && Array.isArray(of.values)) {
    var ids = of.values.map(function (one) { return one !== null && typeof one === "object" ? one.id : one; });
    if (!ids.some(function (id) { return String(id) === String(value); })) {
      return "it is one of " + ids.map(function (id) { return "`" + id + "`"; }).join(", ");
    }
  }
  if (Array.isArray(of.range) && typeof value === "number" && (value < of.range[0] || value > of.range[1])) {
    return "it is between " + of.range[0] + " and " + of.range[1];
  }
  return "";
}

function checkProperties(of) {
  var all = global.properties || {};
  Object.keys(of || {}).forEach(function (name) {
    if (!Object.prototype.hasOwnProperty.call(all, name)) {
      throw new Stop("property", name);
    }
    var why = againstProperty(name, of[name]);
    if (why !== "") {
      throw new Stop("value", "`" + of[name] + "` is no value of the property `" + name + "`: " + why);
    }
  });
}

// Whether the engine posts an operation that the post does not claim, no source states.
function checkClaim(section) {
  [["TYPE_TURNING", "CAPABILITY_TURNING"], ["TYPE_JET", "CAPABILITY_JET"]].forEach(function (one) {
    if (section.getType() === values[one[0]] && global.capabilities > 0 &&
        (global.capabilities & values[one[1]]) === 0) {
      unproven("section " + (section.dotekId + 1) + " is of " + one[0] + ", and `capabilities` lacks " + one[1] +
               ": Fusion may refuse it", one[0]);
    }
  });
}

// A post that replaces a function which the kernel itself calls has it print something else.
var watched = [];
function watch() {
  var kinds = {Array: Array.prototype, String: String.prototype, RegExp: RegExp.prototype, Function: Function.prototype,
    Object: Object.prototype, Number: Number.prototype};
  var names = {Array: ["concat", "every", "filter", "forEach", "indexOf", "join", "map", "pop", "push", "reduce", "reverse",
    "shift", "slice", "some", "sort", "splice"],
  String: ["charAt", "indexOf", "replace", "split", "substring", "toLowerCase", "toUpperCase"],
  RegExp: ["exec", "test"], Function: ["apply", "call"], Object: ["hasOwnProperty", "toString"], Number: ["toFixed"]};
  Object.keys(names).forEach(function (kind) {
    names[kind].forEach(function (name) {
      watched.push({of: kinds[kind], name: name, value: kinds[kind][name], path: kind + ".prototype."});
    });
  });
  [["Math", Math, ["abs", "ceil", "cos", "floor", "max", "min", "sin", "sqrt"]], ["Object", Object, ["defineProperty", "keys"]],
    ["Array", Array, ["isArray"]], ["JSON", JSON, ["stringify"]]].forEach(function (one) {
    one[2].forEach(function (name) {
      watched.push({of: one[1], name: name, value: one[1][name], path: one[0] + "."});
    });
  });
}
// "Array.prototype.push"; "" where all are as they were.
function replaced() {
  for (var i = 0; i < watched.length; ++i) { // without what it looks at
    if (watched[i].of[watched[i].name] !== watched[i].value) {
      return watched[i].path + watched[i].name;
    }
  }
  return "";
}
function replacedFault(name) {
  return "Ethrown\nit replaces `" + name + "`, which Dotek's kernel works with, too\n\n\n\n";
}

