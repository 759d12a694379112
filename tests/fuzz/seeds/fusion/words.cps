// Words, buffers and formats in the newer style, written for the tests.
minimumRevision = 45892;
properties = {
  plain: {title: "Plain", type: "boolean", value: true, scope: "post"},
  letters: {title: "Letters", type: "enum", value: "IJK", values: [{title: "IJK", id: "IJK"}, {title: "UVW", id: "UVW"}], scope: "post"}
};
const fine = createFormat({decimals: 4, type: FORMAT_REAL, minDigitsLeft: 2, minDigitsRight: 1});
const whole = createFormat({decimals: 2, type: FORMAT_INTEGER, prefix: "Q"});
const shifted = createFormat({inherit: fine, scale: 2, offset: 1, prefix: "R"});
const bare = createFormat({decimals: 3, trimLeadZero: true, forceSign: true});
const a = createOutputVariable({prefix: "A", current: 40}, fine);
const b = createOutputVariable({prefix: "B", control: CONTROL_FORCE, suffix: "*"}, whole);
const c = createOutputVariable({prefix: "C", control: CONTROL_NONZERO}, bare);
const d = createOutputVariable({prefix: "D", type: TYPE_INCREMENTAL}, fine);

function pick({width1: first = 1, width2: second = 2, nothing = 3} = {}) {
  return [first / 3, second / -7, nothing * 0.0005];
}

class Line {
  constructor(...parts) {
    this.parts = parts;
  }
  write(extra = []) {
    writeWords(...this.parts, extra);
  }
}

function onCyclePoint(x, y, z) {
  const [first, second, third] = pick(cycle);
  switch (cycleType) {
  case "probing-x":
  case "probing-y":
  case "probing-z":
    for (const value of [first, second, third, first]) {
      new Line(a.format(value), b.format(value), c.format(value), d.format(value)).write();
    }
    break;
  case "probing-x-wall": {
    let sum = 0;
    for (let i = 0; i < 3; ++i) {
      sum += [first, second, third][i];
      new Line(`#${100 + i}=`, shifted.format(sum)).write(["(", bare.format(sum), ")"]);
    }
    break;
  }
  case "probing-y-wall":
    c.disable();
    writeWords2("/", c.format(first));
    c.enable();
    writeWords2("/", c.format(first), undefined, "");
    break;
  case "probing-xy-circular-hole":
    writeWords(getProperty("letters") + (getProperty(properties.plain) ? 1 : 0), [["X"], [fine.format(cycle.probeClearance)]]);
    writeln(subst("%2-%1", fine.getMinimumValue(), fine.isSignificant(0.00004)));
    break;
  default:
    if (/boss$/.test(cycleType)) {
      error(`Bosses (${cycleType.split("-").pop()}) are not measured.`);
    }
    cycleNotSupported();
  }
}
