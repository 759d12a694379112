// Posts of Fusion: read, linted, run on a job.
#include "bench/Constructs.h"

#include <fmt/format.h>

namespace bench {

namespace {

constexpr const char* kHead =
    "description = \"Bench\";\nextension = \"nc\";\ncapabilities = CAPABILITY_MILLING;\n"
    "var xyzFormat = createFormat({decimals:3});\n"
    "var xOutput = createVariable({prefix:\"X\"}, xyzFormat);\n";
constexpr const char* kTail =
    "function onOpen() {}\nfunction onSection() {}\nfunction onLinear(x, y, z, f) {}\n"
    "function onRapid(x, y, z) {}\nfunction onClose() {}\n";

std::string inOpen(const std::string& statements) {
  return kHead + ("function onOpen() {\n" + statements) +
         "}\nfunction onSection() {}\nfunction onLinear(x, y, z, f) {}\nfunction onRapid(x, y, z) {}\n"
         "function onClose() {}\n";
}

// Some 500 bytes: what a cycle of a probing post writes.
std::string ordinaryFunction(long i) {
  return fmt::format(
      "// Surface {0}.\nfunction writeSurface{0}(cycle, x, y) {{\n"
      "  var approach = (cycle.approach1 == \"positive\") ? 1 : -1;\n"
      "  var target = x + approach * (cycle.probeClearance + tool.diameter / {1});\n"
      "  if (cycle.probeOvertravel > {1}) {{\n"
      "    error(\"Surface {0}: the search is too long.\");\n    return;\n  }}\n"
      "  for (var k = 0; k < {1}; ++k) {{\n"
      "    writeBlock(\"G65\", \"P\" + (9810 + k), xOutput.format(target), \"F\" + cycle.feedrate);\n"
      "  }}\n  writeComment(\"SURFACE {0} \" + xyzFormat.format(y));\n}}\n",
      i, 1 + i % 9);
}

} // namespace

void addFusion(std::vector<Construct>& out) {
  const auto linted = [&](const char* what, long size, std::function<std::string(long)> text) {
    out.push_back({fmt::format("post of Fusion: {}, lint", what), size, [text = std::move(text)](long n) {
                     return Input{{{"a.cps", text(n)}}, {"lint", "--select", "all", "a.cps"}};
                   }});
  };
  const auto ordinary = [](long n) {
    return std::string(kHead) + repeated(2 * n, ordinaryFunction) + "function onOpen() {\n" +
           repeated(2 * n, [](long i) { return fmt::format("  writeSurface{}({{}}, 1, 2);\n", i); }) +
           "}\nfunction onSection() {}\nfunction onClose() {}\n";
  };
  linted("ordinary text (KB)", 60, ordinary);
  out.push_back({"post of Fusion: ordinary text (KB), run-post", 60, [ordinary](long n) {
                   return Input{{{"a.cps", ordinary(n)}}, {"run-post", "a.cps", "--matrix", "probing"}};
                 }});
  linted("statements", 1000, [](long n) {
    return inOpen(repeated(n, [](long i) { return fmt::format("  writeBlock(\"G0\", \"X{}\");\n", i); }));
  });
  linted("functions never called", 500, [](long n) {
    return kHead + repeated(n, [](long i) { return fmt::format("function f{}(a) {{ return a; }}\n", i); }) +
           kTail;
  });
  linted("names defined nowhere", 500, [](long n) {
    return inOpen(repeated(n, [](long i) { return fmt::format("  writeBlok{}(x{});\n", i, i); }));
  });
  linted("variables", 1000, [](long n) {
    return kHead + repeated(n, [](long i) { return fmt::format("var v{} = {};\n", i, i); }) + kTail;
  });
  linted("variables read", 500, [](long n) {
    return kHead + repeated(n, [](long i) { return fmt::format("var v{} = {};\n", i, i); }) +
           "function onOpen() {\n" +
           repeated(n, [](long i) { return fmt::format("  writeBlock(v{});\n", i); }) +
           "}\nfunction onSection() {}\nfunction onClose() {}\n";
  });
  linted("local variables", 500, [](long n) {
    return inOpen(
        repeated(n, [](long i) { return fmt::format("  let v{0} = {0}; writeBlock(v{0});\n", i); }));
  });
  linted("variables twice", 500, [](long n) { return inOpen(times(n, "  var again = 1;\n")); });
  linted("a long sum", 2000, [](long n) { return inOpen("  writeBlock(1" + times(n, " + 1") + ");\n"); });
  linted("a long text", 2000,
         [](long n) { return inOpen("  writeBlock(\"\"" + times(n, " + \"X\"") + ");\n"); });
  linted("conditions", 500, [](long n) {
    return inOpen(
        repeated(n, [](long i) { return fmt::format("  if (unit == {}) {{ error(\"no\"); }}\n", i); }));
  });
  linted("else if", 100, [](long n) {
    return inOpen("  if (unit == 0) {}\n" +
                  repeated(n, [](long i) { return fmt::format("  else if (unit == {}) {{}}\n", i + 1); }));
  });
  linted("cases", 1000, [](long n) {
    return inOpen(
        "  switch (unit) {\n" +
        repeated(n, [](long i) { return fmt::format("  case {}: writeBlock(\"a\"); break;\n", i); }) +
        "  }\n");
  });
  linted("one case many times", 500, [](long n) {
    return inOpen("  switch (unit) {\n" + times(n, "  case 1: writeBlock(\"a\"); break;\n") + "  }\n");
  });
  linted("loops", 500,
         [](long n) { return inOpen(times(n, "  for (var i = 0; i < 3; ++i) { writeBlock(i); }\n")); });
  linted("properties", 500, [](long n) {
    return kHead +
           ("properties = {\n" +
            repeated(n,
                     [](long i) {
                       return fmt::format(
                           "  p{0}: {{title: \"P {0}\", description: \"d\", type: \"boolean\", value: false, "
                           "scope: \"post\"}},\n",
                           i);
                     })) +
           "};\n" + kTail;
  });
  linted("unknown properties", 500, [](long n) {
    return inOpen(repeated(n, [](long i) { return fmt::format("  if (getProperty(\"p{}\")) {{}}\n", i); }));
  });
  linted("members", 1000, [](long n) { return inOpen("  writeBlock(tool" + times(n, ".a") + ");\n"); });
  linted("calls of calls", 500, [](long n) { return inOpen("  writeBlock" + times(n, "()") + ";\n"); });
  linted("arguments", 2000, [](long n) { return inOpen("  writeBlock(1" + times(n, ", 1") + ");\n"); });
  linted("elements", 2000, [](long n) { return kHead + ("var a = [1" + times(n, ", 1")) + "];\n" + kTail; });
  linted("keys", 1000, [](long n) {
    return kHead + ("var a = {z:0" + repeated(n, [](long i) { return fmt::format(", k{}: 1", i); })) +
           "};\n" + kTail;
  });
  linted("one key many times", 500,
         [](long n) { return kHead + ("var a = {z:0" + times(n, ", k: 1")) + "};\n" + kTail; });
  linted("formats", 500, [](long n) {
    return kHead +
           repeated(n, [](long i) { return fmt::format("var f{} = createFormat({{decimals:3}});\n", i); }) +
           kTail;
  });
  linted("templates", 500, [](long n) { return inOpen(times(n, "  writeBlock(`X${1} ${unit}`);\n")); });
  linted("regular expressions", 500, [](long n) { return inOpen(times(n, "  /a+[/]b/.test(\"a\");\n")); });
  linted("arrow functions", 500, [](long n) {
    return kHead + repeated(n, [](long i) { return fmt::format("const g{} = (a) => a + 1;\n", i); }) + kTail;
  });
  linted("comments", 2000, [](long n) { return times(n, "// note\n") + kHead + kTail; });
  linted("comments on one line", 2000, [](long n) { return times(n, "/* */") + "\n" + kHead + kTail; });
  linted("unclosed comments", 2000, [](long n) { return kHead + times(n, "/* "); });
  linted("unclosed texts", 1000, [](long n) { return kHead + times(n, "var a = \"x\n"); });
  linted("unclosed templates", 1000, [](long n) { return kHead + times(n, "`${"); });
  linted("opened brackets", 1000, [](long n) { return kHead + times(n, "("); });
  linted("opened braces", 1000, [](long n) { return kHead + times(n, "{"); });
  linted("closed braces", 1000, [](long n) { return kHead + times(n, "}"); });
  linted("damaged statements", 500, [](long n) { return inOpen(times(n, "  var = ) if ;\n")); });
  linted("suppressions", 500, [](long n) {
    return inOpen(repeated(
        n, [](long i) { return fmt::format("  lost{}(); // dotek: ignore post-undefined-name\n", i); }));
  });
  linted("misspelt suppressions", 200, [](long n) {
    return inOpen(repeated(n, [](long i) {
      return fmt::format("  writeBlock(1); // dotek: ignore post-undefined-nam{}\n", i);
    }));
  });
}

} // namespace bench
