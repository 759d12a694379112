properties = {};
function onOpen() {
}
function onCyclePoint(x, y, z) {
  switch (cycleType) {
  case "probing-x":
    writeln("G65 P9811 X" + x);
    break;
  }
}
