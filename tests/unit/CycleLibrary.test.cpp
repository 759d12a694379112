// The library of cycles: each file is sound, laid out, and says what it is.
#include "driver/Driver.h"
#include "frontend/cycle/Check.h"
#include "frontend/cycle/Link.h"
#include "frontend/cycle/Parse.h"
#include "project/CycleFiles.h"
#include "project/CycleLowering.h"
#include "project/Session.h"
#include "support/messages/Cycle.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <algorithm>
#include <cctype>
#include <doctest/doctest.h>
#include <filesystem>
#include <set>
#include <string>

namespace dotek::tests {
namespace {

namespace cycle = frontend::cycle;

bool startsLarge(const std::string& title) {
  return !title.empty() && (std::isupper(static_cast<unsigned char>(title[0])) != 0 || title.find(':') < 5);
}

struct Library {
  project::CommonOptions options;
  project::Session session{options};
  project::CycleFiles files{session};

  template <class Visit> void each(const Visit& visit) {
    for (const stdlib::DataFile* data : session.data().list("cycles")) {
      INFO(data->name);
      std::string name = data->name;
      std::replace(name.begin(), name.end(), '-', '_');
      const cycle::File* file = files.library(name);
      REQUIRE(file != nullptr);
      visit(*data, *file);
    }
  }
};

TEST_CASE("library of cycles: no finding, and every file is laid out") {
  Library library;
  std::size_t cycles = 0;
  library.each([&](const stdlib::DataFile& data, const cycle::File& file) {
    cycle::check(file, library.session.sources(), library.session.diagnostics());
    CHECK_MESSAGE(library.session.diagnostics().all().empty(),
                  renderText(library.session.diagnostics(), library.session.sources(), 0));
    CHECK(cycle::layOut(file) == data.text);
    cycles += file.header() != nullptr && !file.header()->options ? 1U : 0U;
  });
  CHECK(cycles >= 50);
}

// Those of rotary axes are part of the language, and nothing runs them yet.
TEST_CASE("library of cycles: what nothing can run is said by the check") {
  for (const auto& entry : std::filesystem::directory_iterator(root() / "stdlib/cycles")) {
    if (entry.path().extension() != ".cycle") continue;
    const project::CommonOptions options;
    project::Session session(options);
    project::CycleFiles files(session);
    project::checkCycleFile(entry.path().string(), files, session);
    for (const Diagnostic& one : session.diagnostics().all())
      CHECK_MESSAGE(one.code == diag::RotaryAxis::code,
                    renderText(session.diagnostics(), session.sources(), 0));
  }
}

TEST_CASE("library of cycles: the check says what lowering refuses, and what is wrong with a called cycle") {
  const TestFolder folder("dotek-cycle-check");
  const std::string head = "// A lid.\ncycle lid \"Lid\"\n", on = "spindle off\nprobe on\n";
  const auto codes = [&](const std::string& name, const std::string& text) {
    const project::CommonOptions options;
    project::Session session(options);
    project::CycleFiles files(session);
    project::checkCycleFile(folder.write(name, text), files, session);
    std::set<std::string> out;
    for (const Diagnostic& one : session.diagnostics().all())
      out.insert(std::string(one.code));
    return out;
  };
  CHECK(codes("lid.cycle", head + on + "touch z by 5 mm -> top\nprobe off\n").contains("touch-upward"));
  CHECK(codes("lid.cycle", head + on + "touch z by -5 mm -> top\nprobe off\n").empty());
  CHECK(codes("lid.cycle", "options lid \"Lid\"\n\nparameter wide : length \"Wide\"\n").empty());
  folder.write("low.cycle", "// Low.\ncycle low \"Low\"\n" + on + "touch z by 5 mm -> top\nprobe off\n");
  CHECK(codes("lid.cycle", head + "call low\n").contains("touch-upward"));
}

TEST_CASE("check: a word of the language that is declared as a name is one finding, wherever it is used") {
  const TestFolder folder("dotek-cycle-word");
  const auto found = [&](const std::string& use) {
    const project::CommonOptions options;
    project::Session session(options);
    project::CycleFiles files(session);
    project::checkCycleFile(
        folder.write("lid.cycle", "// A lid.\ncycle lid \"Lid\"\n\nparameter a : length = 5 "
                                  "mm \"Way\"\n\nspindle off\nprobe on\n" +
                                      use + "probe off\n"),
        files, session);
    return session.diagnostics().all().size();
  };
  CHECK(found("touch x by a -> right\n") == 1);
  CHECK(found("touch x by a + 2 mm -> right\nmove by y a\n") == 1);
  CHECK(found("touch x by a -> right\ntouch y by b -> back\n") == 2);
}

TEST_CASE("library of cycles: what a dialog and a catalogue print is there") {
  Library library;
  library.each([&](const stdlib::DataFile&, const cycle::File& file) {
    const cycle::Header* header = file.header();
    REQUIRE(header != nullptr);
    CHECK((header->title && startsLarge(header->title->text)));
    CHECK(!file.body.statements.front().before.empty());
    std::string letters;
    for (const cycle::Statement* one : cycle::declarations(file)) {
      if (const auto* result = std::get_if<cycle::Result>(&one->node)) CHECK(result->title);
      if (const auto* require = std::get_if<cycle::Require>(&one->node)) CHECK(require->message);
      const auto* parameter = std::get_if<cycle::Parameter>(&one->node);
      if (parameter == nullptr) continue;
      CHECK(parameter->title);
      for (const cycle::Clause& clause : parameter->clauses) {
        if (clause.kind == cycle::Clause::Kind::Require) CHECK(clause.text);
        if (clause.letter) letters += clause.letter->text;
      }
    }
    std::sort(letters.begin(), letters.end());
    CHECK_MESSAGE(std::adjacent_find(letters.begin(), letters.end()) == letters.end(), letters);
    // Words of a block, and those that call a macro.
    CHECK_MESSAGE(letters.find_first_of("GLNOP") == std::string::npos, letters);
  });
}

TEST_CASE("library of cycles: each has a page, and links of pages lead somewhere") {
  const driver::Outcome site = driver::catalogue({});
  REQUIRE(site.status == 0);
  std::set<std::string> names;
  for (const OutputFile& file : site.files)
    CHECK(names.insert(file.name).second);
  std::size_t links = 0;
  for (const OutputFile& file : site.files) {
    INFO(file.name);
    const bool page = file.name.ends_with(".html");
    const std::string before = page ? "href=\"" : "](";
    for (std::size_t at = 0; (at = file.text.find(before, at)) != std::string::npos; ++links) {
      at += before.size();
      const std::string target = file.text.substr(at, file.text.find(page ? '"' : ')', at) - at);
      CHECK_MESSAGE(names.contains(target), target);
    }
  }
  Library library;
  for (const stdlib::DataFile* data : library.session.data().list("cycles")) {
    CHECK(names.contains(data->name + ".html"));
    CHECK(names.contains(data->name + ".md"));
  }
  CHECK(links > 300);
}

} // namespace
} // namespace dotek::tests
