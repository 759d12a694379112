function onSection() {
  writeln("G54");
  writeln("T" + tool.number + " M6");
  writeln("S" + tool.spindleRPM + " M3");
}
function onClose() {
  writeln("M30");
}
