// Build tool: reads stdlib/keywords/, stdlib/macros/ and stdlib/controls/ and writes them as a C++ source
// (argument 1) that the program reads without a TOML parser. A defect in a table fails the build with its
// place.
#include "stdlib/DataFiles.h"
#include "stdlib/StoredTables.h"

#include <cstdio>
#include <fstream>
#include <string_view>

namespace dotek::stdlib {
StoredTables embeddedTables() {
  return {};
}
} // namespace dotek::stdlib

namespace {

// Pieces: some compilers bound the length of each.
void writeLiteral(std::ostream& out, const std::string& text) {
  constexpr std::size_t kChunk = 8000;
  for (std::size_t at = 0; at < text.size(); at += kChunk)
    out << "R\"DOTEK(" << text.substr(at, kChunk) << ")DOTEK\"\n";
}

// An array of StoredTable of all that the folder holds.
template <class Table>
void writeTables(std::ostream& out, const dotek::stdlib::DataFiles& files, std::string_view folder) {
  using namespace dotek::stdlib;
  out << "constexpr StoredTable k_" << folder << "[] = {\n";
  for (const DataFile* file : files.list(folder)) {
    Table table = *Table::load(files, file->name);
    out << "{\"" << file->name << "\",\n";
    writeLiteral(out, TableStore::store(table));
    out << "},\n";
  }
  out << "};\n";
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("dotek_store OUTPUT.cpp\n", stderr);
    return 2;
  }
  using namespace dotek::stdlib;
  try {
    const DataFiles files;
    GibbsKeywords gibbs = GibbsKeywords::load(files);
    ComPostKeywords compost = ComPostKeywords::load(files);
    std::ofstream out(argv[1], std::ios::binary);
    out << "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n"
           "#include \"stdlib/StoredTables.h\"\n\nnamespace dotek::stdlib {\nnamespace {\n";
    writeTables<MacroSet>(out, files, "macros");
    writeTables<Control>(out, files, "controls");
    out << "} // namespace\nStoredTables embeddedTables() {\nreturn {\n";
    writeLiteral(out, TableStore::store(gibbs));
    out << ",\n";
    writeLiteral(out, TableStore::store(compost));
    out << ", k_macros, k_controls};\n}\n} // namespace dotek::stdlib\n";
    out.flush();
    return out.good() ? 0 : 1;
  } catch (const DataError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
