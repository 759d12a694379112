// Entries that are given to a name, one line with a function within, and calls nested deeper than a trace of the engine.
description = "arrows"; vendor = "own"; extension = "nc"; capabilities = CAPABILITY_MILLING;
const words = (...all) => writeWords(all);
function d1(t) { d2(t); } function d2(t) { d3(t); } function d3(t) { d4(t); } function d4(t) { d5(t); } function d5(t) { d6(t); }
function d6(t) { d7(t); } function d7(t) { d8(t); } function d8(t) { d9(t); } function d9(t) { d10(t); } function d10(t) { words("G65", t); }
const onSection = () => { writeWords("G54"); };
onCyclePoint = (x, y, z) => { ["P9811", cycleType].forEach(t => d1(t)); };
const onCycleEnd = function () { writeWords("G80"); };
function onRapid() {}
