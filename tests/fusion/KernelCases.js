// What the kernel's double has to print: results that are documented or were seen in text of the real engine.
// kernelCases() gives "N cases" and a line for each that differs.

function kernelCases() {
  var count = 0;
  var wrong = [];
  function is(name, found, wanted) {
    ++count;
    if (found !== wanted) {
      wrong.push(name + ": " + found + " instead of " + wanted);
    }
  }
  function formats(name, specifiers, value, wanted) {
    is(name, createFormat(specifiers).format(value), wanted);
  }
  function near(name, found, wanted) {
    ++count;
    if (!(Math.abs(found - wanted) < 1e-9)) {
      wrong.push(name + ": " + found + " instead of " + wanted);
    }
  }

  // Documented.
  formats("sign and all decimals", {decimals: 3, trim: false, forceSign: true}, 4.5, "+4.500");
  formats("sign", {decimals: 3, forceSign: true}, 4.5, "+4.5");
  formats("prefix and width", {prefix: "T", decimals: 0, zeropad: true, width: 2}, 7, "T07");
  formats("degrees", {decimals: 3, forceSign: true, forceDecimal: true, scale: DEG}, Math.PI, "+180.");
  formats("scale", {decimals: 4, scale: 10000}, 1.23, "12300");
  var three = createFormat({decimals: 3});
  is("prints alike", three.areDifferent(9.123, 9.1234), false);
  is("prints another text", three.areDifferent(9.123, 9.1244), true);
  near("smallest value", three.getMinimumValue(), 0.001);
  near("error", three.getError(4.5005), -0.0005);
  near("resulting value", three.getResultingValue(3.1234), 3.123);
  is("half of the last place counts", three.isSignificant(0.0005), true);
  is("less does not", three.isSignificant(0.00049), false);

  // Seen in text of the real engine.
  var coordinate = {decimals: 3, forceDecimal: true};
  formats("whole", coordinate, 80, "80.");
  formats("leading zero", coordinate, 0.57, "0.57");
  formats("zero", coordinate, 0, "0.");
  formats("float up", coordinate, 30.762500762939453, "30.763");
  formats("float down", coordinate, 30.862499237, "30.862");
  formats("feed", {prefix: "F", decimals: 0, forceDecimal: true}, 499.99899, "F500.");
  formats("feed just above", {prefix: "F", decimals: 0, forceDecimal: true}, 1000.00055, "F1000.");
  formats("two digits", {prefix: "G", decimals: 0, zeropad: true, width: 2}, 0, "G00");
  formats("one decimal", {prefix: "G", decimals: 1}, 54.4, "G54.4");
  formats("no minus before zero", coordinate, -0.0004, "0.");

  // Specifiers, one each.
  formats("six decimals unless said", {}, 1 / 3, "0.333333");
  formats("negative", coordinate, -5, "-5.");
  formats("negative, rounded", coordinate, -1.23456, "-1.235");
  formats("no leading zero", {decimals: 3, trimLeadZero: true}, 0.5, ".5");
  formats("no leading zero, negative", {decimals: 3, trimLeadZero: true}, -0.5, "-.5");
  formats("decimal symbol", {decimals: 2, separator: ","}, 1.25, "1,25");
  formats("width without padding", {decimals: 0, width: 4}, 7, "7");
  formats("width with a sign", {decimals: 0, zeropad: true, width: 3}, -7, "-007");
  formats("offset", {prefix: "S", decimals: 0, forceDecimal: true, offset: 100}, 3, "S103.");
  formats("suffix", {decimals: 0, suffix: "*"}, 1, "1*");
  formats("one turn", {decimals: 1, cyclicLimit: 360}, 370, "10");
  formats("one turn, positive", {decimals: 1, cyclicLimit: 360, cyclicSign: 1}, -10, "350");
  formats("one turn, negative", {decimals: 1, cyclicLimit: 360, cyclicSign: -1}, 10, "-350");
  formats("unknown specifiers do nothing", {decimals: 1, nonsense: 4}, 1.25, "1.3");
  is("inherits", createFormat({inherit: createFormat({prefix: "X", decimals: 1}), decimals: 2}).format(1.234), "X1.23");
  formats("integer", {type: FORMAT_INTEGER}, 3.7, "4");
  formats("integer with digits", {type: FORMAT_INTEGER, minDigitsLeft: 4}, 12, "0012");
  formats("real", {type: FORMAT_REAL, decimals: 3}, 80, "80.");
  formats("real with digits", {type: FORMAT_REAL, decimals: 4, minDigitsRight: 2}, 80, "80.00");
  formats("leading zeros suppressed", {type: FORMAT_LZS, decimals: 3}, 1.5, "1500");
  formats("trailing zeros suppressed", {type: FORMAT_TZS, decimals: 3, }, 1.5, "15");
  var changed = createFormat({decimals: 3});
  changed.setNumberOfDecimals(1);
  changed.setPrefix("Y");
  is("setters", changed.format(2.26), "Y2.3");
  is("getters", changed.getNumberOfDecimals() + changed.getPrefix(), "1Y");

  // When a word is printed.
  var x = createVariable({prefix: "X"}, createFormat({decimals: 3}));
  is("first", x.format(4.5), "X4.5");
  is("again", x.format(4.5), "");
  is("prints alike, so nothing", x.format(4.50004), "");
  x.reset();
  is("after reset", x.format(4.5), "X4.5");
  x.disable();
  is("disabled", x.format(9), "");
  is("disabled, still stored", x.getCurrent(), 9);
  x.reset();
  is("reset enables nothing", x.format(8), "");
  is("no enable for an old variable", typeof x.enable, "undefined");
  is("forced", (function () {
    var v = createVariable({prefix: "K", force: true}, three);
    return v.format(1) + v.format(1);
  }()), "K1K1");
  var fired = 0;
  var heard = createVariable({prefix: "Z", onchange: function () {
    ++fired;
  }}, three);
  heard.format(1);
  heard.format(1);
  heard.format(2);
  is("onchange where text is made", fired, 2);
  var deaf = 0;
  createVariable({prefix: "Z", onChange: function () {
    ++deaf;
  }}, three).format(1);
  is("onChange is no specifier", deaf, 0);
  var g = createModal({}, createFormat({prefix: "G", decimals: 0}));
  is("modal", g.format(1) + g.format(1) + g.format(0), "G1G0");
  var own = createModal({prefix: "G1=", suffix: "*"}, createFormat({prefix: "G", decimals: 0, zeropad: true, width: 2}));
  is("modal with its own prefix", own.format(1), "G1=01*");
  var always = createModal({force: true}, createFormat({prefix: "G", decimals: 0}));
  is("modal, forced", always.format(1) + always.format(1), "G1G1");
  var scaled = createVariable({prefix: "X"}, createFormat({decimals: 1, scale: 2}));
  is("compares what is printed", scaled.format(1) + scaled.format(1.02), "X2");
  var i = createReferenceVariable({prefix: "I"}, three);
  is("reference", i.format(0, 0) + i.format(2, 0) + i.format(2, 0), "I2I2");
  var step = createIncrementalVariable({prefix: "U"}, three);
  is("increments", step.format(2) + step.format(5) + step.format(5), "U2U3");
  var group = createModalGroup({strict: true}, [[0, 1, 2], [17, 18]], createFormat({prefix: "G", decimals: 0}));
  is("modal group", group.format(0) + group.format(17) + group.format(0) + group.format(1) + group.format(0), "G0G17G1G0");
  is("modal group, unknown code", (function () {
    try {
      group.format(99);
      return "nothing";
    } catch (refused) {
      return "refused";
    }
  }()), "refused");
  var out = createOutputVariable({prefix: "X"}, three);
  is("output", out.format(1) + out.format(1) + out.format(2), "X1X2");
  out.disable();
  is("output, disabled", out.format(3), "");
  out.enable();
  is("output, enabled", out.format(4), "X4");
  var forced = createOutputVariable({prefix: "X", control: CONTROL_FORCE}, three);
  is("output, forced", forced.format(1) + forced.format(1), "X1X1");
  var present = createOutputVariable({prefix: "I", control: CONTROL_NONZERO}, three);
  is("output, where not zero", present.format(0) + present.format(2) + present.format(2), "I2I2");
  var moves = createOutputVariable({prefix: "X", type: TYPE_INCREMENTAL}, three);
  is("output, increments", moves.format(2) + moves.format(5) + moves.format(5), "X2X3");
  var known = createOutputVariable({prefix: "X", current: 5}, three);
  is("output, with a value to begin with", known.format(5) + known.format(6), "X6");
  known.setCurrent(7);
  is("output, value put in", known.format(7), "");

  // Text.
  is("words", formatWords("G1", "", undefined, ["X1", ["Y2"]], (function () {
    return arguments;
  }("Z3"))), "G1 X1 Y2 Z3");
  is("conditional", conditional(true, "A") + conditional(false, "B"), "A");
  is("subst", subst("%1 and %2, %1", "a", "b"), "a and b, a");
  dotekState.text = "";
  writeWords("", undefined);
  writeWords2("N10", "");
  is("no words, no line", dotekState.text, "");
  writeWords2("N10", "G1", "X1");
  is("number and words", dotekState.text, "N10 G1 X1\n");
  setWordSeparator("");
  writeWords("G1", "X1");
  is("separator", dotekState.text, "N10 G1 X1\nG1X1\n");
  is("inch by the rule of defaults", spatial(1, IN), 25);
  is("inch", toPreciseUnit(1, IN), 25.4);
  return count + " cases\n" + wrong.join("\n");
}
