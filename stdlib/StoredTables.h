// Keyword tables in a form that is read without a parser: written at build time from the TOML files, which
// stay the only source. Private to stdlib and its build tool.
#pragma once

#include "stdlib/ComPostKeywords.h"
#include "stdlib/GibbsKeywords.h"

#include <string>
#include <string_view>

namespace dotek::stdlib {

// What the program was built with; empty texts in the build tool itself.
struct StoredTables {
  std::string_view gibbs;
  std::string_view compost;
};
StoredTables embeddedTables();

// Tables to text and back. Storing gives the same text for the same tables; restoring text that store() did
// not write throws DataError (stdlib/DataFiles.h).
struct TableStore {
  static std::string store(GibbsKeywords& keywords);
  static std::string store(ComPostKeywords& keywords);
  static GibbsKeywords restoreGibbs(std::string_view text);
  static ComPostKeywords restoreComPost(std::string_view text);
  // From the TOML files, whether or not stored tables of them exist.
  static GibbsKeywords readGibbs(const DataFiles& files);
  static ComPostKeywords readComPost(const DataFiles& files);
};

} // namespace dotek::stdlib
