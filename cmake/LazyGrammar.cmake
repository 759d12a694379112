# cmake -DSOURCE=XLexer.cpp -P LazyGrammar.cmake: changes what ANTLR wrote. The tables of a lexer or a parser are
# made with its first object, not before main(), where each command would pay for all languages; and what is
# generated here needs no check of its own consistency (docs/performance.md).
cmake_policy(VERSION 3.25)
get_filename_component(class ${SOURCE} NAME_WE)
file(READ ${SOURCE} text)
function(change from to)
  string(FIND "${text}" "${from}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${SOURCE} has no `${from}`: this version of ANTLR writes something else")
  endif()
  string(REPLACE "${from}" "${to}" text "${text}")
  set(text "${text}" PARENT_SCOPE)
endfunction()
change("${class}::Initializer ${class}::_init;" "")
change("  _interpreter = new" "  static const Initializer tables[[maybe_unused]];\n  _interpreter = new")
change("  atn::ATNDeserializer deserializer;"
       "  atn::ATNDeserializationOptions options;\n  options.setVerifyATN(false);\n  atn::ATNDeserializer deserializer(options);")
file(WRITE ${SOURCE} "${text}")
