// Files of the cycle language.
#include "bench/Constructs.h"

#include <fmt/format.h>

namespace bench {
namespace {

using Text = std::function<std::string(long)>;

std::string cycle(const std::string& declarations, const std::string& statements) {
  return "// Grows.\ncycle grows \"A\"\n\n" + declarations + "\nspindle off\nprobe on\n" + statements +
         "probe off\n";
}

class Constructs {
public:
  explicit Constructs(std::vector<Construct>& out) : out_(out) {}

  void add(const char* what, long size, const std::vector<std::string>& command, Text text) {
    out_.push_back({fmt::format("cycle: {}, {}", what, command.front()), size,
                    [text = std::move(text), command](long n) {
                      return Input{{{"grows.cycle", text(n)}}, command};
                    }});
  }
  void checked(const char* what, long size, Text text) {
    add(what, size, {"check", "grows.cycle"}, std::move(text));
  }
  // As every command reads it.
  void everywhere(const char* what, long size, const Text& text) {
    checked(what, size, text);
    add(what, size, {"fmt", "grows.cycle"}, text);
    add(what, size, {"lint", "--select", "all", "grows.cycle"}, text);
    add(what, size, {"dump", "grows.cycle", "--stage", "ir"}, text);
    add(what, size, {"sim", "grows.cycle", "--part", "none", "--quiet"}, text);
    add(what, size, {"convert", "grows.cycle", "--to", "fanuc", "--probe-macros", "dotek"}, text);
  }

private:
  std::vector<Construct>& out_;
};

void addStatements(Constructs& to) {
  to.everywhere("moves", 300,
                [](long n) { return cycle("", times(n, "move by x 1 mm\nmove by x -1 mm\n")); });
  to.everywhere("values", 300, [](long n) {
    return cycle("parameter d : length = 5 mm \"D\"\n",
                 repeated(n, [](long i) { return fmt::format("v{} = d * 2 + {} mm\n", i, i); }));
  });
  to.everywhere("touches", 100, [](long n) {
    return cycle("", repeated(n, [](long i) {
                   return fmt::format("touch x by 10 mm -> s{} else\n  move by z 1 mm\nend\n", i);
                 }));
  });
  to.everywhere("choices", 200, [](long n) {
    return cycle("parameter d : length = 5 mm \"D\"\n", repeated(n, [](long i) {
                   return fmt::format("if d > {} mm then\n  move by x 1 mm\nend\n", i);
                 }));
  });
  to.everywhere("calls", 20, [](long n) {
    return cycle("", "probe off\n" + repeated(n, [](long i) {
                       return fmt::format("call bore diameter = {} mm -> b{}\n", 20 + i % 9, i);
                     }));
  });
  to.everywhere("places where it began", 100, [](long n) {
    return cycle("", times(n, "protected move by x 1 mm\nprotected move to start\n"));
  });
  to.checked("one loop after another", 300,
             [](long n) { return cycle("", times(n, "repeat 2 times\n  move by x 1 mm\nend\n")); });
  to.checked("branches of one choice", 300, [](long n) {
    return cycle("parameter d : length = 5 mm \"D\"\n",
                 "if d > 1 mm then\n  dwell 1 s\n" + repeated(n, [](long i) {
                   return fmt::format("else if d > {} mm then\n  dwell 2 s\n", i + 2);
                 }) + "end\n");
  });
}

void addDeclarations(Constructs& to) {
  to.everywhere("parameters", 100, [](long n) {
    return cycle(repeated(n, [](long i) { return fmt::format("parameter p{} : length = 1 mm \"P\"\n", i); }),
                 "");
  });
  to.everywhere("results", 100, [](long n) {
    return cycle(repeated(n, [](long i) { return fmt::format("result r{} : length \"R\"\n", i); }),
                 repeated(n, [](long i) { return fmt::format("r{} = {} mm\n", i, i); }));
  });
  to.checked("checks", 300, [](long n) {
    return cycle("parameter d : length = 5 mm \"D\"\n" +
                     repeated(n, [](long i) { return fmt::format("require d > {} mm \"Not {}\"\n", -i, i); }),
                 "");
  });
  to.checked("names without a value", 300, [](long n) {
    return cycle("", repeated(n, [](long i) { return fmt::format("u = y{}\n", i); }));
  });
  to.checked("names in a choice", 1000, [](long n) {
    return cycle("parameter c : choice of a0" + repeated(n, [](long i) { return fmt::format(", b{}", i); }) +
                     " \"C\"\n",
                 "");
  });
}

void addConversions(Constructs& to) {
  const Text sums = [](long n) {
    return "cycle grows \"A\"\n" +
           repeated(n, [](long i) { return fmt::format("parameter p{0} : length = 1 mm \"P{0}\"\n", i); }) +
           "spindle off\n" + repeated(n, [](long i) { return fmt::format("move by x p{}\n", i); });
  };
  to.add("parameters of one move each", 300,
         {"convert", "grows.cycle", "--to", "gibbs", "--probe-macros", "dotek", "--host",
          "approach_feed=1000", "-d", "out", "--force"},
         sums);
  to.everywhere("parameters of one move each", 200, sums);
  to.checked("touches before a set", 60, [](long n) {
    return cycle("", repeated(n, [](long i) {
                       return fmt::format("touch x by 10 mm -> s{0}\nt{0} = s{0} + 1 mm\n", i);
                     }) + "set G54 x = s0\n");
  });
}

void addText(Constructs& to) {
  to.checked("comments", 2000, [](long n) { return cycle("", times(n, "// a comment\n")); });
  to.add("comments", 2000, {"fmt", "grows.cycle"},
         [](long n) { return cycle("", times(n, "// a comment\n")); });
  to.checked("one long sum", 500, [](long n) { return cycle("", "u = 1 mm" + times(n, " + 1 mm") + "\n"); });
  to.checked("a sum over lines", 500,
             [](long n) { return cycle("", "u = 1 mm" + times(n, " +\n  1 mm") + "\n"); });
  to.checked("a condition", 500, [](long n) {
    return cycle("parameter d : length = 5 mm \"D\"\n",
                 "if d > 1 mm" + times(n, " and d > 2 mm") + " then\n  dwell 1 s\nend\n");
  });
  to.checked("brackets not closed", 500, [](long n) { return cycle("", "u = " + times(n, "(") + "1 mm\n"); });
  to.checked("blocks not ended", 500, [](long n) { return cycle("", times(n, "repeat 2 times\n")); });
  to.checked("ends of nothing", 500, [](long n) { return cycle("", times(n, "end\n")); });
  to.checked("words that are none", 500, [](long n) { return cycle("", times(n, "zzz yyy\n")); });
  to.checked("one text", 5000, [](long n) { return cycle("", "alarm \"" + times(n, "a ") + "\"\n"); });
  to.checked("quotes", 500, [](long n) { return cycle("", times(n, "\"\n")); });
}

} // namespace

void addCycle(std::vector<Construct>& out) {
  Constructs to(out);
  addStatements(to);
  addDeclarations(to);
  addConversions(to);
  addText(to);
}

} // namespace bench
