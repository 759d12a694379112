description = "Takes the refusal of the engine";
function onCyclePoint(x, y, z) {
  try {
    expandCyclePoint(x, y, z);
  } catch (e) {
    writeln("(nothing is done)");
  }
}
