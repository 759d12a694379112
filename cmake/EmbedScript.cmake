# Run by dotek_embed_folder and dotek_embed_files: writes OUTPUT, a sorted table of the files below ROOT that match one of PATTERNS, or
# are named in FILES.
if(DEFINED FILES)
  string(REPLACE "|" ";" files "${FILES}")
else()
  string(REPLACE "|" ";" globs "${PATTERNS}")
  list(TRANSFORM globs PREPEND ${ROOT}/)
  file(GLOB_RECURSE files RELATIVE ${ROOT} ${globs})
endif()
list(SORT files)
set(rows "")
foreach(file IN LISTS files)
  file(READ ${ROOT}/${file} text)
  string(LENGTH "${text}" length)
  set(literal "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 8000 chunk)
    string(APPEND literal "R\"DOTEK(${chunk})DOTEK\"sv\n")
    math(EXPR at "${at} + 8000")
  endwhile()
  if(literal STREQUAL "")
    set(literal "\"\"sv")
  endif()
  string(APPEND rows "    {\"${file}\", ${literal}},\n")
endforeach()
file(WRITE ${OUTPUT}.tmp "#include \"${HEADER}\"

namespace ${NAMESPACE} {
namespace {
using namespace std::string_view_literals; // the compiler counts: clang bounds the steps of a constexpr strlen
constexpr ${TYPE} kFiles[] = {
${rows}};
} // namespace
std::span<const ${TYPE}> ${FUNCTION}() { return kFiles; }
} // namespace ${NAMESPACE}
")
file(COPY_FILE ${OUTPUT}.tmp ${OUTPUT} ONLY_IF_DIFFERENT)
file(TOUCH_NOCREATE ${OUTPUT})
