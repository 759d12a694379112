function onCyclePoint(x, y, z) {
  writeln("X" + cycle.missing.value);
}
