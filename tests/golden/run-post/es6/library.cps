// Functions of newer libraries, and what is easily lost of them: equal elements keep their order, holes are elements.
description = "library"; vendor = "own"; extension = "nc"; capabilities = CAPABILITY_MILLING;
const show = value => JSON.stringify(value);
class Base { static make() { return new this(); } name() { return "base"; } }
class Other extends Base { name() { return super.name() + "+"; } }
class Kept { constructor() { this.own = 1; } method() { return 2; } }
function onOpen() {
  const tools = [];
  for (let i = 0; i < 25; ++i) { tools.push({number: i % 3, i}); }
  writeln(show(tools.sort((a, b) => a.number - b.number).map(one => one.i)));
  writeln(show([undefined, 10, 9, , "1"].sort()));
  writeln(show([[..."ab"], [...Array(3).keys()], [...Array(2)].map((_, i) => i), Array.from(Array(2), (_, i) => i * 2), [...[, 1].entries()]]));
  writeln(show([[1, 2, 3].toReversed(), [3, 1].toSorted(), [1, 2, 3, 4].toSpliced(1, 2, 9), [1, 2].with(-1, 5), [1, 2, 3, 4, 5].copyWithin(0, 3)]));
  writeln(show([Math.fround(5.08), Math.log1p(1e-10), Math.expm1(1e-10), Math.sinh(0), Math.cosh(0), Math.tanh(30), Math.acosh(1)]));
  writeln(show([" a ".trimLeft(), " a ".trimRight(), String.raw({raw: ["a", "b"]}, 1), Object.hasOwn({a: 1}, "a")]));
  const map = new Map([[1, "a"]]);
  map.forEach((value, key) => { if (key < 4) { map.set(key + 1, value); } });
  const weak = new WeakMap();
  weak.set(map, 3);
  writeln(show([map.size, map, new Set([1]), weak.get(map)]));
  const names = [];
  for (const name in new Kept()) { names.push(name); }
  writeln(show([names, new Kept().method(), Other.make().name()]));
}
function onSection() {}
function onSectionEnd() {}
function onClose() {}
