// A post of the tests that probes a bore.
description = "Bore probe";
capabilities = CAPABILITY_MILLING;

properties = {
  wrongOffset: {title: "An offset that no control has", group: "formats", type: "boolean", value: false, scope: "post"}
};
groupDefinitions = {formats: {title: "Formats", order: 1}};

var lengths = createFormat({decimals: 3, type: FORMAT_REAL});

function writeBlock() {
  writeWords(arguments);
}

function onOpen() {
  writeln("%");
  writeln("O" + programName + " (BORE)");
  writeBlock("G90", "G21", "G17", "G40", "G49", "G80");
}

function onSection() {
  writeBlock(getProperty("wrongOffset") ? "G54.5" : "G54");
  writeBlock("G43", "H" + tool.number);
}

function onRapid(x, y, z) {
  writeBlock("G0", "X" + lengths.format(x), "Y" + lengths.format(y));
  writeBlock("G43", "Z" + lengths.format(z), "H" + tool.number);
}

function onCyclePoint(x, y, z) {
  writeBlock("G65", "P9810", "Z" + lengths.format(z - cycle.depth), "F" + lengths.format(cycle.feedrate));
  measure("D" + lengths.format(cycle.width1), "S1.");
  writeBlock("G65", "P9810", "Z" + lengths.format(cycle.clearance));
}

function measure(diameter, offset) {
  writeBlock("G65", "P9814", diameter, offset);
}

function onClose() {
  writeBlock("M30");
  writeln("%");
}
