# Run by dotek_embed_text: writes OUTPUT, a function that gives the text of INPUT.
file(READ ${INPUT} text)
string(LENGTH "${text}" length)
set(literal "")
set(at 0)
while(at LESS length)
  string(SUBSTRING "${text}" ${at} 8000 chunk)
  string(APPEND literal "R\"DOTEK(${chunk})DOTEK\"\n")
  math(EXPR at "${at} + 8000")
endwhile()
file(WRITE ${OUTPUT}.tmp "#include \"${HEADER}\"

namespace ${NAMESPACE} {
std::string_view ${FUNCTION}() {
  return ${literal};
}
} // namespace ${NAMESPACE}
")
file(COPY_FILE ${OUTPUT}.tmp ${OUTPUT} ONLY_IF_DIFFERENT)
file(TOUCH_NOCREATE ${OUTPUT})
