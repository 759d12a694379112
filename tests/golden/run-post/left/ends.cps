description = "What is left of cycles and of the end";
capabilities = CAPABILITY_MILLING;
function onOpen() {
  for (var i = 0; i < getNumberOfSections(); ++i) {
    var of = getSection(i);
    writeln("T" + of.getTool().number + " ZMIN=" + of.getGlobalZRange().getMinimum() + " ZMAX=" + of.getGlobalZRange().getMaximum());
  }
}
function onSection() {}
function onRapid(x, y, z) { writeln("G0 Z" + z); }
function onLinear(x, y, z) { writeln("G1 Z" + z); }
function onDwell() {}
function onCyclePoint(x, y, z) {
  writeln("from Z" + getCurrentPosition().z);
  if (cycleType == "boring") {
    expandCyclePoint(x, y, z);
  } else {
    writeln("G81 Z" + z);
  }
}
function onClose() { writeln("M30"); }
function onTerminate() { writeln("(too late)"); redirectToFile("notes.txt"); writeln("notes"); closeRedirection(); }
