function onSection() {
  writeln("G54");
  writeln("T" + tool.number + " M6");
  writeln("M3");
}
function onClose() {
  writeln("M30");
}
