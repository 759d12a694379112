description = "Takes the unit for a number in other ways";
function onOpen() {
  switch (unit) { case 0: writeln("G20"); break; case 1: writeln("G21"); break; }
  writeln(unit > 0 ? "G21" : "G20");
  writeln(["G20", "G21"][unit]);
  writeln("G" + (20 + unit));
  writeln(unit ? "MM" : "IN");
  if (!unit) { writeln("IN"); }
  if (getOutputUnit() == 1) { writeln("MM"); }
  if (unit == MM) { writeln("G21"); }
}
function onCyclePoint() {}
