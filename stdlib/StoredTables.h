// Keyword tables, macro sets and controls in a form that is read without a parser: written at build time from
// the TOML files, which stay the only source. Private to stdlib and its build tool.
#pragma once

#include "stdlib/ComPostKeywords.h"
#include "stdlib/Control.h"
#include "stdlib/GibbsKeywords.h"
#include "stdlib/MacroSet.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

class DataFiles;
struct DataFile;
struct ListedWord;

struct StoredTable {
  std::string_view name; // of the TOML file
  std::string_view text;
};

// What the program was built with; nothing in the build tool itself.
struct StoredTables {
  std::string_view gibbs;
  std::string_view compost;
  std::span<const StoredTable> macros;
  std::span<const StoredTable> controls;
};
StoredTables embeddedTables();

// Tables to text and back. Storing gives the same text for the same tables; restoring text that store() did
// not write throws DataError (stdlib/DataFiles.h).
struct TableStore {
  static std::string store(GibbsKeywords& keywords);
  static std::string store(ComPostKeywords& keywords);
  static GibbsKeywords restoreGibbs(std::string_view text);
  static ComPostKeywords restoreComPost(std::string_view text);
  static std::string store(MacroSet& set);
  static std::string store(Control& control);
  static MacroSet restoreMacroSet(std::string_view text);
  static Control restoreControl(std::string_view text);
  // From the TOML files, whether or not stored tables of them exist.
  static GibbsKeywords readGibbs(const DataFiles& files);
  static ComPostKeywords readComPost(const DataFiles& files);
  static MacroSet readMacroSet(const DataFile& file);
  static std::vector<ListedWord> listOf(const ComPostKeywords& keywords);
  static std::vector<ListedWord> listOf(const GibbsKeywords& keywords);
  static std::vector<ListedWord> parametersOf(const GibbsKeywords& keywords, std::string_view family);
  static Control readControl(const DataFiles& files, const DataFile& file);
};

} // namespace dotek::stdlib
