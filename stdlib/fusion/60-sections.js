// ---- tools and sections -------------------------------------------------------------------------------------------

var TOOL_LENGTHS = ["diameter", "cornerRadius", "bodyLength", "fluteLength", "overallLength", "shoulderLength",
  "shaftDiameter", "holderLength", "holderDiameter", "tipDiameter", "threadPitch"];

function Tool(given) {
  var standard = {number: 1, diameter: 6, type: values.TOOL_PROBE, cornerRadius: 0, taperAngle: 0, bodyLength: 50,
    fluteLength: 20, overallLength: 100, shoulderLength: 25, shaftDiameter: 6, holderLength: 30, holderDiameter: 40,
    tipDiameter: 0, threadPitch: 0, numberOfFlutes: 2, clockwise: true, coolant: values.COOLANT_OFF, coolantMode: 0,
    comment: "", description: "", vendor: "", productId: "", lengthOffset: undefined, diameterOffset: undefined,
    spindleRPM: 1000, rampingSpindleRPM: 1000, spindleMode: values.SPINDLE_CONSTANT_SPINDLE_SPEED, surfaceSpeed: 0,
    maximumSpindleSpeed: 0, manualToolChange: false, breakControl: false, liveTool: true, turret: 0, jetTool: false,
    compensationOffset: undefined, material: values.MATERIAL_UNSPECIFIED, toolId: "", holder: undefined, unit: 0,
    isJetTool: undefined, kerfWidth: 0, jetDiameter: 0, nozzleDiameter: 0, cutPower: 0, piercePower: 0,
    noseRadius: 0, boringBarOrientation: 0};
  for (var name in standard) {
    this[name] = standard[name];
  }
  for (name in given) {
    this[name] = TOOL_LENGTHS.indexOf(name) < 0 ? given[name] : rounded(given[name]);
  }
  ["type", "coolant", "material", "spindleMode"].forEach(function (member) {
    if (typeof this[member] === "string") {
      if (values[this[member]] === undefined) {
        throw sourceError("tool: `" + this[member] + "` is no constant of the kernel");
      }
      this[member] = values[this[member]];
    }
  }, this);
  this.lengthOffset = this.lengthOffset === undefined ? this.number : this.lengthOffset;
  this.diameterOffset = this.diameterOffset === undefined ? this.number : this.diameterOffset;
  this.compensationOffset = this.compensationOffset === undefined ? this.number : this.compensationOffset;
  this.isJetTool = function () { return this.jetTool; };
  this.shaft = {hasSections: function () { return false; }, getNumberOfSections: function () { return 0; }};
  this.holder = {hasSections: function () { return false; }, getNumberOfSections: function () { return 0; }};
}
(function () {
  var all = ["number", "diameter", "type", "cornerRadius", "taperAngle", "bodyLength", "fluteLength", "overallLength",
    "shoulderLength", "shaftDiameter", "holderLength", "holderDiameter", "tipDiameter", "threadPitch", "numberOfFlutes",
    "clockwise", "coolant", "comment", "description", "vendor", "productId", "lengthOffset", "diameterOffset",
    "spindleRPM", "manualToolChange", "breakControl", "turret", "material", "toolId", "spindleMode",
    "compensationOffset", "maximumSpindleSpeed", "surfaceSpeed"];
  all.forEach(function (name) {
    var title = name.charAt(0).toUpperCase() + name.substring(1);
    Tool.prototype["get" + title] = function () { return this[name]; };
  });
}());
Tool.prototype.getTipDiameter = function () { return this.tipDiameter; };
Tool.prototype.isTurningTool = function () {
  return nameOfConstant("TOOL_", this.type).indexOf("TOOL_TURNING_") === 0;
};
Tool.prototype.isLiveTool = function () { return this.liveTool; };
Tool.prototype.isDrill = function () {
  return [values.TOOL_DRILL, values.TOOL_DRILL_CENTER, values.TOOL_DRILL_SPOT].indexOf(this.type) >= 0;
};
Tool.prototype.getTappingFeedrate = function () { return this.threadPitch * this.spindleRPM; };

function vectorOf(list, round) {
  if (list === undefined) {
    return new Vector();
  }
  return round ? new Vector(rounded(list[0]), rounded(list[1]), rounded(list[2])) : new Vector(list[0], list[1], list[2]);
}

function Section(given, id) {
  this.dotek = given;
  this.dotekId = id;
  this.dotekTool = new Tool(given.tool || {});
  this.dotekRecords = given.records || [];
  this.workOffset = given.workOffset === undefined ? 1 : given.workOffset;
  this.probeWorkOffset = given.probeWorkOffset === undefined ? this.workOffset : given.probeWorkOffset;
  this.wcs = given.wcs === undefined ? "G" + (53 + (this.workOffset || 1)) : given.wcs;
  this.wcsIndex = this.workOffset;
  this.workOrigin = vectorOf(given.workOrigin);
  this.workPlane = given.workPlane === undefined ? new Matrix()
    : matrixOf(given.workPlane);
  this.wcsOrigin = this.workOrigin;
  this.wcsPlane = this.workPlane;
  this.strategy = given.strategy === undefined ? "" : given.strategy;
  this.type = given.type === undefined ? values.TYPE_MILLING : values[given.type];
  this.unit = global.unit;
  this.channel = 0;
  this.quality = given.quality || 0;
  this.jetMode = given.jetMode || values.JET_MODE_THROUGH;
  this.feedMode = values[given.feedMode || "FEED_PER_MINUTE"];
  this.spindle = values[given.spindle || "SPINDLE_PRIMARY"];
  this.tailstock = given.tailstock === true;
  this.partCatcher = given.partCatcher === true;
  this.dynamicWorkOffset = 0;
  this.polarMode = values.POLAR_MODE_OFF;
  this.dotekParameters = given.parameters || {};
  var points = [];
  var depths = []; // beside them, where holes end: headers of programs name the lowest Z of each tool
  this.dotekRecords.forEach(function (record) {
    if (record.to !== undefined) {
      points.push(vectorOf(record.to, true));
    }
    (record.points || []).forEach(function (point) {
      var height = record.cycle && record.cycle.clearance !== undefined ? record.cycle.clearance : point[2];
      points.push(vectorOf([point[0], point[1], height], true));
      var bottom = record.cycle && typeof record.cycle.bottom === "number" ? Math.min(record.cycle.bottom, point[2]) : point[2];
      depths.push(vectorOf([point[0], point[1], bottom], true));
    });
  });
  this.dotekPoints = points;
  this.dotekReach = points.concat(depths);
}
function matrixOf(list) {
  var out = new Matrix();
  for (var i = 0; i < 9; ++i) {
    out.rows[Math.floor(i / 3)][i % 3] = list[i];
  }
  return out;
}
Section.prototype.getId = function () { return this.dotekId; };
Section.prototype.getTool = function () { return this.dotekTool; };
Section.prototype.getParameter = function (name, otherwise) {
  return this.hasParameter(name) ? this.dotekParameters[name] : otherwise;
};
Section.prototype.hasParameter = function (name) {
  return Object.prototype.hasOwnProperty.call(this.dotekParameters, name);
};
Section.prototype.getProperty = function (name, otherwise) {
  var own = this.dotek.properties || {};
  var key = typeof name === "object" ? nameOfProperty(name) : name;
  return Object.prototype.hasOwnProperty.call(own, key) ? own[key] : getProperty(name, otherwise);
};
Section.prototype.getInitialPosition = function () {
  return this.dotek.initial ? vectorOf(this.dotek.initial, true) : this.dotekPoints[0] || new Vector();
};
Section.prototype.getFirstPosition = Section.prototype.getInitialPosition;
Section.prototype.hasWellDefinedPosition = function () { return this.dotekPoints.length > 0 || Boolean(this.dotek.initial); };
Section.prototype.getFinalPosition = function () {
  return this.dotekPoints[this.dotekPoints.length - 1] || this.getInitialPosition();
};
Section.prototype.dotekRange = function (axis) {
  var all = this.dotekReach.map(function (point) { return point[axis]; });
  return all.length === 0 ? new Range(0, 0) : new Range(Math.min.apply(Math, all), Math.max.apply(Math, all));
};
Section.prototype.getGlobalZRange = function () { return this.dotekRange("z"); };
Section.prototype.getGlobalXRange = function () { return this.dotekRange("x"); };
Section.prototype.getGlobalYRange = function () { return this.dotekRange("y"); };
Section.prototype.getZRange = Section.prototype.getGlobalZRange;
Section.prototype.getOptimizedZRange = Section.prototype.getGlobalZRange;
Section.prototype.getBoundingBox = function () {
  var x = this.dotekRange("x");
  var y = this.dotekRange("y");
  var z = this.dotekRange("z");
  return new BoundingBox(new Vector(x.minimum, y.minimum, z.minimum), new Vector(x.maximum, y.maximum, z.maximum));
};
Section.prototype.getGlobalBoundingBox = Section.prototype.getBoundingBox;
Section.prototype.getGlobalRange = function (direction) {
  var all = this.dotekReach.map(function (point) { return Vector.dot(point, direction); });
  return all.length === 0 ? new Range(0, 0) : new Range(Math.min.apply(Math, all), Math.max.apply(Math, all));
};
function cyclesOf(section) {
  return section.dotekRecords.filter(function (record) { return record.record === "cycle"; });
}
Section.prototype.getNumberOfCycles = function () { return cyclesOf(this).length; };
Section.prototype.getNumberOfCyclePoints = function () {
  return cyclesOf(this).reduce(function (sum, record) { return sum + record.points.length; }, 0);
};
Section.prototype.getFirstCycle = function () {
  var all = cyclesOf(this);
  return all.length === 0 ? "" : all[0].type;
};
Section.prototype.hasAnyCycle = function () { return cyclesOf(this).length > 0; };
Section.prototype.hasCycle = function (type) {
  return cyclesOf(this).some(function (record) { return record.type === type; });
};
Section.prototype.doesStrictCycle = function (type) {
  var all = cyclesOf(this);
  return all.length > 0 && all.every(function (record) { return record.type === type; });
};
Section.prototype.hasWellKnownCycle = Section.prototype.hasAnyCycle;
Section.prototype.getMovements = function () {
  var bits = 0;
  this.dotekRecords.forEach(function (record) {
    if (record.record === "movement") {
      bits |= 1 << movementOf(record.movement);
    }
  });
  return bits || 1 << values.MOVEMENT_CUTTING;
};
Section.prototype.hasMovement = function (movement) { return (this.getMovements() & (1 << movement)) !== 0; };
Section.prototype.getMaximumSpindleSpeed = function () { return this.dotekTool.spindleRPM; };
Section.prototype.getInitialSpindleSpeed = Section.prototype.getMaximumSpindleSpeed;
Section.prototype.getFinalSpindleSpeed = Section.prototype.getMaximumSpindleSpeed;
Section.prototype.getInitialSpindleOn = function () { return this.dotekTool.type !== values.TOOL_PROBE; };
Section.prototype.getMaximumFeedrate = function () {
  return this.dotekRecords.reduce(function (most, record) { return Math.max(most, record.feed || 0); }, 0);
};
["getCycleTime", "getCuttingDistance", "getCuttingTime", "getRapidDistance", "getRapidTime", "getAirDistance"].forEach(
  function (name) {
    Section.prototype[name] = function () { return 0; };
  });
Section.prototype.getGlobalInitialToolAxis = function () { return this.workPlane.forward; };
Section.prototype.getGlobalFinalToolAxis = Section.prototype.getGlobalInitialToolAxis;
Section.prototype.getInitialToolAxis = function () { return new Vector(0, 0, 1); };
Section.prototype.getFinalToolAxis = Section.prototype.getInitialToolAxis;
["getInitialToolAxisABC", "getFinalToolAxisABC", "getInitialABC", "getFinalABC"].forEach(function (name) {
  Section.prototype[name] = function () { return new Vector(); };
});
Section.prototype.getABCByPreference = function (configuration, plane) { return configuration.getABC(plane); };
["optimizeMachineAnglesByMachine", "optimize3DPositionsByMachine", "setPolarMode", "activatePolarMode",
  "deactivatePolarMode"].forEach(function (name) {
  Section.prototype[name] = function () {};
});
Section.prototype.isMultiAxis = function () { return this.dotek.multiAxis === true; };
Section.prototype.is3D = function () { return !this.isMultiAxis(); };
["isOptimizedForMachine", "isZOriented", "isXOriented", "isYOriented", "isPatterned", "isConnectionSection",
  "isMirrored", "isAxialCenterDrilling", "isCuttingMotionAwayFromRotary", "hasDynamicWorkOffset", "hasToolPreload"].forEach(
  function (name) {
    Section.prototype[name] = function () { return name === "isZOriented" && this.workPlane.isIdentity(); };
  });
Section.prototype.isOptional = function () { return this.dotek.optional === true; };
Section.prototype.getForceToolChange = function () { return this.dotek.forceToolChange === true; };
Section.prototype.isMilling = function () { return this.type === values.TYPE_MILLING; };
Section.prototype.isTurning = function () { return this.type === values.TYPE_TURNING; };
Section.prototype.isJet = function () { return this.type === values.TYPE_JET; };
Section.prototype.getPatternId = function () { return this.dotekId; };
Section.prototype.getInternalPatternId = function () { return 0; };
Section.prototype.getOptimizedTCPMode = function () { return 0; };
Section.prototype.getPolarMode = function () { return this.polarMode; };
Section.prototype.getPolarDirection = function () { return new Vector(1, 0, 0); };
Section.prototype.getModelOrigin = function () { return this.workOrigin; };
Section.prototype.getModelPlane = function () { return this.workPlane; };
Section.prototype.getGlobalWorkPlane = function () { return this.workPlane; };
Section.prototype.getGlobalWorkOrigin = function () { return this.workOrigin; };
Section.prototype.getDynamicWCSOrigin = function () { return this.workOrigin; };
Section.prototype.getDynamicWCSPlane = function () { return this.workPlane; };
Section.prototype.getFCSOrigin = function () { return this.workOrigin; };
Section.prototype.getFCSPlane = function () { return this.workPlane; };
Section.prototype.getDynamicWorkOffset = function () { return 0; };
Section.prototype.getWorkOffset = function () { return this.workOffset; };
Section.prototype.getWCS = function () { return this.wcs; };
Section.prototype.getUnit = function () { return this.unit; };
Section.prototype.getType = function () { return this.type; };
Section.prototype.getChannel = function () { return 0; };
Section.prototype.getFeedMode = function () { return this.feedMode; };
Section.prototype.getStrategy = function () { return this.strategy; };
Section.prototype.getTransformation = function () { return new Matrix(); };
Section.prototype.getSpindle = function () { return this.spindle; };
Section.prototype.getNumberOfRecords = function () { return this.dotekRecords.length; };
Section.prototype.checkGroup = function (group) {
  return group === values.STRATEGY_DRILLING && (this.strategy === "drill" || isDrilling(this.getFirstCycle()));
};
Section.prototype.doesToolpathFitWithinLimits = function () { return true; }; // travels of the machine are not asked
Section.prototype.getContentFlags = function () { return 0; };
Section.prototype.getToolChange = function () { return true; };

function ToolTable() {
  var seen = {};
  this.tools = [];
  state.sections.forEach(function (section) {
    var tool = section.dotekTool;
    if (!seen["t" + tool.number]) {
      seen["t" + tool.number] = true;
      this.tools.push(tool);
    }
  }, this);
  this.tools.sort(function (a, b) { return a.number - b.number; });
}
ToolTable.prototype.getNumberOfTools = function () { return this.tools.length; };
ToolTable.prototype.getTool = function (i) { return this.tools[i]; };

give({Tool: Tool, Section: Section, ToolTable: ToolTable});
