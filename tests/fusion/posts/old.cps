// A post in the style of the years before 2020, written for the tests.
description = "Old style";
vendor = "Tests";
extension = "nc";
capabilities = CAPABILITY_MILLING;

properties = {
  sequence: true,
  start: 5,
  separate: true
};
propertyDefinitions = {
  sequence: {title: "Numbers", description: "Block numbers.", group: 1, type: "boolean"},
  start: {title: "First", description: "First number.", group: 1, type: "integer"}
};

var gFormat = createFormat({prefix:"G", decimals:0, width:2, zeropad:true});
var mFormat = createFormat({prefix:"M", decimals:0});
var xyzFormat = createFormat({decimals:(unit == MM ? 3 : 4), forceDecimal:true});
var feedFormat = createFormat({decimals:(unit == MM ? 0 : 1), forceDecimal:true});
var angleFormat = createFormat({decimals:3, scale:DEG, forceDecimal:true});
var secFormat = createFormat({decimals:3, forceDecimal:true});

var xOutput = createVariable({prefix:"X"}, xyzFormat);
var yOutput = createVariable({prefix:"Y"}, xyzFormat);
var zOutput = createVariable({prefix:"Z", onchange:function () { moved = true; }}, xyzFormat);
var feedOutput = createVariable({prefix:"F"}, feedFormat);
var iOutput = createReferenceVariable({prefix:"I"}, xyzFormat);
var uOutput = createIncrementalVariable({prefix:"U"}, xyzFormat);
var gMotionModal = createModal({}, gFormat);
var gPlaneModal = createModal({onchange:function () { gMotionModal.reset(); }}, gFormat);
var gRetractModal = createModal({force:true, prefix:"R=", suffix:"!"}, gFormat);

var moved = false;
var sequenceNumber;

function writeBlock() {
  var text = formatWords(arguments);
  if (!text) {
    return;
  }
  if (properties.sequence) {
    writeWords2("N" + sequenceNumber, text);
    sequenceNumber += 5;
  } else {
    writeWords(arguments);
  }
}

function onOpen() {
  sequenceNumber = properties.start;
  if (!properties.separate) {
    setWordSeparator("");
  }
  writeln("%");
  writeBlock(gPlaneModal.format(17), mFormat.format(5));
}

function onSection() {
  var p = getFramePosition(currentSection.getInitialPosition());
  xOutput.reset();
  yOutput.reset();
  zOutput.reset();
  writeBlock(gMotionModal.format(0), xOutput.format(p.x), yOutput.format(p.y), zOutput.format(p.z));
  if (hasParameter("operation-strategy")) {
    writeBlock("(" + getParameter("operation-strategy").toUpperCase() + ")");
  }
}

function onRapid(x, y, z) {
  var words = [xOutput.format(x), yOutput.format(y), zOutput.format(z)];
  if (formatWords(words) !== "") {
    writeBlock(gMotionModal.format(0), words);
  }
}

function onCycle() {
  writeBlock(gPlaneModal.format(17));
}

function onCyclePoint(x, y, z) {
  var depth = z - cycle.depth;
  var size = cycle.width1;
  switch (cycleType) {
  case "probing-x":
  case "probing-y":
    var along = cycleType == "probing-x" ? x : y;
    var to = along + (cycle.approach1 == "positive" ? 1 : -1) * (cycle.probeClearance + tool.diameter / 2);
    writeBlock(gMotionModal.format(1), zOutput.format(depth), feedOutput.format(cycle.feedrate));
    writeBlock(gFormat.format(31), (cycleType == "probing-x" ? "X" : "Y") + xyzFormat.format(to));
    break;
  case "probing-z":
    writeBlock(gRetractModal.format(31), iOutput.format(depth, 0), uOutput.format(depth), uOutput.format(z));
    break;
  case "probing-xy-circular-hole":
  case "probing-xy-circular-boss":
    writeBlock("P" + secFormat.format(size / 7), iOutput.format(0, 0), conditional(moved, "M" + 1));
    writeBlock(angleFormat.format(toRad(cycle.pcdStartingAngle)), xyzFormat.getResultingValue(size / 3));
    break;
  case "probing-xy-rectangular-hole":
    writeBlock(subst("L%1/%2", xyzFormat.format(size), xyzFormat.format(cycle.width2)), [["A1", ""], undefined, "B2"]);
    writeBlock(xOutput.format(x), yOutput.format(y + 0.0004), zOutput.format(z));
    break;
  case "probing-x-plane-angle":
    error(localize("Angles are not measured."));
    return;
  case "probing-xy-pcd-hole":
    validate(cycle.numberOfSubfeatures == 3, "Only three holes.");
    break;
  default:
    cycleNotSupported();
  }
}

function onCycleEnd() {
  writeBlock(gMotionModal.format(0), zOutput.format(cycle.retract));
}

function onClose() {
  writeBlock(mFormat.format(30));
}
