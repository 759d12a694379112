// ES6 said in ES5: small programs, drawn at random, give on Duktape what they give in node.
#include "tests/Process.h"
#include "tests/Skips.h"
#include "tests/policy/Tree.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace dotek;
using namespace dotek::tests;

namespace {

// Programs of numbers, lists, objects and functions. What is visible is kept per block, so that none reads a
// variable before its declaration.
class Programs {
public:
  explicit Programs(unsigned seed) : random_(seed) {}

  std::string function(int number) {
    visible_ = {"p", "q"};
    loops_.clear();
    count_ = 0;
    // The body first: it says whether `r` is a list of the rest.
    const std::string body = block(4, 3);
    return fmt::format(
        "function f{0}(p, q = {1}, ...r) {{\n  const kept = [];\n  var v, w;\n{2}"
        "  kept.forEach((f, i) => out(`f{0}.${{i}} ${{f()}}`));\n  out(`${{[v, w, ...r]}}`);\n}}\n",
        number, pick(9), body);
  }

private:
  int pick(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }
  bool chance(int of) { return pick(of) == 0; }
  template <std::size_t N> const char* oneOf(const std::array<const char*, N>& all) {
    return all[random_() % N];
  }
  std::string variable() {
    if (chance(4)) return chance(2) ? "v" : "w";
    return visible_[random_() % visible_.size()];
  }
  std::string fresh() { return fmt::format("t{}", ++count_); }

  std::string value(int depth) {
    if (depth <= 0) return chance(3) ? std::to_string(pick(10)) : variable();
    const std::string a = value(depth - 1), b = value(depth - 1);
    switch (pick(16)) {
    case 0: return fmt::format("({} {} {})", a, oneOf(std::array{"+", "-", "*", "<", "===", "%"}), b);
    case 1: return fmt::format("(({} > {}) ? {} : {})", a, b, b, a);
    case 2: return fmt::format("`${{{}}}|\\`${{`${{{}}}`}}`", a, b);
    case 3: return fmt::format("[{}, ...[{}, {}]].length", a, b, a);
    case 4: return fmt::format("((x, y = {}) => x + y)({})", a, b);
    case 5:
      return fmt::format(
          "({{{0}: {1}, [\"k\" + {0}]: {2}, m() {{ return this.z; }}, get z() {{ return {0}; }}}}).m()", "p",
          a, b);
    case 6: return fmt::format("({} ?? {})", a, b);
    case 7: return fmt::format("(({{u: {}}})?.u?.s ?? {})", a, b);
    case 8: return fmt::format("[{}, {}].map((x, i) => x + i).join(\"-\")", a, b);
    case 9: return fmt::format("(([x, , y = {}]) => `${{x}}${{y}}`)([{}, 1])", a, b);
    case 10:
      return fmt::format("(({{x, n: {{y = {}}} = {{}}, ...more}}) => [x, y, Object.keys(more)].join())"
                         "({{x: {}, d: 1, e: 2}})",
                         a, b);
    case 11: return fmt::format("Math.max(...[{}, {}].filter((x) => typeof x == \"number\"), 1)", a, b);
    case 12:
      return fmt::format(
          "(() => {{ for (let i = 0; i < 3; i++) {{ const g = () => i; if (g() == {}) return {}; }} "
          "return 0; }})()",
          pick(4), a);
    case 13:
      return fmt::format("new (class {{ constructor(x) {{ this.x = x; }} static s() {{ return 1; }} "
                         "get twice() {{ return `${{this.x}}${{this.x}}`; }} }})({}).twice",
                         a);
    case 14: return fmt::format("String({} ** 2).padStart(3, \"0\")", pick(9));
    default: return a;
    }
  }

  std::string keep() {
    const std::string name = visible_[random_() % visible_.size()];
    switch (pick(4)) {
    case 0: return fmt::format("kept.push(() => {} = cut({}));\n", name, value(1));
    case 1:
      return fmt::format("kept.push(function () {{ return [{}, {}].join(\":\"); }});\n", name, variable());
    case 2: return fmt::format("kept.push(({{get g() {{ return () => `${{{}}}`; }}}}).g);\n", name);
    default: return fmt::format("kept.push(() => {});\n", value(2));
    }
  }

  std::string leave() {
    if (loops_.empty() || chance(8))
      return fmt::format("if ({}) {{ return out({}); }}\n", value(1), value(1));
    const std::string word = chance(2) ? "break" : "continue";
    const std::string label = chance(3) ? " " + loops_[random_() % loops_.size()] : "";
    return fmt::format("if ({}) {}{};\n", value(1), word, label);
  }

  std::string statement(int depth) {
    switch (pick(depth > 0 ? 14 : 6)) {
    case 0: return fmt::format("out({});\n", value(2));
    case 1:
    case 2: return keep();
    case 3: return leave();
    case 4: return fmt::format("{} = cut({});\n", chance(2) ? "v" : "w", value(2));
    case 5: return fmt::format("[v, w] = [cut({}), ...[cut({})]];\n", value(1), value(1));
    case 6:
      return fmt::format("if ({}) {{\n{}}} else {{\n{}}}\n", value(1), block(depth - 1, 2),
                         block(depth - 1, 2));
    case 7: {
      const std::string i = fresh();
      return loop(fmt::format("for (let {0} = 0, {0}n = {1}; {0} < {0}n; ++{0}) ", i, 1 + pick(3)), {i},
                  depth, chance(3) ? i + " += 1;\n" : "");
    }
    case 8: {
      const std::string i = fresh();
      return loop(fmt::format("for ({} {} of [{}, {}, 7]) ", oneOf(std::array{"let", "const"}), i, value(1),
                              value(1)),
                  {i}, depth);
    }
    case 9: {
      const std::string i = fresh(), k = fresh();
      return loop(fmt::format("for (const [{}, {{{}}}] of [[1, {{{}: {}}}], [2, {{}}]]) ", i, k, k, value(1)),
                  {i, k}, depth);
    }
    case 10: {
      const std::string i = fresh();
      return loop(fmt::format("for ({} {} in {{x: 1, y: {}}}) ", oneOf(std::array{"let", "const", "var"}), i,
                              value(1)),
                  {i}, depth);
    }
    case 11: {
      const std::string i = fresh();
      return fmt::format("var {0} = 0;\n", i) +
             loop(fmt::format("while ({0}++ < {1}) ", i, 1 + pick(3)), {}, depth);
    }
    case 12: {
      loops_.push_back(fmt::format("l{}", ++count_));
      const std::string label = loops_.back(), i = fresh();
      const std::string body = block(depth - 1, 3);
      loops_.pop_back();
      return fmt::format("var {0} = 0;\n{1}: do {{\n{2}}} while (++{0} < 3);\n", i, label, body);
    }
    default:
      return chance(2) ? fmt::format("try {{\n{}if ({}) throw new Error(\"e\");\n}} catch ({{message}}) "
                                     "{{\nkept.push(() => message);\n"
                                     "}} finally {{\nout(\"end\");\n}}\n",
                                     block(depth - 1, 2), value(1))
                       : fmt::format("switch ({}) {{\ncase 1:\nout(1);\nbreak;\ndefault:\n{{\n{}}}\n}}\n",
                                     value(1), inSwitch(depth - 1));
    }
  }

  std::string inSwitch(int depth) {
    const auto all = std::exchange(loops_, {}); // `continue` in a switch is drawn in loops alone
    std::string out = block(depth, 2);
    loops_ = all;
    return out;
  }

  std::string loop(const std::string& head, const std::vector<std::string>& names, int depth,
                   const std::string& more = "") {
    const std::size_t had = visible_.size();
    const std::string label = fmt::format("l{}", ++count_);
    loops_.push_back(label);
    for (const std::string& name : names)
      if (head.find("const") == std::string::npos && head.find("var") == std::string::npos)
        visible_.push_back(name);
    std::string text =
        names.empty() ? "" : fmt::format("kept.push(() => `${{[{}]}}`);\n", fmt::join(names, ", "));
    text += block(depth - 1, 3) + more;
    visible_.resize(had);
    loops_.pop_back();
    return label + ": " + head + "{\ntick();\n" + text + "}\n";
  }

  std::string block(int depth, int most) {
    const std::size_t had = visible_.size();
    std::string out;
    for (int i = 1 + pick(most); i-- > 0;) {
      if (chance(3)) { // shadows what an outer block has of this name, which the block does not use itself
        const std::string name = fmt::format("n{}", pick(2) + 10 * depth);
        if (std::find(visible_.begin(), visible_.end(), name) == visible_.end()) {
          out += fmt::format("let {} = cut({});\n", name, value(2));
          visible_.push_back(name);
        }
      }
      out += statement(depth);
    }
    visible_.resize(had);
    return out;
  }

  std::mt19937 random_;
  std::vector<std::string> visible_, loops_; // names that may be read and written; labels
  int count_ = 0;
};

std::string printed(const std::string& command) {
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return "";
  std::string out;
  std::array<char, 4096> part{};
  for (std::size_t read = 0; (read = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    out.append(part.data(), read);
  return pclose(pipe) == 0 ? out : "";
}

// Says where the two differ: the programs write their names.
void sameInNode(const std::string& functions, const std::string& calls) {
  const ProcessFolder folder;
  const std::string tools =
      "var ticks = 0;\nfunction out(one) { writeln(String(one)); }\n"
      "function cut(one) { return typeof one == \"string\" ? one.slice(0, 40) : one; }\n"
      "function tick() { if (++ticks > 400) { throw new Error(\"long\"); } }\n"
      "function run(name, f) {\n  ticks = 0;\n  writeln(\"-- \" + name);\n"
      "  try { f(5, undefined, 8); } catch (e) { writeln(\"threw\"); }\n}\n";
  const std::string post = tools + functions + "function onOpen() {\n" + calls + "}\n";
  folder.write("post.cps", post);
  folder.write("job.toml", "schema = 1\n\n[[section]]\ntool = { number = 1 }\n");
  folder.write(
      "post.js",
      "globalThis.writeln = (one) => console.log(one);\nrequire(\"vm\").runInThisContext(require(\"fs\")"
      ".readFileSync(\"post.cps\", \"utf8\") + \"\\nonOpen();\");\n");
  const ShellResult ours = folder.run("dotek run-post post.cps job.toml");
  CHECK_MESSAGE(ours.status == 0, ours.err);
  const ShellResult node = folder.run("node post.js");
  REQUIRE_MESSAGE(node.status == 0, node.err);
  std::vector<std::string> a = linesOf(ours.out), b = linesOf(node.out);
  std::string name;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    if (b[i].starts_with("-- ")) name = b[i].substr(3);
    if (a[i] == b[i]) continue;
    const std::size_t from = functions.find("function " + name + "(");
    const std::size_t to = functions.find("\nfunction ", from);
    FAIL_CHECK(name << ": `" << a[i] << "`, in node `" << b[i] << "`\n" << functions.substr(from, to - from));
    return;
  }
  CHECK(a.size() == b.size());
}

} // namespace

TEST_CASE("fusion language: random programs give what node gives") {
  if (printed("node --version 2>/dev/null").empty())
    return skip("node, which runs the same programs, is not there");
  for (unsigned seed = 1; seed <= 6; ++seed) {
    Programs programs(seed);
    std::string functions, calls;
    for (int i = 0; i < 60; ++i) {
      functions += programs.function(i);
      calls += fmt::format("  run(\"f{0}\", f{0});\n", i);
    }
    CAPTURE(seed);
    sameInNode(functions, calls);
  }
}

TEST_CASE("fusion language: each pass of a loop has variables of its own") {
  if (printed("node --version 2>/dev/null").empty())
    return skip("node, which runs the same programs, is not there");
  const std::string functions = R"(
function all(list) { out(list.map((f) => String(f())).join(" ")); }
function counts() {
  const fs = [];
  for (let i = 0, n = 4; i < n; ++i) {
    if (i == 1) { continue; }
    let k = i * 10;
    fs.push(() => i + k);
    if (i == 3) break;
  }
  for (let i = 0; i < 2; i++) { fs.push(() => i++); fs.push(() => i); i++; i--; }
  all(fs);
}
function labels() {
  const fs = [];
  outer: for (const one of ["a", "b", "c", "d"]) {
    for (let j = 0; j < 3; j++) {
      fs.push(() => one + ":" + j);
      if (one == "b" && j == 1) continue outer;
      if (one == "c") break outer;
    }
    var last = one;
  }
  block: { for (let i = 0; i < 3; i++) { fs.push(() => i); if (i == 1) break block; } out("never"); }
  all(fs.concat(() => last));
}
function results() {
  const find = (m) => { for (let i = 0; i < 3; i++) { for (let j = 0; j < 3; j++) { const g = () => i * j; if (m == g()) { return [i, j]; } } } };
  out(find(4)); out(find(2)); out(find(9));
}
function others() {
  const fs = []; let n = 0;
  while (n < 3) { const m = n++; switch (m) { case 1: continue; case 2: break; default: fs.push(() => "d" + m); } fs.push(() => m); }
  do { let z = n; fs.push(() => z++); if (n == 4) continue; } while (++n < 6);
  for (let i = 0; i < 3; i++) { try { if (i == 1) throw new Error("x" + i); fs.push(() => i); } catch ({message}) { fs.push(() => message + i); } finally { n += i; } }
  for (var {x, y = 5} of [{x: 1}, {x: 2, y: 3}]) { let w = x; fs.push(() => w + y); }
  for (let i = 0; i < 2; i++) { [1, 2].forEach((one) => { fs.push(() => one * 10 + i); }); }
  all(fs); out(n + x);
}
class Kept { constructor() { this.v = 7; } list() { const fs = []; for (let i of [1, 2]) { fs.push(() => this.v + i); } return fs; } }
function members() { all(new Kept().list()); }
)";
  sameInNode(functions, "  [counts, labels, results, others, members].forEach((f) => run(f.name, f));\n");
}
