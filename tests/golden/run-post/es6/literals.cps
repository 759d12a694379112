// Literals with accessors, several questions in a chain, and other things that have to come out as in ES6.
function one(a, b,) { return a + b; }
const two = (a, b,) => a * b;
class Counter {
  constructor(from,) { this.n = from; }
  next(step,) { this.n += step; return this; }
}
function onOpen() {
  const key = "wcs", feed = 100;
  const state = {[key]: 54, feed, get double() { return this.feed * 2; }, set double(v) { this.feed = v / 2; }};
  state.double = 500;
  writeln("accessor " + state.feed + " " + state.double + " " + state.wcs);
  let reads = 0;
  const source = {get r() { return ++reads; }};
  const copy = {...source, get own() { return reads; }};
  writeln("spread " + copy.r + copy.r + copy.own + " " + Object.keys(copy).join());
  const named = {get [key + "2"]() { return 7; }, set [key + "2"](v) { this.kept = v; }};
  named.wcs2 = 3;
  writeln("computed " + named.wcs2 + named.kept);
  const child = {__proto__: {z: 1}, ["a"]: 2};
  const plain = {"__proto__": {z: 4}};
  writeln("prototype " + child.z + child.a + plain.z + Object.keys(child).join());
  writeln("override " + JSON.stringify({a: 1, ...{a: 2, b: 3}, b: 4, ...null}));
  writeln("text " + [..."a\u{1F600}b"].length + Array.from("x\u{1F600}").length);
  let count = 0;
  for (const c of "\u{1F600}z") { count += c.length * 10 + 1; }
  writeln("of " + count);
  const a = {b: {c: 5, m(x, y) { return this.c + (x || 0) + (y || 0); }}, none: null};
  writeln("chain " + [a?.b?.c, a?.none?.c, a.x?.y?.z, a?.b?.m(), a?.x?.m(), a.b.m?.(1, 2), a.b.n?.(1), a.b["m"]?.()].join("/"));
  writeln("number " + (1_000 + 0x1_0) + " " + one(1, 2,) + two(2, 3,) + new Counter(1,).next(2,).next(3).n);
  writeln("lists " + [[1, [2]], [3]].flatMap(function (x) { return x; }).length + [1, 2, 3].findLast((x) => x < 3) +
    [1, 2].findLastIndex((x) => x > 5) + [1, 2, 3].reduceRight((s, x) => s + x, "") + Object.fromEntries([["k", 9]]).k);
}
