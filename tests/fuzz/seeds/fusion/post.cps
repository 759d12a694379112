// What posts use of ES6, said in ES5 with the same lines: the last line of the program is that of node.
const a = 1, b = 2;
function f(x, y = x + 1, ...z) {
  return x + y + z.length;
}
let t = `a ${a} b
 "second" ${f(1)}`;
let {p, q: {r = 5}, ...rest} = {p: 1, q: {}, m: 3, n: 4};
let [u, , v = 7, ...w] = [1, 2, undefined, 4, 5];
[u, v] = [v, u];
class A {
  constructor(n) { this.n = n; }
  get twice() {
    return 2 * this.n;
  }
  static make(n) { return new A(n); }
  add(k = 1) {
    return [1, 2].map((x) => x + this.n + k);
  }
}
class B extends A {
  constructor(n) {
    super(n);
    this.b = 1;
  }
  add(k) { return [0, ...super.add(k)]; }
}
let out = [];
for (let i of [1, 2, 3]) { let z; if (i == 2) { z = i; } out.push(z); }
for (const [k, l] of [[1, 2], [3, 4]]) out.push(k * l);
function g() { let x = 1; { let x = 2; out.push(x); } out.push(x); for (let x = 0; x < 2; ++x) { out.push(`${x}`); } return x; }
out.push(g());
out.push(Math.max(...[1, 5, 3], 2), [...out].length, {...{a: 1}, b: 2}.a, ({a, m(x) { return x * 2; }, ["k" + 1]: 3}).m(4));
out.push(null ?? 5, 2 ** 3, undefined?.x, ({y: {z: 9}})?.y.z);
let fn = ({a: aa, b: bb = 3}, [cc]) => aa + bb + cc;
out.push(fn({a: 1}, [2]), new B(3).add(2).join("/"), new B(4).twice, A.make(2).n);
try { null.x; } catch { out.push("caught"); }
out.push([3, 1, 2].sort((a, b) => a - b,).join());
function onOpen() {
  writeln(JSON.stringify([t, p, r, rest, u, v, w, out, f(1), f(1, 2, 3)]));
}
