description = "Has few functions";
capabilities = CAPABILITY_MILLING;
function onSection() { writeln("G54"); }
function onRapid(x, y, z) { writeln("G0 X" + x); }
