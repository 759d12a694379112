// How much of what goes wrong lint finds: docs/lint-mutation.md. DOTEK_MUTANTS_OUT=FILE writes the table of
// the survivors, DOTEK_MUTANTS_SEEDS=N draws N times as many, DOTEK_MUTANTS_ALL=FILE writes every mutant.
#include "driver/Driver.h"
#include "lint/Rule.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/unit/DataFolder.h"
#include "tests/unit/Mutants.h"

#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <random>
#include <set>

namespace fs = std::filesystem;
using namespace dotek;
using namespace dotek::tests;

namespace {

constexpr std::size_t kMutants = 400;
constexpr double kLeast = 0.85;

char kindOf(const fs::path& path) {
  const std::string name = path.filename().string();
  const std::string suffix = path.extension().string();
  if (name == "DefineData.txt") return 'd';
  if (suffix == ".mac") return 'm';
  if (suffix == ".dlg") return 'l';
  if (suffix == ".txt") return 'p';
  if (suffix == ".nc") return 'n';
  return suffix == ".suf" ? 's' : '\0';
}

// A folder of inputs that belong together, or one file.
Bundle bundleOf(const fs::path& path) {
  Bundle out{path.filename().string(), {}};
  std::vector<fs::path> files;
  if (fs::is_directory(path)) {
    for (const auto& entry : fs::recursive_directory_iterator(path)) {
      // Sums over the tables of a device, formulas of a surface: what is meant is in no program, and they
      // probe nothing.
      const std::string name = entry.path().generic_string();
      if (name.find("ram-compensation") != std::string::npos) continue;
      if (name.find("pocket-6m") != std::string::npos) continue;
      if (name.find("examples/stock") != std::string::npos) continue;
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
  } else {
    files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    std::string text = readAll(file);
    const char kind = kindOf(file);
    std::string code = kind == '\0' ? text : withoutComments(text, kind);
    const fs::path name = file == path ? file.filename() : fs::relative(file, path);
    out.files.push_back({name.generic_string(), std::move(text), std::move(code), kind});
  }
  return out;
}

std::vector<Bundle> bundlesOf(const std::string& set) {
  std::vector<Bundle> out;
  if (set == "first") out.push_back(bundleOf(root() / "examples"));
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(root() / "tests" / "lint-inputs" / set))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    if (path.filename() != "nc" && path.filename() != "suf") {
      out.push_back(bundleOf(path));
      continue;
    }
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(path))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files)
      out.push_back(bundleOf(file));
  }
  return out;
}

// The files of a bundle on disk, one of them changed.
class Written {
public:
  explicit Written(const Bundle& bundle) : bundle_(bundle) {
    for (const InputFile& file : bundle.files)
      folder_.write(file.name, file.text);
  }
  void change(std::size_t file, const Change& edit) const {
    folder_.write(bundle_.files[file].name, mutated(bundle_.files[file], edit));
  }
  void restore(std::size_t file) const { folder_.write(bundle_.files[file].name, bundle_.files[file].text); }
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }

  // All that is at the top, as the arguments of a command line.
  std::vector<std::string> paths() const {
    std::set<std::string> out;
    for (const InputFile& file : bundle_.files)
      if (file.kind != '\0' || file.text.find("\noperation") != std::string::npos) // of the others only jobs
        out.insert(path(file.name.substr(0, file.name.find('/'))));
    return {out.begin(), out.end()};
  }
  const Bundle& bundle() const { return bundle_; }

private:
  const Bundle& bundle_;
  DataFolder folder_;
};

// Codes of the findings.
std::set<std::string> findings(const Written& written) {
  driver::LintOptions options;
  options.paths = written.paths();
  options.select = std::set<std::string>{"all"};
  options.ignore = {"suf-no-probe"}; // lathes that have one
  std::set<std::string> out;
  const driver::Outcome outcome = driver::lint(options);
  for (const Diagnostic& d : outcome.diagnostics.all())
    out.insert(std::string(d.code));
  return out;
}

bool isDefault(const std::string& code) {
  for (const lint::CodeInfo& info : lint::codeTable())
    if (info.code == code) return info.byDefault;
  return true;
}

// ---- what a mutant means
// ------------------------------------------------------------------------------------

std::string withoutBlanks(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (c != ' ' && c != '\t' && c != '\r') out += c;
  return out;
}

std::string verdict(const driver::Outcome& outcome) {
  std::string out = std::to_string(outcome.status) + "\n" + outcome.output;
  for (const Diagnostic& d : outcome.diagnostics.all())
    if (d.severity == Severity::Error) out += std::string(d.code) + " " + d.message + "\n";
  return out;
}

// Values of the fields of a folder: as they are, each at the ends of what can be typed, and drawn ones.
std::vector<driver::NamedTexts> valuesOf(const InputFile& data) {
  static const std::regex field("(?:^|\n)\\s*(\\w+)\\s*=\\s*(-?[0-9.]+)");
  driver::NamedTexts given;
  for (std::sregex_iterator match(data.code.begin(), data.code.end(), field), none; match != none; ++match)
    given.emplace_back(match->str(1), match->str(2));
  std::vector<driver::NamedTexts> out(1);
  std::mt19937_64 random(7);
  for (std::size_t i = 0; i < given.size(); ++i) {
    for (const char* value : {"-1000", "1000", "0", "0.001", "5.5", "-5.5", "7", "53", "60"}) {
      out.push_back(given);
      out.back()[i].second = value;
    }
  }
  for (int draw = 0; draw < 8; ++draw) {
    out.push_back(given);
    for (auto& [name, text] : out.back()) {
      const double value = std::stod(text);
      const auto thousandths = static_cast<double>(static_cast<long>(random() % 8000) - 4000) / 1000;
      // Numbers of offsets stay whole.
      text = value >= 50 ? fmt::format("{}", 54 + random() % 6) : fmt::format("{:.3f}", value + thousandths);
    }
  }
  return out;
}

// What the user sees and types: labels wherever they are in the file, the rest in its order.
std::string dialogMeaning(const std::string& text) {
  std::set<std::string> labels;
  std::string out;
  std::istringstream in(withoutComments(text, 'l'));
  for (std::string line; std::getline(in, line);) {
    line = withoutBlanks(line);
    if (line.starts_with("label") || line.starts_with("LABEL"))
      labels.insert(line);
    else
      out += line + "\n";
  }
  for (const std::string& label : labels)
    out += label + "\n";
  return out;
}

// One after the other what a cycle means: the dialog, the posted text, the verdict of its checks and the path
// for the first values, and for the drawn ones; the routines of the post that print no cycle. nullopt after
// the last.
std::optional<std::string> meaningOfCycle(const Written& written, const std::string& folder,
                                          std::size_t part) {
  if (part == 0) return dialogMeaning(readAll(written.path(folder + "/CycleData.dlg")));
  const std::vector<driver::NamedTexts> values = valuesOf(*written.bundle().find(folder + "/DefineData.txt"));
  driver::CommonOptions common;
  common.host = {
      {"tool_radius", "3"}, {"clearance", "12.5"}, {"retract", "4.25"}, {"start_x", "1"}, {"start_y", "2"}};
  std::vector<const InputFile*> progs;
  for (const InputFile& file : written.bundle().files)
    if (file.kind == 'p') progs.push_back(&file);
  driver::PostOptions post;
  post.folders = {written.path(folder)};
  if (part <= values.size()) {
    common.set = values[part - 1];
    driver::DumpOptions path;
    path.inputs = {written.path(folder)};
    path.stage = driver::Stage::Path;
    path.common = common;
    std::string out = verdict(driver::dump(path));
    for (const InputFile* prog : progs) {
      post.common = common;
      post.source.prog = written.path(prog->name);
      out += verdict(driver::post(post));
    }
    return out;
  }
  if (part > values.size() + 1) return std::nullopt;
  std::string out;
  static const std::regex routine("(?:^|\n)(\\w+):");
  for (const InputFile* prog : progs) {
    for (std::sregex_iterator match(prog->code.begin(), prog->code.end(), routine), none; match != none;
         ++match) {
      post.common = common;
      post.source.prog = written.path(prog->name);
      post.source.routine = match->str(1);
      out += verdict(driver::post(post));
    }
  }
  return out;
}

// The IR without places, comments and names of blocks; nullopt: there is none.
std::optional<std::string> meaningOfProgram(const std::string& path) {
  driver::DumpOptions options;
  options.inputs = {path};
  options.stage = driver::Stage::Ir;
  const driver::Outcome outcome = driver::dump(options);
  if (outcome.status != 0) return std::nullopt;
  std::string out;
  std::istringstream in(outcome.output);
  for (std::string line; std::getline(in, line);) {
    line.erase(std::min(line.rfind(" ; "), line.size()));
    line.erase(line.find_last_not_of(' ') + 1);
    if (line.find("    comment ") == 0) continue;
    // 0 is 0 in every unit, and in a calculation a point adds nothing.
    static const std::regex zero("([A-Z])0\\.(?![0-9])"), whole("([0-9])\\.(?![0-9])");
    const bool computes = line.starts_with("    store ");
    out += std::regex_replace(line, computes ? whole : zero, computes ? "$1" : "$010") + "\n";
  }
  return out;
}

// One after the other what the bundle means where this file is changed; nullopt after the last.
std::optional<std::string> meaning(const Written& written, const InputFile& file, std::size_t part) {
  if (file.kind == 'n') {
    if (part > 0) return std::nullopt;
    return meaningOfProgram(written.path(file.name))
        .value_or("unreadable " + readAll(written.path(file.name)));
  }
  if (file.kind == 's') {
    if (part > 0) return std::nullopt;
    return withoutBlanks(withoutComments(readAll(written.path(file.name)), 's'));
  }
  if (file.kind != 'p') return meaningOfCycle(written, file.folder(), part);
  std::string out;
  bool any = false;
  for (const InputFile& data : written.bundle().files) {
    if (data.kind != 'd') continue;
    const auto one = meaningOfCycle(written, data.folder(), part);
    any = any || one;
    out += one.value_or("");
  }
  return any ? std::optional(out) : std::nullopt;
}

// Whether the changed file means the same as before.
bool meansTheSame(const Written& disk, std::size_t number, const Change& edit,
                  std::vector<std::string>& clean) {
  const InputFile& file = disk.bundle().files[number];
  for (std::size_t part = 0;; ++part) {
    disk.restore(number);
    if (part == clean.size()) {
      const auto before = meaning(disk, file, part);
      if (!before) return true;
      clean.push_back(*before);
    }
    disk.change(number, edit);
    if (meaning(disk, file, part) != clean[part]) return false;
  }
}

// ---- the run
// -----------------------------------------------------------------------------------------------

struct Tally {
  std::size_t drawn = 0, found = 0, byDefault = 0, excused = 0;
  std::map<std::string, std::pair<std::size_t, std::size_t>> operators; // drawn, survivors
  std::vector<std::string> survivors;                                   // rows of a table
  std::vector<std::string> all;
  double rate() const {
    return drawn == excused ? 1 : static_cast<double>(found) / static_cast<double>(drawn - excused);
  }
};

std::string escaped(std::string text) {
  std::string out;
  for (const char c : text) {
    if (c == '\n')
      out += " ⏎ ";
    else if (c == '|')
      out += "\\|";
    else
      out += c;
  }
  return out;
}

// The changed line or lines, before and after.
std::string shown(const InputFile& file, const Change& edit) {
  const std::size_t before = edit.offset == 0 ? 0 : file.text.rfind('\n', edit.offset - 1) + 1;
  const auto rest = [&](const std::string& text, std::size_t end) {
    return text.substr(before, std::min(text.find('\n', end), text.size()) - before);
  };
  const bool whole = edit.text.empty() && edit.length > 0 && file.text[edit.offset + edit.length - 1] == '\n';
  const std::string was =
      whole ? file.text.substr(edit.offset, edit.length - 1) : rest(file.text, edit.offset + edit.length);
  if (whole) return "`" + escaped(was) + "` | nothing";
  return "`" + escaped(was) + "` | `" + escaped(rest(mutated(file, edit), edit.offset + edit.text.size())) +
         "`";
}

Tally run(const std::vector<Bundle>& bundles, std::uint64_t seed) {
  static const std::vector<Operator> operators = allOperators();
  Tally tally;
  std::vector<std::string> unfit;
  const std::vector<Mutant> mutants = drawMutants(operators, bundles, seed, tests::draws(kMutants), unfit);
  for (const std::string& id : unfit)
    std::cout << "lint mutation: " << id << " fits nowhere\n";
  std::vector<std::unique_ptr<Written>> written;
  for (const Bundle& bundle : bundles)
    written.push_back(std::make_unique<Written>(bundle));
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::string>> meanings; // of the clean files
  for (const Mutant& mutant : mutants) {
    const InputFile& file = bundles[mutant.bundle].files[mutant.file];
    const Written& disk = *written[mutant.bundle];
    ++tally.drawn;
    auto& ofOperator = tally.operators[std::string(mutant.by->id)];
    ++ofOperator.first;
    disk.change(mutant.file, mutant.edit);
    const std::set<std::string> codes = findings(disk);
    const auto line = std::count(file.text.begin(),
                                 file.text.begin() + static_cast<std::ptrdiff_t>(mutant.edit.offset), '\n') +
                      1;
    const std::string row = "| " + std::string(mutant.by->id) + " | " + bundles[mutant.bundle].name +
                            (file.name == bundles[mutant.bundle].name ? "" : "/" + file.name) + ":" +
                            std::to_string(line) + " | " + shown(file, mutant.edit) + " |";
    std::string how;
    if (!codes.empty()) {
      ++tally.found;
      if (std::any_of(codes.begin(), codes.end(), isDefault)) ++tally.byDefault;
      for (const std::string& code : codes)
        how += code + " ";
    } else {
      const bool same = meansTheSame(disk, mutant.file, mutant.edit, meanings[{mutant.bundle, mutant.file}]);
      how = same ? "EXCUSED" : "SURVIVES";
      if (same) {
        ++tally.excused;
      } else {
        ++ofOperator.second;
        tally.survivors.push_back(row);
      }
    }
    tally.all.push_back(row + " " + how);
    disk.restore(mutant.file);
  }
  return tally;
}

int environmentNumber(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atoi(text);
}

void write(const char* variable, const std::vector<std::string>& lines) {
  const char* path = std::getenv(variable);
  if (path == nullptr) return;
  std::ofstream out(path, std::ios::binary | std::ios::app);
  for (const std::string& line : lines)
    out << line << "\n";
}

void check(const std::string& set, std::uint64_t firstSeed) {
  const std::vector<Bundle> bundles = bundlesOf(set);
  for (const Bundle& bundle : bundles) {
    const auto told = findings(Written(bundle));
    CHECK_MESSAGE(told.empty(), bundle.name << " is not clean: " << (told.empty() ? "" : *told.begin()));
  }
  const int seeds = environmentNumber("DOTEK_MUTANTS_SEEDS", 1);
  for (int turn = 0; turn < seeds; ++turn) {
    const Tally tally = run(bundles, firstSeed + static_cast<std::uint64_t>(turn));
    const std::string summary =
        fmt::format("{} inputs, seed {}: {} mutants, {} excused, {} found ({:.1f} %), {} of them by default",
                    set, firstSeed + static_cast<std::uint64_t>(turn), tally.drawn, tally.excused,
                    tally.found, 100 * tally.rate(), tally.byDefault);
    std::cout << "lint mutation: " << summary << "\n";
    write("DOTEK_MUTANTS_OUT", {summary});
    write("DOTEK_MUTANTS_OUT", tally.survivors);
    write("DOTEK_MUTANTS_ALL", tally.all);
    CHECK(tally.drawn == tests::draws(kMutants));
    std::string survivors;
    for (const std::string& row : tally.survivors)
      survivors += "\n" + row;
    // A few scatter.
    CHECK_MESSAGE(tally.rate() >= (fewDraws() ? kLeast - 0.25 : kLeast), survivors);
  }
}

} // namespace

TEST_CASE("lint mutation: of 400 mutants of clean inputs at least 85 % are found") {
  check("first", 1);
}

TEST_CASE("lint mutation: other inputs and another seed") {
  check("second", 1001);
}

TEST_CASE("lint mutation: inputs that were written after the rules") {
  check("third", 2001);
}

TEST_CASE("lint mutation: inputs whose survivors no rule was written for") {
  check("fourth", 3001);
}
