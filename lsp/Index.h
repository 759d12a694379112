// What a text names: where each name is declared, written and read; its symbols; what hovering shows; hints.
#pragma once

#include "project/InputKind.h"
#include "project/Options.h"
#include "support/Source.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::project {
class Session;
}

namespace dotek::lsp {

struct Occurrence {
  enum class Role : std::uint8_t { Definition, Write, Read };
  // What is named, unique in its scope: "N 0 100" for block 100 of the first program, "O 9810", "# 500",
  // "field DIAMETER".
  std::string key;
  Role role = Role::Read;
  SourceRange range;
  std::string scope = {}; // of a field in a Prog: the cycle that is posted there; "": any
};

// Kinds of symbols by the numbers of the protocol.
enum class SymbolKind : std::uint8_t {
  Module = 2,
  Method = 6,
  Field = 8,
  Function = 12,
  Variable = 13,
  Key = 20
};

struct Symbol {
  std::string name, detail;
  SymbolKind kind = SymbolKind::Variable;
  SourceRange range, nameRange;
  std::vector<Symbol> children;
};

// Markdown that hovering over a place shows.
struct Fact {
  SourceRange range;
  std::string text;
};

// Text that an editor shows before a place: the name of an argument.
struct Hint {
  std::uint32_t offset = 0;
  std::string label;
};

// An argument of a call whose program is in no set of macros.
struct OwnArgument {
  SourceRange range;
  std::uint32_t program = 0;
  char letter = 0;
  std::uint32_t local = 0; // #n that it sets
};

struct Index {
  std::optional<project::InputKind> kind;
  bool post = false; // of Fusion, which is of no kind
  SourceMap sources;
  FileId file = kNoFile; // kNoFile: it cannot be read
  Encoding encoding = Encoding::Utf8;
  std::vector<Occurrence> occurrences;
  std::vector<Symbol> symbols;
  std::vector<Fact> facts;
  std::vector<Hint> hints;
  std::vector<OwnArgument> ownArguments;
  // Files that a name stands for: of a cycle or a macro that is called, by the key of the name.
  std::map<std::string, std::string> files;
  std::vector<std::string> needed; // parameters that a run gets no value for
  // Names with this beginning keep their meaning where all occurrences of this index are renamed; what is not
  // listed is known elsewhere, too.
  std::vector<std::string> renamable;
  std::set<std::string> taken;        // names that no other one gets, beside those of occurrences of its kind
  std::uint32_t lastBlock = 99999999; // the greatest number that a block may have
  std::vector<std::uint32_t> programs; // of Macro B: where each begins
  bool computedJumps = false;          // a GOTO whose number is computed

  const SourceFile& text() const { return sources.file(file); }
  const Occurrence* at(std::uint32_t offset) const; // nullptr: no name is there
  // Dotek reads the text.
  bool isRead() const { return file != kNoFile && (kind || post); }
  std::size_t programAt(std::uint32_t offset) const;
  std::string utf8(std::string_view bytes) const { return toUtf8(bytes, encoding); } // of this text
};

// Reads the file, or what the editor holds of it. Never fails: of what cannot be read nothing is listed.
Index makeIndex(const std::string& path, const project::CommonOptions& options);

// Private to the index: one language each.
void indexMacroB(Index& index, project::Session& session, const std::string& path);
void indexGibbs(Index& index, project::Session& session, const std::string& path);
void indexComPost(Index& index, project::Session& session);
void indexPost(Index& index, project::Session& session);
void indexCycle(Index& index, project::Session& session, const std::string& path);
void indexMikroprog(Index& index, project::Session& session, const std::string& path);

} // namespace dotek::lsp
