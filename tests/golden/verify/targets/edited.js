// side (Surface along X): a probing cycle as a part of a Fusion post. Macros of Renishaw EasyProbe.
// Millimetres.
// minimumRevision: 45811
// Needs of the post: writeBlock(text), which puts the block number before; xOutput, yOutput, zOutput,
// feedOutput, gMotionModal, which are reset behind the macros. Kernel: writeln, error, warning,
// localize, createFormat.
// Dispatch: onCyclePoint(x, y, z) begins with if (side_dispatch(x, y, z)) { return; }
// The operation chooses the cycle with the property dotekCycle. Its point is where the cycle starts,
// in the work system of the operation.

if (properties.dotekCycle === undefined) {
  properties.dotekCycle = {
    title: "Probing cycle",
    description: "Cycle that the operation prints",
    group: "dotek",
    type: "enum",
    values: [{title: "none", id: "none"}],
    value: "none",
    scope: "operation"
  };
}
properties.dotekCycle.values.push({title: "Surface along X", id: "side"});
properties.side_X = {
  title: "side: X",
  description: "Travel to the face, with its sign",
  group: "side",
  type: "number",
  value: 12,
  scope: "operation"
};
properties.side_I = {
  title: "side: I",
  description: "Coordinate that the face shall get",
  group: "side",
  type: "number",
  value: 0,
  scope: "operation"
};
properties.side_G = {
  title: "side: G",
  description: "Work offset to set, 54 to 59",
  group: "side",
  type: "integer",
  value: 55,
  scope: "operation"
};
properties.side_Z = {
  title: "side: Z",
  description: "Depth of the touch",
  group: "side",
  type: "number",
  value: -5,
  scope: "operation"
};
properties.side_R = {
  title: "side: R",
  description: "Height to retract to",
  group: "side",
  type: "number",
  value: 40,
  scope: "operation"
};

function side_isNumber(value) {
  return typeof value === "number" && isFinite(value);
}

// Digits of |value| in units of the last of `places` decimals, "" for 0: half away from zero on the
// shortest decimal text, to a multiple of `step`.
function side_units(value, places, step) {
  var parts = String(Math.abs(value)).split("e");
  var mantissa = parts[0].split(".");
  var digits = mantissa[0] + (mantissa.length > 1 ? mantissa[1] : "");
  var keep = mantissa[0].length + (parts.length > 1 ? Number(parts[1]) : 0) + places;
  while (digits.length <= keep) {
    digits += "0";
  }
  var units = keep > 0 ? digits.substring(0, keep).split("") : [];
  var half = keep >= 0 && digits.charAt(keep) >= "5";
  var rest = 0;
  var i;
  for (i = 0; i < units.length; ++i) {
    rest = (rest * 10 + Number(units[i])) % step;
  }
  var carry = (2 * rest >= step || (2 * rest + 1 === step && half) ? step : 0) - rest;
  for (i = units.length - 1; carry !== 0 && i >= 0; --i) {
    var sum = Number(units[i]) + carry;
    var digit = ((sum % 10) + 10) % 10;
    units[i] = String(digit);
    carry = (sum - digit) / 10;
  }
  return ((carry > 0 ? String(carry) : "") + units.join("")).replace(/^0+/, "");
}

// Text of the value in a number picture, `body;zero;step`; null where it does not fit.
function side_picture(picture, value) {
  var parts = picture.split(";");
  var body = parts[0];
  var point = body.search(/[.^]/);
  var places = point < 0 ? body : body.substring(0, point);
  var decimals = point < 0 ? "" : body.substring(point + 1);
  var units = side_units(value, decimals.length, parts.length > 2 ? Number(parts[2]) : 1);
  var sign = value < 0 && units !== "" ? "-" : "";
  if (units.length - decimals.length > places.length) {
    return null;
  }
  if (units === "" && (parts.length > 1 || body.indexOf("0") < 0)) {
    return parts.length > 1 ? parts[1] : "";
  }
  while (units.length < decimals.length) {
    units = "0" + units;
  }
  var whole = units.substring(0, units.length - decimals.length);
  var fraction = units.substring(units.length - decimals.length).replace(/0+$/, "");
  var shown = places.indexOf("0") < 0 ? 0 : places.length - places.indexOf("0");
  while (whole.length < shown) {
    whole = "0" + whole;
  }
  while (fraction.length < decimals.lastIndexOf("0") + 1) {
    fraction += "0";
  }
  if (point >= 0 && body.charAt(point) === "^" && whole === "") {
    var drop = decimals.indexOf("0") < 0 ? fraction.length : Math.min(decimals.indexOf("0"), fraction.length);
    while (drop > 0 && fraction.charAt(0) === "0") {
      fraction = fraction.substring(1);
      --drop;
    }
  }
  return sign + whole + (point >= 0 && body.charAt(point) === "." ? "." : "") + fraction;
}

// The number that the picture prints for the value.
function side_shown(picture, value) {
  var parts = picture.split(";");
  var point = parts[0].search(/[.^]/);
  var decimals = point < 0 ? 0 : parts[0].length - point - 1;
  var units = side_units(value, decimals, parts.length > 2 ? Number(parts[2]) : 1);
  return Number((value < 0 ? "-0" : "0") + units + "e-" + decimals);
}

// Tells where what is printed is another value than the one given.
function side_warnOfDigits(name, value, printed) {
  if (Math.abs(value - printed) > 1e-9) {
    warning(name + ": " + value + " has more digits than are printed; the machine gets " + printed);
  }
}

// Checks the fields, then prints the blocks of the cycle.
function side_write(x, y, z) {
  var X = currentSection.getProperty("side_X");
  var I = currentSection.getProperty("side_I");
  var G = currentSection.getProperty("side_G");
  var Z = currentSection.getProperty("side_Z");
  var R = currentSection.getProperty("side_R");
  var toolRadius = tool.diameter / 2;
  var clearance = cycle.clearance;
  if (unit !== MM) {
    error(localize("side: the cycle is written in millimetres, the document is not"));
    return;
  }
  if (!side_isNumber(X)) {
    error(localize("side: X is no number"));
    return;
  }
  if (!side_isNumber(I)) {
    error(localize("side: I is no number"));
    return;
  }
  if (!side_isNumber(G)) {
    error(localize("side: G is no number"));
    return;
  }
  if (G % 1 !== 0) {
    error(localize("side: G is no whole number"));
    return;
  }
  if (!side_isNumber(Z)) {
    error(localize("side: Z is no number"));
    return;
  }
  if (!side_isNumber(R)) {
    error(localize("side: R is no number"));
    return;
  }
  if (!side_isNumber(toolRadius)) {
    error(localize("side: tool.diameter / 2 is no number"));
    return;
  }
  if (toolRadius <= 0) {
    error(localize("side: tool.diameter / 2 is not above 0"));
    return;
  }
  if (!side_isNumber(clearance)) {
    error(localize("side: cycle.clearance is no number"));
    return;
  }
  var wrong;
  wrong = 0;
  if (G < 54) {
    wrong = 1;
  }
  if (G > 59) {
    wrong = 1;
  }
  if (Math.abs(X) <= toolRadius) {
    wrong = 2;
  }
  if (R <= Z) {
    wrong = 3;
  }
  if (wrong === 1) {
    error(localize("The work offset is 54 to 59"));
    return;
  }
  if (wrong === 2) {
    error(localize("The travel is not longer than the radius of the ball"));
    return;
  }
  if (wrong === 3) {
    error(localize("The retract height lies below the touch"));
    return;
  }
  var clearanceText = side_picture("###.##;0", clearance);
  if (clearanceText === null) {
    error(localize("side: clearance does not fit ###.##;0"));
    return;
  }
  side_warnOfDigits("clearance", clearance, side_shown("###.##;0", clearance));
  var ZText = side_picture("####.##;0", Z);
  if (ZText === null) {
    error(localize("side: Z does not fit ####.##;0"));
    return;
  }
  side_warnOfDigits("Z", Z, side_shown("####.##;0", Z));
  var GText = side_picture("####.##;0", G);
  if (GText === null) {
    error(localize("side: G does not fit ####.##;0"));
    return;
  }
  side_warnOfDigits("G", G, side_shown("####.##;0", G));
  var XText = side_picture("####.##;0", X);
  if (XText === null) {
    error(localize("side: X does not fit ####.##;0"));
    return;
  }
  side_warnOfDigits("X", X, side_shown("####.##;0", X));
  var IText = side_picture("####.##;0", I);
  if (IText === null) {
    error(localize("side: I does not fit ####.##;0"));
    return;
  }
  side_warnOfDigits("I", I, side_shown("####.##;0", I));
  var RText = side_picture("####.##;0", R);
  if (RText === null) {
    error(localize("side: R does not fit ####.##;0"));
    return;
  }
  side_warnOfDigits("R", R, side_shown("####.##;0", R));
  writeBlock("M5");
  writeBlock("M9");
  writeBlock("M32");
  writeBlock("G65 P9770 Z" + clearanceText + " F3000");
  writeBlock("G65 P9770 Z" + ZText + " F500");
  writeBlock("G65 P9023 S" + GText + " X" + XText + " I" + IText);
  writeBlock("G65 P9770 Z" + RText + " F3000");
  writeBlock("M32");
  xOutput.reset();
  yOutput.reset();
  zOutput.reset();
  feedOutput.reset();
  gMotionModal.reset();
}

// true: the operation is this cycle, and its blocks are printed.
function side_dispatch(x, y, z) {
  switch (currentSection.getProperty("dotekCycle")) {
  case "side":
    side_write(x, y, z);
    return true;
  default:
    return false;
  }
}
