// More of it, each construct once.
var a = [1,2].map(x => ({v: x}));
label: for (const x of [1,2,3]) { for (;;) { if (x == 2) continue label; break; } a.push(x); }
switch (a.length) { case 1: { let q = 1; a.push(q); break; } default: { let q = 2; a.push(q); } }
const o = {get g() { return 7; }, set g(v) {}, "s t": 1, 5: 2, m() { return this.g; }};
let {length} = "abc", z = length > 2 ? `x${`y${length}`}` : "n";
function h({a = 1, b} = {}, ...[c, d]) { return [a, b, c, d].join(); }
var re = /[/"']\/`/g, d2 = 6 / 2 / 3;
if (a) z += "!"
else z = ""
do z += "."; while (z.length < 6)
var f2 = async => async + 1, of = 3, get = 4, let_ = 5;
class P { static n = 3; x = 1; constructor() { this.y = this.x + 1; } static get t() { return P.n; } }
const i2 = new (class extends P { z() { return this.y; } })();
var arr = [, 1, , 2], q = arr?.[1] ?? 9;
a ||= 5; let cnt = null; cnt ??= 4; cnt **= 2;
var big = ((x, y) => { const k = x; { const k = y; return k + x; } })(1, 2);
for (let i = 0, n = 2; i < n; i++) { const v = i; a.push([0].map(() => v + i)[0]); }
for (const k in {p: 1}) a.push(k);
var t2 = typeof undefinedThing, v3 = void 0, n3 = !-+~1, c3 = (1, 2);
function onOpen() {
  writeln(JSON.stringify([a, o.g, o.m(), z, h({b: 2}, 3, 4), h(), d2, f2(1), P.t, i2.z(), q, cnt, big, "a/b".replace(re, ""), n3, c3]));
}
