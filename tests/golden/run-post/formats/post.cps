// Each line of the table of formats of shared/reference, and the values that a real program shows.
function show(title, specifiers, value) {
  writeln(title + ": " + createFormat(specifiers).format(value));
}
function onOpen() {
  show("trim false, forceSign", {decimals:3, trim:false, forceSign:true}, 4.5);
  show("forceSign", {decimals:3, forceSign:true}, 4.5);
  show("prefix, zeropad", {prefix:"T", decimals:0, zeropad:true, width:2}, 7);
  show("degrees", {decimals:3, forceSign:true, forceDecimal:true, scale:DEG}, Math.PI);
  show("scale", {decimals:4, scale:10000}, 1.23);
  var three = createFormat({decimals:3});
  writeln("areDifferent: " + three.areDifferent(9.123, 9.1234));
  writeln("getMinimumValue: " + three.getMinimumValue());
  writeln("getError: " + three.getError(4.5005).toFixed(4));
  writeln("getResultingValue: " + three.getResultingValue(3.1234));
  writeln("isSignificant: " + three.isSignificant(0.0005) + " " + three.isSignificant(0.00049));
  [80, 0.57, 0, 30.762500762939453, 30.862499237, -0.0004].forEach(function (value) {
    show(String(value), {decimals:3, forceDecimal:true}, value);
  });
  show("feed", {prefix:"F", decimals:0, forceDecimal:true}, 499.99899);
  show("feed", {prefix:"F", decimals:0, forceDecimal:true}, 1000.00055);
  show("code", {prefix:"G", decimals:0, zeropad:true, width:2}, 0);
  show("code", {prefix:"G", decimals:1}, 54.4);
  show("new style", {decimals:3, type:FORMAT_REAL, minDigitsRight:2}, 1.5);
  show("new style, whole", {type:FORMAT_INTEGER, minDigitsLeft:4}, 42);
  show("offset", {prefix:"S", decimals:0, forceDecimal:true, offset:100}, 3);
  var x = createVariable({prefix:"X"}, three);
  writeln("variable: " + [x.format(4.5), x.format(4.5001), (x.reset(), x.format(4.5)), (x.disable(), x.format(9))].join("|"));
  var g = createModal({prefix:"G1=", suffix:"*"}, createFormat({prefix:"G", decimals:0, zeropad:true, width:2}));
  writeln("modal: " + g.format(1) + "|" + g.format(1));
  var i = createReferenceVariable({prefix:"I"}, three);
  writeln("reference: " + i.format(0, 0) + "|" + i.format(2, 0));
  var u = createIncrementalVariable({prefix:"U"}, three);
  writeln("incremental: " + [u.format(5), u.format(5), u.format(3)].join("|"));
  var k = createOutputVariable({prefix:"K", control:CONTROL_NONZERO}, three);
  writeln("nonzero: " + k.format(0) + "|" + k.format(2) + "|" + k.format(2));
  var changes = 0;
  var z = createVariable({prefix:"Z", onchange:function () { ++changes; }}, three);
  z.format(1);
  z.format(1);
  z.format(2);
  writeln("onchange: " + changes);
  var group = createModalGroup({strict:false}, [[0, 1, 2, 3], [17, 18, 19]], createFormat({prefix:"G", decimals:0}));
  writeWords([group.format(0), group.format(17)], "", undefined, ["X1", ["Y2"]]);
  writeWords2("N10", group.format(0), group.format(17));
  writeWords2("N20", group.format(1));
  setWordSeparator("");
  writeWords("G1", "X5");
  show("a turn in radians", {decimals:3, scale:DEG, cyclicLimit:2 * Math.PI}, Math.PI * 2.5);
  show("a turn in radians, positive", {decimals:3, scale:DEG, cyclicLimit:2 * Math.PI, cyclicSign:1}, -Math.PI / 2);
  show("beyond its maximum", {decimals:1, minimum:0, maximum:10}, 12);
  writeln("error " + createFormat({decimals:3}).getError(4.5005));
  writeln(subst("%1 of %2", 3, "four") + conditional(false, "no"));
}
