// ---- the machine: axes and what posts ask of a configuration -----------------------------------------------------

function Axis(specifiers) {
  var given = specifiers || {};
  this.table = given.table === undefined ? false : Boolean(given.table);
  this.direction = given.axis ? new Vector(given.axis[0], given.axis[1], given.axis[2]) : new Vector();
  this.offset = given.offset ? new Vector(given.offset[0], given.offset[1], given.offset[2]) : new Vector();
  this.cyclic = Boolean(given.cyclic);
  this.tcp = given.tcp === undefined ? true : Boolean(given.tcp);
  this.coordinate = given.coordinate;
  this.preference = given.preference || 0;
  this.range = given.range;
  this.reset = given.reset || 0;
  this.resolution = given.resolution || 0;
  this.maximumFeed = given.maximumFeed || 0;
  this.enabled = specifiers !== undefined && given.axis !== undefined;
}
(function () {
  var simple = {isEnabled: "enabled", isTable: "table", isCyclic: "cyclic", isTCPEnabled: "tcp", getAxis: "direction",
    getEffectiveAxis: "direction", getDirection: "direction", getOffset: "offset", getPreference: "preference",
    getReset: "reset", getResolution: "resolution", getMaximumFeed: "maximumFeed", getMaximumFeedrate: "maximumFeed"};
  Object.keys(simple).forEach(function (name) {
    Axis.prototype[name] = function () { return this[simple[name]]; };
  });
}());
Axis.prototype.getCoordinate = function () {
  return this.coordinate === undefined ? -1 : typeof this.coordinate === "string"
    ? "XYZABC".indexOf(this.coordinate.toUpperCase()) % 3 : this.coordinate;
};
Axis.prototype.getName = function () { return "ABC".charAt(Math.max(0, this.getCoordinate())); };
Axis.prototype.isHead = function () { return this.enabled && !this.table; };
Axis.prototype.isLinear = function () { return false; };
Axis.prototype.isRotational = function () { return this.enabled; };
Axis.prototype.isAggregate = function () { return false; };
Axis.prototype.hasRange = function () { return this.range !== undefined; };
Axis.prototype.getRange = function () {
  var of = this.range;
  return of === undefined ? new Range(-Infinity, Infinity) : new Range(of[0] / values.DEG, of[1] / values.DEG);
};
Axis.prototype.isSupported = function (angle) {
  var range = this.getRange();
  return this.cyclic || (angle >= range.minimum - 1e-9 && angle <= range.maximum + 1e-9);
};
Axis.prototype.isWithinRange = Axis.prototype.isSupported;
Axis.prototype.clampToRange = function (angle) {
  var range = this.getRange();
  return Math.max(range.minimum, Math.min(range.maximum, angle));
};

function MachineConfiguration() {
  var axes = Array.prototype.slice.call(arguments).filter(function (one) { return one instanceof Axis; });
  this.axes = [axes[0] || new Axis(), axes[1] || new Axis(), axes[2] || new Axis()];
  this.linear = [0, 1, 2].map(function (i) {
    var axis = new Axis({axis: [i === 0 ? 1 : 0, i === 1 ? 1 : 0, i === 2 ? 1 : 0], coordinate: i});
    axis.isLinear = function () { return true; };
    return axis;
  });
  this.retractPlane = 0;
  this.homes = [undefined, undefined, undefined];
  this.texts = {Vendor: "", Model: "", Description: "", Control: "", XML: "", VendorUrl: ""};
  this.numbers = {MaximumSpindleSpeed: 0, MinimumSpindleSpeed: 0, MaximumFeedrate: 0, MaximumCuttingFeedrate: 0,
    MaximumBlockProcessingSpeed: 0, NumberOfTools: 0, ToolLength: 0, MultiAxisFeedrateMode: values.FEED_FPM,
    MultiAxisFeedrateMaximum: 0, MultiAxisFeedrateOutputTolerance: 0, MultiAxisFeedrateInverseTimeUnits: 0,
    MultiAxisFeedrateDPMType: 0, MultiAxisFeedrateBpwRatio: 1, SafeRetractDistance: 0, SafeRetractFeedrate: 0,
    SafePlungeFeedrate: 0, RewindStockExpansion: undefined, SpindleDescription: "", ToolChangeTime: 0, Weight: 0, Width: 0, Depth: 0, Height: 0,
    MaximumSpindlePower: 0, Milling: true, Turning: false, Wire: false, Jet: false, ToolChanger: false,
    ToolPreload: false, NumberOfWorkOffsets: 0, SpindleSpeedSupported: true, MaximumToolLength: 0,
    MaximumToolDiameter: 0, MaximumToolWeight: 0, WorkpieceSize: 0, ToolInterface: "", TabWidth: 0, Coolants: 0,
    MilliSecondsPerBlock: 0, VirtualTooltip: false, Spindles: 1};
  this.received = false;
  this.rewinds = false;
}
(function () {
  Object.keys(new MachineConfiguration().numbers).forEach(function (name) {
    MachineConfiguration.prototype["get" + name] = function () { return this.numbers[name]; };
    MachineConfiguration.prototype["set" + name] = function (value) { this.numbers[name] = value; };
  });
  ["Vendor", "Model", "Description", "Control", "XML", "VendorUrl"].forEach(function (name) {
    MachineConfiguration.prototype["get" + name] = function () { return this.texts[name]; };
    MachineConfiguration.prototype["set" + name] = function (value) { this.texts[name] = String(value); };
  });
  ["X", "Y", "Z"].forEach(function (name, i) {
    MachineConfiguration.prototype["hasHomePosition" + name] = function () { return this.homes[i] !== undefined; };
    MachineConfiguration.prototype["getHomePosition" + name] = function () { return this.homes[i] || 0; };
    MachineConfiguration.prototype["setHomePosition" + name] = function (value) { this.homes[i] = value; };
    MachineConfiguration.prototype["getAxis" + name] = function () { return this.linear[i]; };
    MachineConfiguration.prototype["setAxis" + name] = function (axis) { this.linear[i] = axis; };
  });
  ["U", "V", "W"].forEach(function (name, i) {
    MachineConfiguration.prototype["getAxis" + name] = function () { return this.axes[i]; };
    MachineConfiguration.prototype["setAxis" + name] = function (axis) { this.axes[i] = axis; };
  });
}());
MachineConfiguration.prototype.getAxes = function () { return this.axes; };
MachineConfiguration.prototype.isReceived = function () { return this.received; };
MachineConfiguration.prototype.isMultiAxisConfiguration = function () {
  return this.axes.some(function (axis) { return axis.enabled; });
};
MachineConfiguration.prototype.isHeadConfiguration = function () {
  return this.isMultiAxisConfiguration() && this.axes.every(function (axis) { return !axis.enabled || !axis.table; });
};
MachineConfiguration.prototype.isTableConfiguration = function () {
  return this.isMultiAxisConfiguration() && this.axes.every(function (axis) { return !axis.enabled || axis.table; });
};
MachineConfiguration.prototype.isMachineCoordinate = function (coordinate) {
  return this.axes.some(function (axis) { return axis.enabled && axis.getCoordinate() === coordinate; });
};
MachineConfiguration.prototype.getAxisByCoordinate = function (coordinate) {
  for (var i = 0; i < 3; ++i) {
    if (this.axes[i].enabled && this.axes[i].getCoordinate() === coordinate) {
      return this.axes[i];
    }
  }
  return new Axis();
};
MachineConfiguration.prototype.getNumberOfAxes = function () {
  return 3 + this.axes.filter(function (axis) { return axis.enabled; }).length;
};
MachineConfiguration.prototype.getSpindleAxis = function () { return new Vector(0, 0, 1); };
MachineConfiguration.prototype.setSpindleAxis = function () {};
MachineConfiguration.prototype.getRetractPlane = function () { return this.retractPlane; };
MachineConfiguration.prototype.setRetractPlane = function (value) { this.retractPlane = value; };
MachineConfiguration.prototype.hasRetractPlane = function () { return true; };
MachineConfiguration.prototype.setMultiAxisFeedrate = function (mode, maximum, type, tolerance, ratio) {
  this.numbers.MultiAxisFeedrateMode = mode;
  this.numbers.MultiAxisFeedrateMaximum = maximum;
  this.numbers.MultiAxisFeedrateDPMType = type;
  this.numbers.MultiAxisFeedrateInverseTimeUnits = type;
  this.numbers.MultiAxisFeedrateOutputTolerance = tolerance;
  this.numbers.MultiAxisFeedrateBpwRatio = ratio;
};
MachineConfiguration.prototype.performRewinds = function () { return this.rewinds; };
MachineConfiguration.prototype.enableMachineRewinds = function () { this.rewinds = true; };
["isSpindleSpeedSupported", "isToolNumberSupported", "isABCSupported", "isDirectionSupported",
  "getSpindleAxisSupported"].forEach(function (name) {
  MachineConfiguration.prototype[name] = function () { return true; };
});
// Turns of the part, or of the tool, for angles of the axes.
MachineConfiguration.prototype.getOrientation = function (abc) {
  var out = new Matrix();
  this.axes.forEach(function (axis) {
    if (!axis.enabled) {
      return;
    }
    var angle = abc.getCoordinate(axis.getCoordinate());
    out = out.multiply(Matrix.getAxisRotation(axis.direction, axis.table ? -angle : angle));
  });
  return out;
};
MachineConfiguration.prototype.getRemainingOrientation = function (abc, plane) {
  return this.getOrientation(abc).getTransposed().multiply(plane);
};
MachineConfiguration.prototype.getDirection = function (abc) { return this.getOrientation(abc).forward; };
MachineConfiguration.prototype.getOptimizedDirection = function (direction) { return direction; };
MachineConfiguration.prototype.getOptimizedPosition = function (position) { return position; };
// Only upright planes: which angles turn a tilted one is the engine's choice, and no source tells it.
MachineConfiguration.prototype.getABC = function (plane) {
  if (isSameDirection(plane.forward, new Vector(0, 0, 1))) {
    return new Vector(0, 0, 0);
  }
  throw sourceError("the angles of a tilted work plane are not known to Dotek's kernel");
};
MachineConfiguration.prototype.getABCByDirection = function (direction) {
  return this.getABC(Matrix.getOrientationFromDirection(direction));
};
MachineConfiguration.prototype.getABCByPreference = function (plane) { return this.getABC(plane); };
MachineConfiguration.prototype.getABCByDirectionBoth = MachineConfiguration.prototype.getABCByDirection;
["getPreferredABC", "remapABC", "remapToABC", "getOtherABC", "getOtherABCByDirection", "getTableABC"].forEach(function (name) {
  MachineConfiguration.prototype[name] = function (abc) { return new Vector(abc.x, abc.y, abc.z); };
});
MachineConfiguration.prototype.getHeadABC = function () { return new Vector(); };
MachineConfiguration.prototype.getHeadAttachPoint = function () { return new Vector(); };
MachineConfiguration.prototype.setHeadAttachPoint = function () {};
MachineConfiguration.prototype.toString = function () { return "[machine]"; };
MachineConfiguration.createFromString = function () {
  throw sourceError("MachineConfiguration.createFromString is not carried out");
};

// Turns of axes that are at 0 are not unwound; what the engine does to others is not known.
function unwindABC(abc) {
  if (!(abc instanceof Vector) || abc.isNonZero()) {
    throw sourceError("`unwindABC` of Fusion is not carried out by Dotek's kernel where an axis is turned");
  }
}

give({unwindABC: unwindABC,
  Axis: Axis, MachineConfiguration: MachineConfiguration,
  createAxis: function (specifiers) { return new Axis(specifiers); },
  createMachineConfiguration: function () { return new MachineConfiguration(); },
  getMachineConfiguration: function () { return global.machineConfiguration; },
  setMachineConfiguration: function (configuration) { global.machineConfiguration = configuration; },
  getMachineConfigurations: function () { return []; },
  optimizeMachineAngles: function () {}, optimizeMachineAngles2: function () {},
  optimizeMachineAnglesByMachine: function () {},
  // Kinematics of the machine are taken for those of a plain mill.
  getOptimizedHeads: function (a, b, c) { return {x: a, y: b, z: c, a: 0, b: 0, c: 0}; }
});
