# Run by EmbedData.cmake: writes OUTPUT, a sorted table of every .toml and .nc below ROOT.
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/*.toml ${ROOT}/*.nc)
list(SORT files)
set(rows "")
foreach(file IN LISTS files)
  file(READ ${ROOT}/${file} text)
  string(LENGTH "${text}" length)
  set(literal "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 8000 chunk)
    string(APPEND literal "R\"DOTEK(${chunk})DOTEK\"\n")
    math(EXPR at "${at} + 8000")
  endwhile()
  if(literal STREQUAL "")
    set(literal "\"\"")
  endif()
  string(APPEND rows "    {\"${file}\", ${literal}},\n")
endforeach()
file(WRITE ${OUTPUT}.tmp "#include \"stdlib/EmbeddedData.h\"

namespace dotek::stdlib {
namespace {
constexpr EmbeddedFile kFiles[] = {
${rows}};
} // namespace
std::span<const EmbeddedFile> embeddedFiles() { return kFiles; }
} // namespace dotek::stdlib
")
file(COPY_FILE ${OUTPUT}.tmp ${OUTPUT} ONLY_IF_DIFFERENT)
file(TOUCH_NOCREATE ${OUTPUT})
