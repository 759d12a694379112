// What posts ask of the engine here and there.
description = "Members";
var spindleAxes = new Table(["X", "Y", "Z"], {force:true});
function onOpen() {
  var range = new Range(3, 5);
  writeWords("range", range[0], range[1]);
  var matrix = new Matrix();
  var list = [];
  for (var i = 0; i < 9; ++i) {
    list.push(matrix.getElement(i / 3, i % 3));
  }
  writeln("matrix " + list.join(" "));
  writeln("turn " + matrix.getTurnAndTilt(0, 2));
  writeWords("quadrants", getQuadrant(0.1), getQuadrant(2), getQuadrant(4), getQuadrant(-0.1));
  machineConfiguration.setAxisX(createAxis({table:true, axis:[1, 0, 0], range:[0, 400]}));
  var modal = createModal({}, createFormat({prefix:"M", decimals:0}));
  writeWords("codes", modal.areDifferent(3, modal.getCurrent()), modal.areDifferent(undefined, undefined));
  writeln(new Template("DPRNT[${key}*${value}${none}]").substitute({key:"START", value:7}));
  writeWords("axes", A, B, C, ABC);
  unwindABC(new Vector(0, 0, 0));
  writeWords("registry", hasRegistryValue("a", "b"), "(" + getEnvironmentVariable("HOME") + ")");
}
function onSection() {
  writeWords("axis", spindleAxes.lookup(spindleAxis));
  writeWords("group", currentSection.checkGroup(STRATEGY_DRILLING), currentSection.hasWellDefinedPosition());
  onExpandedRapid(7, 8, 9);
  onCommand(COMMAND_UNLOCK_MULTI_AXIS);
  onCommand(COMMAND_LOCK_MULTI_AXIS);
}
function onRapid(x, y, z) {
  writeWords("rapid", x, y, z);
}
function onCircular() {
  writeWords("arc", clockwise, radius, fullCircle, helical, chordLength, plane == PLANE_XY);
  writeWords("to", end.x, "around", center.x, "length", createFormat({decimals:3}).format(length));
}
