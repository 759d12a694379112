description = "Only its end is printed";
function onCyclePoint(x, y, z) {
}
function onCycleEnd() {
  writeln("G80");
}
