// Time and memory of whole processes: median of some runs, largest resident set, ratio to /bin/true.
//   bench_processes --dotek PROGRAM [--corpus DIR] [--runs N] [--check]
// Run from the root of the repository. --check exits with 1 where a figure is above its bound.
#include "bench/Process.h"
#include "bench/Server.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace bench;

namespace {

struct Case {
  std::string name;
  Command command;
  std::vector<int> statuses; // that mean the work was done
  std::optional<double> mostMilliseconds;
  std::optional<double> mostMegabytes;
};

// A Prog of about `lines` lines: one routine with a branch for each of many cycles.
void writeProg(const fs::path& path, int lines) {
  std::ofstream out(path);
  out << "FORMAT(OpFieldData#,10)\n#10 = '###.##;0'\n\n";
  int written = 3;
  for (int routine = 0; written < lines; ++routine) {
    out << "routine" << routine << ":\n";
    ++written;
    for (int branch = 0; branch < 20 && written < lines; ++branch) {
      out << "IF CycleType?('CYCLE." << routine << "." << branch << "')\n"
          << " ' (CYCLE " << branch << ")' EOL\n"
          << " SeqC ' G65 P9770 Z'OpFieldData#('Zb')'' EOL\n"
          << " IF Flag?('Wide') AND RigidTap?\n"
          << "  SeqC ' G65 P9023 D'OpFieldData#('D')' S'OpFieldData#('G')' I'OpFieldData#('X')'' EOL\n"
          << " ELSE\n"
          << "  SeqC ' #550=#138' EOL {result}\n"
          << " END\n"
          << "END\n";
      written += 9;
    }
    out << "RETURN\n\n";
    written += 2;
  }
}

// As writeProg, for a macro file.
void writeMacro(const fs::path& path, int lines) {
  std::ofstream out(path);
  for (int line = 0; line < lines; line += 4) {
    out << "depth" << line << " = (Zb - retract) * 2 + abs(a) ! approach\n"
        << "if depth" << line << " > 10 then a = a + 1\n"
        << "for k = 1 to 3\nnext k\n";
  }
}

// Programs of the examples over and over, each with a number of its own, from `number` on.
void writeMacros(const fs::path& path, int lines, int number = 1000) {
  std::vector<std::string> programs;
  for (const char* name : {"angle", "bore", "calibrate", "face-z", "tool-break", "web"}) {
    std::ifstream in(fmt::format("examples/macros/{}.nc", name));
    std::string text, line;
    while (std::getline(in, line))
      if (!line.starts_with("%") && !line.starts_with("O")) text += line + "\n";
    programs.push_back(text);
  }
  std::ofstream out(path);
  out << "%\n";
  for (int written = 2; written < lines; ++number) {
    const std::string& text = programs[static_cast<std::size_t>(number) % programs.size()];
    out << "O" << number << "(COPY)\n" << text;
    written += 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  }
  out << "%\n";
}

std::vector<fs::path> sortedEntries(const fs::path& folder) {
  std::vector<fs::path> out;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder))
      out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

// Cycles of the corpus that post with their default values, under numbers: names of a shop are in its
// data only.
void addCorpus(std::vector<Case>& out, const std::string& dotek, const fs::path& corpus) {
  const std::vector<fs::path> posts = sortedEntries(corpus / "compost");
  if (posts.empty()) return;
  int number = 0;
  for (const fs::path& folder : sortedEntries(corpus / "gibbs")) {
    ++number;
    const Command post = {dotek,
                          "post",
                          folder.string(),
                          "--prog",
                          posts.front().string(),
                          "--recover",
                          "--seq",
                          "90:10",
                          "--clearance",
                          "5",
                          "--assume",
                          "missing-field-zero"};
    if (runOnce(post).status == 0)
      out.push_back({fmt::format("post, corpus cycle {}", number), post, {0}, 12, 30});
    const Command convert = {dotek,       "convert", folder.string(), "--prog",   posts.front().string(),
                             "--recover", "--to",    "fanuc",         "--assume", "missing-field-zero"};
    if (runOnce(convert).status == 0)
      out.push_back({fmt::format("convert, corpus cycle {}", number), convert, {0}, 15, 30});
    out.push_back(
        {fmt::format("lint, corpus cycle {}", number), {dotek, "lint", folder.string()}, {0, 1}, {}, {}});
  }
}

// A program of so many moves: faces in rows.
void writeRows(const fs::path& path, int moves) {
  std::ofstream out(path);
  out << "%\nO0001\nG90 G54 G0 X0 Y0 Z2.\nG1 Z0 F200.\n";
  for (int i = 0; i < moves; ++i)
    out << fmt::format("X{:.3f} Y{:.3f}\n", i % 2 == 0 ? 120.0 : 0.0, 80.0 * i / moves);
  out << "G0 Z50.\nM30\n%\n";
}

// What a CAM prints for a mould: passes of short moves with three decimals, a tool change now and then.
void writeMould(const fs::path& path, std::uint64_t bytes) {
  std::ofstream out(path);
  std::string text = "%\nO0001\nG21 G17 G40 G49 G80 G90\n";
  std::uint64_t written = 0;
  std::uint32_t random = 7;
  const auto step = [&](int most) {
    random = random * 1664525 + 1013904223;
    return static_cast<int>(random >> 16) % (2 * most + 1) - most;
  };
  int x = 0, y = 0, z = -10000; // in thousandths
  for (int move = 0; written + text.size() < bytes; ++move) {
    if (move % 60000 == 0)
      text +=
          fmt::format("G0 Z50.\nM5\nT{0} M6\nG54 G90 G0 X0. Y0. S12000 M3\nG43 Z50. H{0}\nM8\nZ5.\nG1 Z-10. "
                      "F800.\nF3000.\n",
                      move / 60000 % 40 + 1);
    x += step(1000);
    z += step(200);
    if (move % 3 == 0) y += step(100);
    if (move % 200 == 199)
      text += fmt::format("G0 Z5.\nX{:.3f} Y{:.3f}\nG1 Z{:.3f}\n", x / 1000., y / 1000., z / 1000.);
    else if (move % 3 == 0)
      text += fmt::format("X{:.3f} Y{:.3f} Z{:.3f}\n", x / 1000., y / 1000., z / 1000.);
    else
      text += fmt::format("X{:.3f} Z{:.3f}\n", x / 1000., z / 1000.);
    if (text.size() < (1U << 16)) continue;
    out << text;
    written += text.size();
    text.clear();
  }
  out << text << "G0 Z50.\nM5\nM30\n%\n";
}

// Pictures of a run: of a macro that touches a part five times, and of a long program without a part.
void addPictures(std::vector<Case>& out, const std::string& dotek, const fs::path& scratch) {
  const Command bore = {dotek,
                        "sim",
                        "examples/macros/bore.nc",
                        "--call",
                        "D30. Z-5. S55",
                        "--part",
                        "examples/macros/plate.toml",
                        "--machine",
                        "examples/macros/mill.toml",
                        "--at",
                        "30,40,10",
                        "--var",
                        "520=5.97",
                        "--quiet"};
  writeRows(scratch / "rows.nc", 100'000);
  const Command rows = {dotek, "sim", (scratch / "rows.nc").string(), "--quiet"};
  const auto add = [&](const std::string& name, Command command, const char* flag, double most) {
    command.emplace_back(flag);
    command.push_back((scratch / "picture").string() + (std::string(flag) == "--svg" ? ".svg" : ".html"));
    out.push_back({name, std::move(command), {0}, most, {}});
  };
  out.push_back({"sim, macro with a part", bore, {0}, {}, {}});
  add("sim --svg, the same", bore, "--svg", 30);
  add("sim --html, the same", bore, "--html", 120);
  add("sim --svg, 100,000 moves", rows, "--svg", 450);
  add("sim --html, 100,000 moves", rows, "--html", 450);
}

std::vector<Case> cases(const std::string& dotek, const std::string& corpus, const fs::path& scratch) {
  std::vector<Case> out;
  out.push_back({"list limits (nothing parsed)", {dotek, "list", "limits"}, {0}, {}, {}});
  out.push_back({"post, example cycle",
                 {dotek, "post", "examples/surface-x", "--prog", "examples/post.txt", "--routine", "probe",
                  "--seq", "10:10", "--clearance", "5", "--set", "G=54"},
                 {0},
                 12,
                 30});
  out.push_back({"convert, example cycle",
                 {dotek, "convert", "examples/surface-x", "--prog", "examples/post.txt", "--to", "fanuc",
                  "--probe-macros", "inspection-plus"},
                 {0},
                 15,
                 30});
  out.push_back({"lint, example folder", {dotek, "lint", "examples/surface-x"}, {0, 1}, {}, {}});
  addCorpus(out, dotek, corpus);
  writeProg(scratch / "long-post.txt", 4000);
  writeMacro(scratch / "long.mac", 4000);
  out.push_back(
      {"lint, Prog of 4,000 lines", {dotek, "lint", (scratch / "long-post.txt").string()}, {0, 1}, 60, {}});
  out.push_back(
      {"lint, macro of 4,000 lines", {dotek, "lint", (scratch / "long.mac").string()}, {0, 1}, {}, {}});
  fs::create_directories(scratch / "shop");
  for (int file = 0; file < 200; ++file)
    writeMacros(scratch / "shop" / fmt::format("{}.nc", file), 100, 1000 + 10 * file);
  const Command shop = {dotek, "lint", (scratch / "shop").string()};
  Command kept = shop;
  kept.insert(kept.end(), {"--cache", (scratch / "shop-cache").string()});
  out.push_back({"lint, folder of 200 files", shop, {0, 1}, {}, {}});
  out.push_back({"the same from --cache", kept, {0, 1}, {}, {}});
  writeMacros(scratch / "macros.nc", 5000);
  writeRows(scratch / "blocks.nc", 5000);
  for (const auto& [name, file] : {std::pair{"lint, macro programs of 5,000 lines", "macros.nc"},
                                   std::pair{"lint, one program of 5,000 blocks", "blocks.nc"}})
    out.push_back({name, {dotek, "lint", (scratch / file).string()}, {0, 1}, 50, {}});
  addPictures(out, dotek, scratch);
  return out;
}

} // namespace

int main(int argc, char** argv) {
  std::string dotek = "build/release/dotek";
  std::string corpus;
  int runs = 20;
  bool check = false;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    const bool more = i + 1 < argc;
    if (flag == "--dotek" && more)
      dotek = argv[++i];
    else if (flag == "--corpus" && more)
      corpus = argv[++i];
    else if (flag == "--runs" && more)
      runs = std::max(1, std::atoi(argv[++i]));
    else if (flag == "--check")
      check = true;
    else {
      fmt::print(stderr, "bench_processes --dotek PROGRAM [--corpus DIR] [--runs N] [--check]\n");
      return 2;
    }
  }
  const fs::path scratch = fs::path(dotek).parent_path() / "bench";
  fs::create_directories(scratch);

  const Figures base = measure({"/bin/true"}, runs);
  fmt::print("median of {} runs, whole processes\n\n", runs);
  fmt::print("| work | ms | x /bin/true | MB | bound |\n|---|---|---|---|---|\n");
  fmt::print("| /bin/true | {:.2f} | 1.0 | {:.1f} | |\n", base.median, base.megabytes);
  bool missed = false;
  bool broken = false;
  const auto row = [&](const Case& one, const Figures& figures) {
    if (std::find(one.statuses.begin(), one.statuses.end(), figures.status) == one.statuses.end()) {
      fmt::print("| {} | exit status {}: not measured | | | |\n", one.name, figures.status);
      broken = true;
      return;
    }
    std::string bound;
    if (one.mostMilliseconds) bound += fmt::format("{} ms", *one.mostMilliseconds);
    if (one.mostMegabytes) bound += fmt::format(", {} MB", *one.mostMegabytes);
    const bool over = (one.mostMilliseconds && figures.median > *one.mostMilliseconds) ||
                      (one.mostMegabytes && figures.megabytes > *one.mostMegabytes);
    missed = missed || over;
    const std::string megabytes = figures.megabytes > 0 ? fmt::format("{:.1f}", figures.megabytes) : "";
    fmt::print("| {} | {:.2f} | {:.1f} | {} | {}{} |\n", one.name, figures.median,
               figures.median / base.median, megabytes, bound, over ? " MISSED" : "");
  };
  for (const Case& one : cases(dotek, corpus, scratch))
    row(one, measure(one.command, runs));
  row({"lsp, cycle folder: from a change to its findings", {}, {0}, 10, {}},
      measureChanges(dotek, "examples/surface-x/ToolPath.mac", "dotek-gibbs", runs));
  row({"lsp, macro programs of 5,000 lines: the same", {}, {0}, {}, {}},
      measureChanges(dotek, (scratch / "macros.nc").string(), "dotek-macrob", runs));
  const fs::path mould = scratch / "mould.nc";
  writeMould(mould, 100'000'000);
  const int few = std::min(runs, 5);
  const Figures counted = measure({"/usr/bin/wc", "-l", mould.string()}, few);
  const Figures linted = measure({dotek, "lint", mould.string()}, few);
  row({"wc -l, 100 MB of a CAM", {}, {0}, {}, {}}, counted);
  row({"lint, the same", {}, {0, 1}, 500, 300}, linted);
  fmt::print("\nlint of 100 MB of a CAM: {:.0f} MB/s, {:.1f} times wc -l\n",
             static_cast<double>(fs::file_size(mould)) / 1000 / linted.median,
             linted.median / counted.median);
  return broken || (check && missed) ? 1 : 0;
}
