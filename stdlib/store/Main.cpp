// Build tool: reads the keyword tables of stdlib/keywords/ and writes them as a C++ source (argument 1) that
// the program reads without a TOML parser. A defect in a table fails the build with its place.
#include "stdlib/DataFiles.h"
#include "stdlib/StoredTables.h"

#include <cstdio>
#include <fstream>

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
           "#include \"stdlib/StoredTables.h\"\n\nnamespace dotek::stdlib {\nStoredTables embeddedTables() "
           "{\n"
           "return {\n";
    writeLiteral(out, TableStore::store(gibbs));
    out << ",\n";
    writeLiteral(out, TableStore::store(compost));
    out << "};\n}\n} // namespace dotek::stdlib\n";
    out.flush();
    return out.good() ? 0 : 1;
  } catch (const DataError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
