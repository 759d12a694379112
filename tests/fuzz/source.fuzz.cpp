// Any bytes as a source text: decoding, places, excerpts of messages, JSON.
#include "support/Diagnostics.h"
#include "support/Files.h"
#include "support/messages/Common.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

using namespace dotek;

// The first byte chooses the encoding, the next two where the finding is.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 3) return 0;
  constexpr Encoding kFallbacks[] = {Encoding::Utf8, Encoding::Cp1250, Encoding::Cp852};
  const Encoding fallback = kFallbacks[data[0] % 3];
  std::optional<Encoding> forced;
  if ((data[0] & 0x80) != 0) forced = fallback;

  SourceMap sources;
  Diagnostics diagnostics;
  const std::string text(reinterpret_cast<const char*>(data + 3), size - 3);
  if (const auto file = addText("input", text, fallback, forced, sources, diagnostics)) {
    const auto length = static_cast<std::uint32_t>(sources.file(*file).bytes().size());
    const std::uint32_t a = length == 0 ? 0 : data[1] * length / 255;
    const std::uint32_t b = length == 0 ? 0 : data[2] * length / 255;
    const SourceRange range{*file, std::min(a, b), std::max(a, b)};
    diagnostics.report<diag::SyntaxError>(range, sources.textUtf8(range)).note(range, "here");
    const SourceFile& source = sources.file(*file);
    for (std::uint32_t line = 1; line <= source.lineCount(); ++line) {
      const LineColumn start = source.place(source.lineStart(line));
      if (start.line != line || start.column != 1) std::abort();
    }
  }
  diagnostics.sort();
  (void)renderText(diagnostics, sources, 50);
  const std::string json = renderJson(diagnostics, sources);
  if (!isUtf8(json)) std::abort();
  return 0;
}
