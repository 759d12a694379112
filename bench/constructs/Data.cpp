// Files of data: settings, jobs, parts, machines, controls, forms, macro sets, meshes; many files; findings
// as output.
#include "bench/Constructs.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace bench {

namespace {

const char* const kProgram = "%\nO1\nG21 G90 G54\nG0 X1.\nM30\n%\n";
const char* const kPart = "schema = 1\n[place]\nshift = [-300.0, -200.0, -400.0]\n";
const char* const kMachine =
    "schema = 1\n[probe]\nball_diameter = 6.0\nlength = 180.0\nlength_to = \"tip\"\non = true\n";

Input run(std::vector<std::pair<std::string, std::string>> files, std::vector<std::string> arguments) {
  files.emplace_back("a.nc", kProgram);
  return {std::move(files), std::move(arguments)};
}

using Triangle = std::array<std::array<double, 3>, 3>;

std::string binaryStl(const std::vector<Triangle>& triangles) {
  std::string out(80, ' ');
  const auto put = [&](const auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out.append(bytes, sizeof value);
  };
  put(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& triangle : triangles) {
    for (int i = 0; i < 3; ++i)
      put(0.F);
    for (const auto& corner : triangle)
      for (const double value : corner)
        put(static_cast<float>(value));
    put(std::uint16_t{0});
  }
  return out;
}

std::string textStl(const std::vector<Triangle>& triangles) {
  std::string out = "solid a\n";
  for (const Triangle& t : triangles) {
    out += "facet normal 0 0 0\nouter loop\n";
    for (const auto& c : t)
      out += fmt::format("vertex {} {} {}\n", c[0], c[1], c[2]);
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid a\n";
}

// A disc of n sectors, 10 mm thick: two corners that all n sectors share.
std::vector<Triangle> fan(long n) {
  n = std::max(3L, n);
  std::vector<Triangle> out;
  const auto at = [n](long i, double z) {
    const double angle = 2 * std::acos(-1.0) * static_cast<double>(i % n) / static_cast<double>(n);
    return std::array<double, 3>{50 * std::cos(angle), 50 * std::sin(angle), z};
  };
  for (long i = 0; i < n; ++i) {
    out.push_back({{{0, 0, 10}, at(i, 10), at(i + 1, 10)}});
    out.push_back({{{0, 0, 0}, at(i + 1, 0), at(i, 0)}});
    out.push_back({{at(i, 0), at(i + 1, 0), at(i + 1, 10)}});
    out.push_back({{at(i, 0), at(i + 1, 10), at(i, 10)}});
  }
  return out;
}

// A box whose upper face is a field of k by k bumps, k * k about n.
std::vector<Triangle> field(long n) {
  const long k = std::max(2L, std::lround(std::sqrt(static_cast<double>(n))));
  const auto up = [](long i, long j) {
    return std::array<double, 3>{static_cast<double>(i), static_cast<double>(j),
                                 10 + static_cast<double>((i * 7 + j * 3) % 5) / 10};
  };
  const auto low = [](long i, long j) {
    return std::array<double, 3>{static_cast<double>(i), static_cast<double>(j), 0};
  };
  std::vector<Triangle> out;
  for (long i = 0; i < k; ++i)
    for (long j = 0; j < k; ++j) {
      out.push_back({{up(i, j), up(i + 1, j), up(i + 1, j + 1)}});
      out.push_back({{up(i, j), up(i + 1, j + 1), up(i, j + 1)}});
      out.push_back({{low(i, j), low(i + 1, j + 1), low(i + 1, j)}});
      out.push_back({{low(i, j), low(i, j + 1), low(i + 1, j + 1)}});
    }
  const auto wall = [&](long i, long j, long p, long q) {
    out.push_back({{low(i, j), low(p, q), up(p, q)}});
    out.push_back({{low(i, j), up(p, q), up(i, j)}});
  };
  for (long i = 0; i < k; ++i) {
    wall(i, 0, i + 1, 0);
    wall(k, i, k, i + 1);
    wall(i + 1, k, i, k);
    wall(0, i + 1, 0, i);
  }
  return out;
}

} // namespace

void addData(std::vector<Construct>& out) {
  const auto add = [&](const char* what, long size, std::vector<std::string> arguments, std::string file,
                       std::function<std::string(long)> text) {
    out.push_back({what, size, [text = std::move(text), arguments, file](long n) {
                     return run({{file, text(n)}}, arguments);
                   }});
  };
  const auto list = [](long n) {
    return repeated(n, [](long i) { return fmt::format("\"code-{}\", ", i); });
  };
  add("dotek.toml: codes on one line", 1000, {"lint", "a.nc"}, "dotek.toml",
      [=](long n) { return "schema = 1\n[lint]\nignore = [" + list(n) + "]\n"; });
  add("dotek.toml: known codes on one line", 1000, {"lint", "a.nc"}, "dotek.toml",
      [=](long n) { return "schema = 1\n[lint]\nignore = [" + times(n, "\"indentation\", ") + "]\n"; });
  add("dotek.toml: codes on lines", 1000, {"lint", "a.nc"}, "dotek.toml",
      [](long n) { return "schema = 1\n[lint]\nignore = [\n" + times(n, "\"indentation\",\n") + "]\n"; });
  add("dotek.toml: keys of one line", 500, {"lint", "a.nc"}, "dotek.toml", [](long n) {
    return "schema = 1\nlint = { " + repeated(n, [](long i) { return fmt::format("k{} = 1, ", i); }) +
           "select = [\"all\"] }\n";
  });
  add("dotek.toml: unknown keys", 500, {"lint", "a.nc"}, "dotek.toml", [](long n) {
    return "schema = 1\n[lint]\n" + repeated(n, [](long i) { return fmt::format("k{} = 1\n", i); });
  });
  add("dotek.toml: severities", 500, {"lint", "a.nc"}, "dotek.toml", [](long n) {
    return "schema = 1\n[lint.severity]\n" +
           repeated(n, [](long i) { return fmt::format("code-{} = \"note\"\n", i); });
  });
  add("dotek.toml: a long comment", 20000, {"lint", "a.nc"}, "dotek.toml",
      [](long n) { return "schema = 1\n# " + times(n, "note ") + "\n"; });
  add("dotek.toml: comments", 4000, {"lint", "a.nc"}, "dotek.toml",
      [](long n) { return "schema = 1\n" + times(n, "# note\n"); });
  add("dotek.toml: tables", 500, {"lint", "a.nc"}, "dotek.toml",
      [](long n) { return "schema = 1\n" + repeated(n, [](long i) { return fmt::format("[t{}]\n", i); }); });
  add("dotek.toml: a long text", 20000, {"lint", "a.nc"}, "dotek.toml",
      [](long n) { return "schema = 1\nform = \"" + times(n, "a") + "\"\n"; });

  const auto job = [&](const char* what, long size, std::function<std::string(long)> operations) {
    out.push_back({what, size, [operations = std::move(operations)](long n) {
                     return Input{
                         {{"a/DefineData.txt", "X = 12\n"},
                          {"a/CycleData.dlg", "dialog \"A\", 40, 40, 420, 290\ninput 90, 80, 70, 24, X, "
                                              "X\ncancel 230, 230, 80, 28\nok 130, 230, 80, 28\n"},
                          {"a/CycleData.mac", "dialog \"CycleData.dlg\"\n"},
                          {"a/ToolPath.mac", "add_custom_drill_cycle_path feed_x, X\n"},
                          {"post.txt", "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\nprobe:\nIF "
                                       "CycleType?('a')\n SeqC ' X'OpFieldData#('X') EOL\nEND\nRETURN\n"},
                          {"job.toml", "schema = 1\nroutines = { operation = \"probe\" }\n" + operations(n)}},
                         {"post", "a", "--prog", "post.txt", "--job", "job.toml", "--clearance", "5"}};
                   }});
  };
  job("job: operations on one line", 200, [](long n) {
    return "operation = [ " +
           repeated(n,
                    [](long i) {
                      return fmt::format("{{ cycle = \"a\", at = [[1.0, 2.0]], set = {{ X = {}.0 }} }}, ",
                                         1 + i);
                    }) +
           "]\n";
  });
  job("job: operations on lines", 200, [](long n) {
    return "operation = [\n" +
           repeated(n,
                    [](long i) {
                      return fmt::format("{{ cycle = \"a\", at = [[1.0, 2.0]], set = {{ X = {}.0 }} }},\n",
                                         1 + i);
                    }) +
           "]\n";
  });
  job("job: points of an operation", 200, [](long n) {
    return "operation = [ { cycle = \"a\", at = [ " +
           repeated(n, [](long i) { return fmt::format("[{}.0, 2.0], ", i); }) + "] } ]\n";
  });
  job("job: fields of an operation", 200, [](long n) {
    return "operation = [ { cycle = \"a\", at = [[1.0, 2.0]], set = { " +
           repeated(n, [](long i) { return fmt::format("F{} = 1.0, ", i); }) + "X = 1.0 } } ]\n";
  });

  add("machine: tools", 500, {"sim", "--quiet", "a.nc", "--machine", "m.toml"}, "m.toml", [](long n) {
    return kMachine + repeated(n, [](long i) {
             return fmt::format("[[tool]]\nnumber = {}\nlength = 82.4\ndiameter = 10.0\n", i + 2);
           });
  });
  add("machine: tools on one line", 500, {"sim", "--quiet", "a.nc", "--machine", "m.toml"}, "m.toml",
      [](long n) {
        return "tool = [ " +
               repeated(n,
                        [](long i) {
                          return fmt::format("{{ number = {}, length = 82.4, diameter = 10.0 }}, ", i + 2);
                        }) +
               "]\n" + kMachine;
      });
  add("part: shapes", 20, {"sim", "--quiet", "a.nc", "--part", "p.toml"}, "p.toml", [](long n) {
    return kPart + repeated(n, [](long i) {
             return fmt::format(
                 "[[shape]]\nkind = \"box\"\nmin = [{0}.0, 0.0, 0.0]\nmax = [{0}.5, 1.0, 1.0]\n", i);
           });
  });
  add("part: unknown keys", 500, {"sim", "--quiet", "a.nc", "--part", "p.toml"}, "p.toml",
      [](long n) { return kPart + repeated(n, [](long i) { return fmt::format("k{} = 1\n", i); }); });
  struct Stl {
    const char* what;
    std::vector<Triangle> (*make)(long);
    long size;
  };
  for (const Stl& stl : {Stl{"fan", fan, 300}, Stl{"field", field, 1500}}) {
    for (const bool binary : {true, false}) {
      for (const bool page : {false, true}) {
        if (page && !binary) continue;
        std::vector<std::string> arguments = {"sim",    "--quiet",   "a.nc",  "--part",
                                              "p.toml", "--machine", "m.toml"};
        if (page) arguments.insert(arguments.end(), {"--html", "o.html", "--svg", "o.svg"});
        out.push_back({fmt::format("STL: {} {}, {}", binary ? "binary" : "text", stl.what,
                                   page ? "sim with pictures" : "sim"),
                       stl.size, [arguments, binary, make = stl.make](long n) {
                         return run(
                             {{"p.toml", std::string(kPart) +
                                             "[[shape]]\nkind = \"mesh\"\nfile = \"m.stl\"\nunit = \"mm\"\n"},
                              {"m.toml", kMachine},
                              {"m.stl", binary ? binaryStl(make(n)) : textStl(make(n))}},
                             arguments);
                       }});
      }
    }
  }

  add("data: a file of many tables", 200, {"list", "controls", "--data", "d"}, "d/controls/ours.toml",
      [](long n) {
        return "schema = 1\ntitle = \"Ours\"\n" + repeated(n, [](long i) {
                 return fmt::format(
                     "[[codes]]\ngrade = \"observed\"\nsource = \"x\"\nlist = [\"M{}: title\"]\n", 100 + i);
               });
      });
  add("data: codes on one line", 500, {"list", "controls", "--data", "d"}, "d/controls/ours.toml",
      [](long n) {
        return "schema = 1\ntitle = \"Ours\"\n[[codes]]\ngrade = \"observed\"\nsource = \"x\"\nlist = [" +
               repeated(n, [](long i) { return fmt::format("\"M{}: title\", ", 100 + i); }) + "]\n";
      });
  add("data: commands of a form", 300, {"list", "forms", "--data", "d"}, "d/forms/ours.toml", [](long n) {
    return "schema = 1\n" + repeated(n, [](long i) {
             return fmt::format(
                 "[[command]]\nname = \"C{}\"\ntext = \" M5\"\ngrade = \"observed\"\nsource = \"x\"\n", i);
           });
  });
  add("data: signatures of a macro set", 100, {"list", "macros", "--data", "d"}, "d/macros/ours.toml",
      [](long n) {
        return "schema = 1\ntitle = \"Ours\"\n" + repeated(n, [](long i) {
                 return fmt::format(
                     "[[signature]]\nprogram = {}\ntitle = \"t\"\nintent = \"protected-move\"\ngrade = "
                     "\"documented\"\nsource = \"x\"\nany_of = \"XYZ\"\narguments = [\n{{ letter = \"X\", "
                     "role = \"target\", axis = \"X\", frame = \"work\" }},\n]\n",
                     1000 + i);
               });
      });

  out.push_back({"files: programs in a folder, lint", 100, [](long n) {
                   Input made{{}, {"lint", "--select", "all", "."}};
                   for (long i = 0; i < n; ++i)
                     made.files.emplace_back(
                         fmt::format("O{}.nc", i + 1),
                         fmt::format("%\nO{}\nG65 P{} X1.\nM98 P9000\n#100=#5061\nM99\n%\n", i + 1, i + 2));
                   return made;
                 }});
  // Each file is reached through all folders above it, by the system as well, to the depth that is read.
  out.push_back({"files: folders one in another, lint", 200, [](long n) {
                   Input made{{}, {"lint", "--select", "all", "."}};
                   for (long i = 0; i < n; ++i)
                     made.files.emplace_back(times(i, "d/") + fmt::format("O{}.nc", i + 1),
                                             fmt::format("%\nO{}\n#100=#5061\nM99\n%\n", i + 1));
                   return made;
                 }});
  out.push_back({"files: programs of one number, lint", 100, [](long n) {
                   Input made{{}, {"lint", "--select", "all", "."}};
                   for (long i = 0; i < n; ++i)
                     made.files.emplace_back(fmt::format("a{}.nc", i + 1), "%\nO7\nG65 P7 X1.\nM99\n%\n");
                   return made;
                 }});
  out.push_back({"files: macros in a folder, lint", 100, [](long n) {
                   Input made{{}, {"lint", "--select", "all", "."}};
                   for (long i = 0; i < n; ++i)
                     made.files.emplace_back(fmt::format("m{}.mac", i + 1), "x = 1\nif x > 2 then y = 3\n");
                   return made;
                 }});
  out.push_back({"files: programs beside a run, sim", 100, [](long n) {
                   Input made = run({}, {"sim", "--quiet", "a.nc", "--programs", "lib"});
                   for (long i = 0; i < n; ++i)
                     made.files.emplace_back(fmt::format("lib/O{}.nc", i + 10),
                                             fmt::format("%\nO{}\nM99\n%\n", i + 10));
                   return made;
                 }});
  for (const char* format : {"json", "sarif", "text"})
    add("", 200, {"lint", "--select", "all", "--max-errors", "100000", "--format", format, "b.nc"}, "b.nc",
        [](long n) { return "%\nO1\n" + times(n, "G1 X1. X2. M3.0\n") + "M30\n%\n"; }),
        out.back().name = fmt::format("findings as {}", format);
  out.push_back(
      {"arguments: --var", 500, [](long n) {
         Input made = run({}, {"sim", "--quiet", "a.nc"});
         for (long i = 0; i < n; ++i)
           made.arguments.insert(made.arguments.end(), {"--var", fmt::format("{}=1", 500 + i % 500)});
         return made;
       }});
}

} // namespace bench
