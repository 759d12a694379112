// ---- vectors and matrices ---------------------------------------------------------------------------------------

function Vector(x, y, z) {
  this.x = x === undefined ? 0 : Number(x);
  this.y = y === undefined ? 0 : Number(y);
  this.z = z === undefined ? 0 : Number(z);
}
Vector.sum = function (a, b) { return new Vector(a.x + b.x, a.y + b.y, a.z + b.z); };
Vector.diff = function (a, b) { return new Vector(a.x - b.x, a.y - b.y, a.z - b.z); };
Vector.dot = function (a, b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
Vector.cross = function (a, b) {
  return new Vector(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
};
Vector.product = function (a, b) {
  return typeof a === "number" ? new Vector(a * b.x, a * b.y, a * b.z) : new Vector(a.x * b, a.y * b, a.z * b);
};
Vector.lerp = function (a, b, t) { return Vector.sum(a, Vector.product(Vector.diff(b, a), t)); };
Vector.getAngle = function (a, b) {
  return Math.acos(Math.max(-1, Math.min(1, Vector.dot(a, b) / (a.length * b.length))));
};
Vector.getDistance = function (a, b) { return Vector.diff(a, b).length; };
Object.defineProperty(Vector.prototype, "length", {
  get: function () { return Math.sqrt(this.x * this.x + this.y * this.y + this.z * this.z); }
});
Object.defineProperty(Vector.prototype, "length2", {
  get: function () { return this.x * this.x + this.y * this.y + this.z * this.z; }
});
Object.defineProperty(Vector.prototype, "normalized", {get: function () { return this.getNormalized(); }});
Object.defineProperty(Vector.prototype, "negated", {get: function () { return this.getNegated(); }});
Object.defineProperty(Vector.prototype, "abs", {
  get: function () { return new Vector(Math.abs(this.x), Math.abs(this.y), Math.abs(this.z)); }
});
Vector.prototype.getX = function () { return this.x; };
Vector.prototype.getY = function () { return this.y; };
Vector.prototype.getZ = function () { return this.z; };
Vector.prototype.setX = function (x) { this.x = x; };
Vector.prototype.setY = function (y) { this.y = y; };
Vector.prototype.setZ = function (z) { this.z = z; };
Vector.prototype.getCoordinate = function (i) { return i === 0 ? this.x : i === 1 ? this.y : this.z; };
Vector.prototype.setCoordinate = function (i, value) { this[["x", "y", "z"][i]] = value; };
Vector.prototype.getLength = function () { return this.length; };
Vector.prototype.getNormalized = function () {
  var length = this.length;
  return length === 0 ? new Vector(0, 0, 0) : new Vector(this.x / length, this.y / length, this.z / length);
};
Vector.prototype.normalize = function () {
  var of = this.getNormalized();
  this.x = of.x;
  this.y = of.y;
  this.z = of.z;
};
Vector.prototype.getNegated = function () { return new Vector(-this.x, -this.y, -this.z); };
Vector.prototype.getAbsolute = function () { return this.abs; };
Vector.prototype.isZero = function () { return this.x === 0 && this.y === 0 && this.z === 0; };
Vector.prototype.isNonZero = function () { return !this.isZero(); };
Vector.prototype.multiply = function (factor) { return Vector.product(this, factor); };
Vector.prototype.divide = function (by) { return Vector.product(this, 1 / by); };
Vector.prototype.add = function (b) { this.x += b.x; this.y += b.y; this.z += b.z; return this; };
Vector.prototype.subtract = function (b) { this.x -= b.x; this.y -= b.y; this.z -= b.z; return this; };
Vector.prototype.getDirection = function () { return this.getNormalized(); };
Vector.prototype.getXYAngle = function () { return Math.atan2(this.y, this.x); };
Vector.prototype.toDeg = function () {
  return new Vector(this.x * values.DEG, this.y * values.DEG, this.z * values.DEG);
};
Vector.prototype.toRad = function () {
  return new Vector(this.x / values.DEG, this.y / values.DEG, this.z / values.DEG);
};
Vector.prototype.toString = function () { return "(" + this.x + ", " + this.y + ", " + this.z + ")"; };

// Rows of a rotation; `forward` is its third column.
function Matrix() {
  var given = arguments;
  this.rows = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  if (given.length === 1 && given[0] instanceof Matrix) {
    this.rows = given[0].rows.map(function (row) { return row.slice(); });
  } else if (given.length === 1 && typeof given[0] === "number") {
    this.rows = [[given[0], 0, 0], [0, given[0], 0], [0, 0, given[0]]];
  } else if (given.length === 2) {
    this.rows = aboutAxis(given[0], given[1]);
  } else if (given.length === 3 && given[0] instanceof Vector) {
    this.rows = [[given[0].x, given[1].x, given[2].x], [given[0].y, given[1].y, given[2].y],
      [given[0].z, given[1].z, given[2].z]];
  } else if (given.length === 9) {
    for (var i = 0; i < 9; ++i) {
      this.rows[Math.floor(i / 3)][i % 3] = given[i];
    }
  }
}
function aboutAxis(direction, angle) {
  var of = direction.getNormalized();
  var c = Math.cos(angle);
  var s = Math.sin(angle);
  var t = 1 - c;
  return [[t * of.x * of.x + c, t * of.x * of.y - s * of.z, t * of.x * of.z + s * of.y],
    [t * of.x * of.y + s * of.z, t * of.y * of.y + c, t * of.y * of.z - s * of.x],
    [t * of.x * of.z - s * of.y, t * of.y * of.z + s * of.x, t * of.z * of.z + c]];
}
function fromRows(rows) {
  var out = new Matrix();
  out.rows = rows;
  return out;
}
function columnOf(index) {
  return {
    get: function () { return new Vector(this.rows[0][index], this.rows[1][index], this.rows[2][index]); },
    set: function (of) {
      this.rows[0][index] = of.x;
      this.rows[1][index] = of.y;
      this.rows[2][index] = of.z;
    }
  };
}
Object.defineProperty(Matrix.prototype, "right", columnOf(0));
Object.defineProperty(Matrix.prototype, "up", columnOf(1));
Object.defineProperty(Matrix.prototype, "forward", columnOf(2));
Object.defineProperty(Matrix.prototype, "transposed", {get: function () { return this.getTransposed(); }});
Object.defineProperty(Matrix.prototype, "negated", {get: function () { return this.getNegated(); }});
Matrix.prototype.getRight = function () { return this.right; };
Matrix.prototype.getUp = function () { return this.up; };
Matrix.prototype.getForward = function () { return this.forward; };
// Posts compute them by division: the fraction is dropped.
Matrix.prototype.getElement = function (row, column) { return this.rows[row | 0][column | 0]; };
Matrix.prototype.setElement = function (row, column, value) { this.rows[row | 0][column | 0] = value; };
Matrix.prototype.getRow = function (row) { return new Vector(this.rows[row][0], this.rows[row][1], this.rows[row][2]); };
Matrix.prototype.getColumn = function (i) { return new Vector(this.rows[0][i], this.rows[1][i], this.rows[2][i]); };
Matrix.prototype.getTransposed = function () {
  var of = this.rows;
  return fromRows([0, 1, 2].map(function (i) { return [of[0][i], of[1][i], of[2][i]]; }));
};
Matrix.prototype.transpose = function () { this.rows = this.getTransposed().rows; };
Matrix.prototype.getNegated = function () {
  return fromRows(this.rows.map(function (row) { return row.map(function (one) { return -one; }); }));
};
Matrix.prototype.multiply = function (by) {
  var of = this.rows;
  if (typeof by === "number") {
    return fromRows(of.map(function (row) { return row.map(function (one) { return one * by; }); }));
  }
  if (by instanceof Matrix) {
    return fromRows(of.map(function (row) {
      return [0, 1, 2].map(function (i) {
        return row[0] * by.rows[0][i] + row[1] * by.rows[1][i] + row[2] * by.rows[2][i];
      });
    }));
  }
  return new Vector(of[0][0] * by.x + of[0][1] * by.y + of[0][2] * by.z,
    of[1][0] * by.x + of[1][1] * by.y + of[1][2] * by.z, of[2][0] * by.x + of[2][1] * by.y + of[2][2] * by.z);
};
Matrix.prototype.isIdentity = function () {
  var of = this.rows;
  return [0, 1, 2].every(function (i) {
    return [0, 1, 2].every(function (k) { return Math.abs(of[i][k] - (i === k ? 1 : 0)) < 1e-9; });
  });
};
Matrix.prototype.isZero = function () {
  return this.rows.every(function (row) { return row.every(function (one) { return one === 0; }); });
};
Matrix.prototype.getDeterminant = function () {
  return Vector.dot(this.right, Vector.cross(this.up, this.forward));
};
Matrix.prototype.getN2 = function () {
  var sum = 0;
  this.rows.forEach(function (row) { row.forEach(function (one) { sum += one * one; }); });
  return Math.sqrt(sum);
};
// Angles of three turns about moving axes (`.._R`) or about fixed ones (`.._S`), as the name of the constant says.
Matrix.prototype.getEuler2 = function (convention) {
  var name = "";
  for (var one in values) {
    if (one.indexOf("EULER_") === 0 && values[one] === convention) {
      name = one;
    }
  }
  if (name === "") {
    throw sourceError("getEuler2: an unknown convention");
  }
  var axes = name.substring(6, 9).split("").map(function (c) { return "XYZ".indexOf(c); });
  var fixed = name.charAt(10) === "S";
  if (fixed) {
    axes.reverse();
  }
  var i = axes[0];
  var j = axes[1];
  var repeated = axes[2] === i;
  var k = 3 - i - j;
  var sign = (j - i + 3) % 3 === 1 ? 1 : -1;
  var of = this.rows;
  var a, b, c;
  if (repeated) {
    var s = Math.sqrt(of[i][j] * of[i][j] + of[i][k] * of[i][k]);
    b = Math.atan2(s, of[i][i]);
    if (s > 1e-9) {
      a = Math.atan2(of[j][i], -sign * of[k][i]);
      c = Math.atan2(of[i][j], sign * of[i][k]);
    } else {
      a = Math.atan2(sign * of[k][j], of[j][j]);
      c = 0;
    }
  } else {
    var cosine = Math.sqrt(of[i][i] * of[i][i] + of[i][j] * of[i][j]);
    b = Math.atan2(sign * of[i][k], cosine);
    if (cosine > 1e-9) {
      a = Math.atan2(-sign * of[j][k], of[k][k]);
      c = Math.atan2(-sign * of[i][j], of[i][i]);
    } else {
      a = Math.atan2(sign * of[k][j], of[j][j]);
      c = 0;
    }
  }
  return fixed ? new Vector(c, b, a) : new Vector(a, b, c);
};
Matrix.prototype.getEuler = Matrix.prototype.getEuler2;
Matrix.prototype.getEulerXYZ = function () { return this.getEuler2(values.EULER_XYZ_R); };
Matrix.prototype.getTiltAndTilt = function (first, second) {
  if (first === undefined || second === undefined) {
    throw sourceError("getTiltAndTilt: two axes are expected");
  }
  return this.getEuler2(values.EULER_XYZ_R);
};
// Angles of a tilted plane are the engine's choice, and no source states it.
Matrix.prototype.getTurnAndTilt = function () {
  if (isSameDirection(this.forward, new Vector(0, 0, 1))) {
    return new Vector(0, 0, 0);
  }
  throw sourceError("the angles of a tilted work plane are not known to Dotek's kernel");
};
Matrix.diff = function (a, b) {
  return fromRows(a.rows.map(function (row, i) { return row.map(function (one, k) { return one - b.rows[i][k]; }); }));
};
Matrix.sum = function (a, b) {
  return fromRows(a.rows.map(function (row, i) { return row.map(function (one, k) { return one + b.rows[i][k]; }); }));
};
Matrix.getXRotation = function (angle) { return fromRows(aboutAxis(new Vector(1, 0, 0), angle)); };
Matrix.getYRotation = function (angle) { return fromRows(aboutAxis(new Vector(0, 1, 0), angle)); };
Matrix.getZRotation = function (angle) { return fromRows(aboutAxis(new Vector(0, 0, 1), angle)); };
Matrix.getAxisRotation = function (axis, angle) { return fromRows(aboutAxis(axis, angle)); };
Matrix.getXYZRotation = function (abc) {
  return Matrix.getXRotation(abc.x).multiply(Matrix.getYRotation(abc.y)).multiply(Matrix.getZRotation(abc.z));
};
Matrix.getOrientationFromDirection = function (forward) {
  var f = forward.getNormalized();
  var right = Math.abs(f.z) > 1 - 1e-9 ? new Vector(1, 0, 0) : Vector.cross(new Vector(0, 0, 1), f).getNormalized();
  return new Matrix(right, Vector.cross(f, right), f);
};

function isSameDirection(a, b) {
  return Vector.diff(a.getNormalized(), b.getNormalized()).length < 1e-4;
}

function Range(minimum, maximum) {
  this.minimum = minimum;
  this.maximum = maximum;
}
["minimum", "maximum"].forEach(function (name, i) { // posts read both forms
  Object.defineProperty(Range.prototype, String(i), {get: function () { return this[name]; }});
});
Range.prototype.getMinimum = function () { return this.minimum; };
Range.prototype.getMaximum = function () { return this.maximum; };
Range.prototype.getSize = function () { return this.maximum - this.minimum; };
Range.prototype.isWithin = function (value) { return value >= this.minimum && value <= this.maximum; };
Range.prototype.isNonRange = function () { return this.minimum === this.maximum; };
Range.prototype.expandTo = function (value) {
  this.minimum = Math.min(this.minimum, value);
  this.maximum = Math.max(this.maximum, value);
};
Range.prototype.expandToRange = function (range) {
  this.expandTo(range.minimum);
  this.expandTo(range.maximum);
};

function BoundingBox(lower, upper) {
  this.lower = lower || new Vector();
  this.upper = upper || new Vector();
}
BoundingBox.prototype.getXRange = function () { return new Range(this.lower.x, this.upper.x); };
BoundingBox.prototype.getYRange = function () { return new Range(this.lower.y, this.upper.y); };
BoundingBox.prototype.getZRange = function () { return new Range(this.lower.z, this.upper.z); };
BoundingBox.prototype.expandToBox = function (box) {
  this.lower = new Vector(Math.min(this.lower.x, box.lower.x), Math.min(this.lower.y, box.lower.y),
    Math.min(this.lower.z, box.lower.z));
  this.upper = new Vector(Math.max(this.upper.x, box.upper.x), Math.max(this.upper.y, box.upper.y),
    Math.max(this.upper.z, box.upper.z));
};

give({Vector: Vector, Matrix: Matrix, Range: Range, BoundingBox: BoundingBox, isSameDirection: isSameDirection});
