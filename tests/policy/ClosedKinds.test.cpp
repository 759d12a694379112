// What ir/Match.h promises: a kind of statement, expression or condition, or an operator, that is added stops
// the build of every consumer. The test plants some into copies of the headers and has the compiler look at
// each file that chooses by kind: an error is wanted at each such place.
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/Skips.h"
#include "tests/policy/Tree.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <thread>
#include <unistd.h>

using namespace dotek::tests;
namespace fs = std::filesystem;

namespace {

// One compilation finds what one header set holds: the kinds that one place may choose among are planted into
// different ones.
enum class Plant { First, Second };

struct Place {
  std::string file;
  std::size_t first = 0, last = 0; // lines
  std::set<Plant> plants;          // at which an error is wanted; empty: at any of them
  std::string what;
};

std::vector<const TreeFile*> consumers() {
  static constexpr const char* kFolders[] = {"ir",      "frontend", "backends", "targets", "sim",
                                             "project", "lint",     "verify",   "driver"};
  std::vector<const TreeFile*> out;
  for (const TreeFile& file : tree()) {
    const bool ours = std::any_of(std::begin(kFolders), std::end(kFolders),
                                  [&](const char* folder) { return file.below(folder); });
    if (ours && file.isSource() && file.path != "ir/Match.h") out.push_back(&file);
  }
  return out;
}

const std::string& textOf(const std::string& path) {
  const auto& files = tree();
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const TreeFile& f) { return f.path == path; });
  REQUIRE_MESSAGE(found != files.end(), path);
  return found->text;
}

// Kinds of Nodes.def of one list.
std::set<std::string> kindsOf(const std::string& list) {
  std::set<std::string> out;
  const std::regex line("\n" + list + R"(\((\w+),)");
  const std::string& text = textOf("ir/Nodes.def");
  for (std::sregex_iterator at(text.begin(), text.end(), line), end; at != end; ++at)
    out.insert((*at)[1]);
  REQUIRE(out.size() > 3);
  return out;
}

// The index after the bracket that closes the one at `open`; texts of the file hold no lone bracket of that
// kind that would matter here.
std::size_t closing(const std::string& text, std::size_t open, char opens, char closes) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (text[i] == opens) ++depth;
    if (text[i] == closes && --depth == 0) return i + 1;
  }
  return text.size();
}

std::size_t lineAt(const std::string& text, std::size_t at) {
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

// Kinds that cases of `part` name: `const ir::Label&`, `OneOf<ir::Label, ir::Comment>`.
std::set<std::string> casesIn(const std::string& part) {
  static const std::regex parameter(R"(\(const (?:ir::)?(\w+)&)"), list(R"(OneOf<([^>]*)>)"), word(R"(\w+)");
  std::set<std::string> out;
  for (std::sregex_iterator at(part.begin(), part.end(), parameter), end; at != end; ++at)
    out.insert((*at)[1]);
  for (std::sregex_iterator at(part.begin(), part.end(), list), end; at != end; ++at) {
    const std::string names = (*at)[1];
    for (std::sregex_iterator name(names.begin(), names.end(), word); name != end; ++name)
      out.insert(name->str());
  }
  return out;
}

bool meet(const std::set<std::string>& a, const std::set<std::string>& b) {
  return std::any_of(a.begin(), a.end(), [&](const std::string& one) { return b.contains(one); });
}

const std::set<std::string>& expressionKinds() {
  static const std::set<std::string> kinds = {"Constant",       "NullValue", "VariableUse", "MachineVariable",
                                              "MeasuredResult", "Unary",     "Binary"};
  return kinds;
}
const std::set<std::string>& conditionKinds() {
  static const std::set<std::string> kinds = {"Comparison", "IsNull", "Not", "Junction", "Truth"};
  return kinds;
}

// Calls of match(): over statements, expressions, conditions.
void findMatches(const TreeFile& file, std::vector<Place>& out) {
  static const std::set<std::string> ofCycles = kindsOf("DOTEK_CYCLE_STATEMENT");
  static const std::set<std::string> ofPrograms = kindsOf("DOTEK_PROGRAM_STATEMENT");
  static const std::set<std::string> ofBoth = kindsOf("DOTEK_COMMON_STATEMENT");
  static const std::regex call(R"((^|[^\w.>])(?:ir::)?match\()"), visitor(R"(, (\*this|\w+\{\})\)$)");
  for (std::sregex_iterator at(file.text.begin(), file.text.end(), call), end; at != end; ++at) {
    const std::size_t open = static_cast<std::size_t>(at->position() + at->length()) - 1;
    const std::size_t close = closing(file.text, open, '(', ')');
    const std::string part = file.text.substr(open, close - open);
    const std::set<std::string> kinds = casesIn(part);
    Place place{file.path, lineAt(file.text, open), lineAt(file.text, close), {}, "match()"};
    if (meet(kinds, ofCycles) || meet(kinds, expressionKinds())) place.plants.insert(Plant::First);
    if (meet(kinds, ofPrograms) || meet(kinds, conditionKinds())) place.plants.insert(Plant::Second);
    // An object with an operator() for each kind.
    const bool object = std::regex_search(part, visitor);
    if (!place.plants.empty() || meet(kinds, ofBoth) || object) out.push_back(std::move(place));
  }
}

// Switches over operators and relations of the IR.
void findSwitches(const TreeFile& file, std::vector<Place>& out) {
  static const std::regex start(R"(\bswitch \()");
  const bool own = file.below("ir");
  const auto names = [&](const std::string& part, const char* type) {
    const std::regex alias(fmt::format(R"(using Op = (?:ir::)?{};)", type));
    const std::regex label(fmt::format(R"(case (?:{}){}::)", own ? "ir::)?(?:" : "ir::", type));
    const std::regex bare(fmt::format(R"(case {}::)", type));
    const bool used = file.text.find(fmt::format("using ir::{};", type)) != std::string::npos;
    return std::regex_search(part, label) || (used && std::regex_search(part, bare)) ||
           (std::regex_search(part, alias) && part.find("case Op::") != std::string::npos);
  };
  for (std::sregex_iterator at(file.text.begin(), file.text.end(), start), end; at != end; ++at) {
    const auto begin = static_cast<std::size_t>(at->position());
    const std::size_t open = file.text.find('{', begin);
    if (open == std::string::npos) continue;
    const std::size_t close = closing(file.text, open, '{', '}');
    // With the line before, where an alias may be.
    const std::size_t from =
        file.text.rfind("\n}", begin) == std::string::npos ? 0 : file.text.rfind("\n}", begin);
    const std::string part = file.text.substr(begin, close - begin);
    const std::string around = file.text.substr(from, close - from);
    const bool ours = part.find("case Op::") != std::string::npos;
    Place place{file.path, lineAt(file.text, begin), lineAt(file.text, close), {}, "switch"};
    const std::string& look = ours ? around : part;
    if (names(look, "UnaryOp") || names(look, "Relation")) place.plants.insert(Plant::First);
    if (names(look, "BinaryOp")) place.plants.insert(Plant::Second);
    if (!place.plants.empty()) out.push_back(std::move(place));
  }
}

// ---- planting

std::string inserted(std::string text, const std::string& before, const std::string& what) {
  const std::size_t at = text.find(before);
  REQUIRE_MESSAGE(at != std::string::npos, before);
  return text.insert(at + before.size(), what);
}

void plant(const fs::path& folder, Plant which) {
  const bool first = which == Plant::First;
  std::string nodes = textOf("ir/Nodes.def"), statement = textOf("ir/Statement.h"),
              expression = textOf("ir/Expression.h");
  const std::string list = first ? "DOTEK_CYCLE_STATEMENT" : "DOTEK_PROGRAM_STATEMENT";
  nodes = inserted(nodes, "#ifdef " + list + "\n", list + "(PlantedKind, \"planted\")\n");
  statement = inserted(statement, "\nnamespace dotek::ir {\n", "struct PlantedKind {};\n");
  expression = inserted(expression, "\nnamespace dotek::ir {\n", "struct PlantedNode {};\n");
  if (first) {
    expression = inserted(expression, "Unary, Binary", ", PlantedNode");
    expression = inserted(expression, "enum class UnaryOp : std::uint8_t {\n", "  PlantedOperator,\n");
    expression = inserted(expression, "enum class Relation : std::uint8_t {\n", "  PlantedRelation,\n");
  } else {
    expression = inserted(expression, "Junction, Truth", ", PlantedNode");
    expression = inserted(expression, "enum class BinaryOp : std::uint8_t {\n", "  PlantedOperator,\n");
  }
  fs::create_directories(folder / "ir");
  std::ofstream(folder / "ir/Nodes.def") << nodes;
  std::ofstream(folder / "ir/Statement.h") << statement;
  std::ofstream(folder / "ir/Expression.h") << expression;
}

struct Look {
  std::string file;
  Plant plant = Plant::First;
  bool failed = false;
  std::set<std::size_t> lines; // of the file, in what the compiler says
};

std::string includes(const fs::path& planted) {
  std::string out = fmt::format(" -I'{}'", planted.string());
  std::istringstream list(DOTEK_INCLUDES);
  for (std::string folder; std::getline(list, folder, '|');)
    if (!folder.empty() && folder != "/usr/include") out += fmt::format(" -I'{}'", folder);
  return out;
}

void compile(Look& look, const fs::path& folder, std::size_t number) {
  const fs::path planted = folder / (look.plant == Plant::First ? "first" : "second");
  const fs::path log = folder / fmt::format("log{}", number);
  const fs::path source = root() / look.file;
  const std::string command = fmt::format(
      "'{}' -std=c++20 -fsyntax-only -Wswitch -Werror=switch -ftemplate-backtrace-limit=0{} '{}' > '{}' 2>&1",
      DOTEK_COMPILER, includes(planted), source.string(), log.string());
  look.failed = std::system(command.c_str()) != 0;
  std::ifstream in(log);
  const std::string name = source.string() + ":";
  for (std::string line; std::getline(in, line);) {
    for (std::size_t at = line.find(name); at != std::string::npos; at = line.find(name, at + 1)) {
      const std::size_t found = std::strtoul(line.c_str() + at + name.size(), nullptr, 10);
      if (found != 0) look.lines.insert(found);
    }
  }
}

} // namespace

TEST_CASE("policy: a kind or an operator that is added stops the build of each consumer") {
  if (fewDraws()) return skip("the compiler is asked without the sanitizers, which double its time");
  if (std::system(fmt::format("'{}' --version > /dev/null 2>&1", DOTEK_COMPILER).c_str()) != 0) {
    ++settings().toolSkipped;
    MESSAGE("no compiler to ask: " DOTEK_COMPILER);
    return;
  }
  std::vector<Place> places;
  for (const TreeFile* file : consumers()) {
    const std::size_t before = places.size();
    findMatches(*file, places);
    findSwitches(*file, places);
    CHECK_MESSAGE((!file->isHeader() || places.size() == before), file->path,
                  ": choose by kind in a .cpp, which the compiler can be asked about");
  }
  CHECK(places.size() > 100);

  std::vector<Look> looks;
  for (const Place& place : places)
    for (const Plant which : {Plant::First, Plant::Second}) {
      if (!place.plants.empty() && !place.plants.contains(which)) continue;
      const bool known = std::any_of(looks.begin(), looks.end(), [&](const Look& look) {
        return look.file == place.file && look.plant == which;
      });
      if (!known) looks.push_back({place.file, which, false, {}});
    }

  const fs::path folder = fs::temp_directory_path() / fmt::format("dotek-kinds-{}", ::getpid());
  plant(folder / "first", Plant::First);
  plant(folder / "second", Plant::Second);
  std::atomic<std::size_t> next = 0;
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i)
    threads.emplace_back([&] {
      for (std::size_t at = next++; at < looks.size(); at = next++)
        compile(looks[at], folder, at);
    });
  for (std::thread& thread : threads)
    thread.join();
  fs::remove_all(folder);

  for (const Place& place : places) {
    std::size_t wanted = 0;
    std::size_t seen = 0;
    for (const Look& look : looks) {
      if (look.file != place.file || (!place.plants.empty() && !place.plants.contains(look.plant))) continue;
      ++wanted;
      const auto line = look.lines.lower_bound(place.first);
      if (look.failed && line != look.lines.end() && *line <= place.last) ++seen;
    }
    CHECK_MESSAGE((place.plants.empty() ? seen > 0 : seen == wanted),
                  fmt::format("{}:{}: this {} takes a kind or an operator that it does not know", place.file,
                              place.first, place.what));
  }
}

TEST_CASE("policy: a choice among kinds of statements is a match()") {
  std::string kinds;
  for (const char* list : {"DOTEK_COMMON_STATEMENT", "DOTEK_CYCLE_STATEMENT", "DOTEK_PROGRAM_STATEMENT"})
    for (const std::string& kind : kindsOf(list))
      kinds += (kinds.empty() ? "" : "|") + kind;
  const std::string question =
      fmt::format(R"((?:std::)?(?:get_if|holds_alternative)<(?:ir::)?(?:{})>\()", kinds);
  const std::regex chain(R"(else if \([^\n]*)" + question);
  const std::regex several(R"(holds_alternative<(?:ir::)?(?:)" + kinds +
                           R"()>\([^()]*\)\s*(?:\|\||&&)\s*!?)" + question);
  for (const TreeFile* file : consumers()) {
    // Trees of front ends have kinds of the same names.
    const bool tree = file->below("frontend") && file->text.find("ir::") == std::string::npos;
    if (tree) continue;
    std::smatch found;
    for (const std::regex* wrong : {&chain, &several})
      if (std::regex_search(file->text, found, *wrong))
        FAIL_CHECK(
            fmt::format("{}:{}: a choice among kinds that one more would slip through: use ir::match()",
                        file->path, lineAt(file->text, static_cast<std::size_t>(found.position()))));
    if (file->below("ir") || file->below("backends") || file->below("sim") || file->below("verify"))
      CHECK_MESSAGE(file->text.find("std::visit(") == std::string::npos, file->path,
                    ": std::visit takes a case for all kinds; use ir::match()");
  }
}
