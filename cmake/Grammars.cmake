# ANTLR4: generated at build, never committed. Only tool/runtime pairs that were tried are accepted.

find_program(ANTLR4_TOOL antlr4 REQUIRED)
find_package(Antlr4Runtime REQUIRED)
execute_process(COMMAND ${ANTLR4_TOOL} OUTPUT_VARIABLE ANTLR4_BANNER ERROR_VARIABLE ANTLR4_BANNER)
string(REGEX MATCH "Version ([0-9.]+)" ANTLR4_UNUSED "${ANTLR4_BANNER}")
set(ANTLR4_TOOL_VERSION "${CMAKE_MATCH_1}")
if(NOT ANTLR4_TOOL_VERSION VERSION_EQUAL "4.7.2")
  message(FATAL_ERROR "antlr4 tool ${ANTLR4_TOOL_VERSION}: tried and accepted is 4.7.2 with runtime 4.9")
endif()

# The runtime's umbrella header includes one file that clang rejects; a copy without it is first on the path.
set(ANTLR4_PATCHED ${PROJECT_BINARY_DIR}/generated/antlr4)
file(READ ${ANTLR4_RUNTIME_INCLUDE_DIR}/antlr4-runtime.h ANTLR4_UMBRELLA)
string(REPLACE "#include \"InterpreterDataReader.h\"" "" ANTLR4_UMBRELLA "${ANTLR4_UMBRELLA}")
string(REPLACE "#include \"misc/InterpreterDataReader.h\"" "" ANTLR4_UMBRELLA "${ANTLR4_UMBRELLA}")
file(CONFIGURE OUTPUT ${ANTLR4_PATCHED}/antlr4-runtime.h CONTENT "${ANTLR4_UMBRELLA}" @ONLY)

add_library(dotek_antlr INTERFACE)
target_include_directories(dotek_antlr SYSTEM BEFORE INTERFACE ${ANTLR4_PATCHED})
target_compile_options(dotek_antlr INTERFACE -fno-char8_t) # as all sources, so that one precompiled header serves
target_link_libraries(dotek_antlr INTERFACE Antlr4Runtime::Antlr4Runtime)

# dotek_grammar(<Name>): grammar/<Name>Lexer.g4 and <Name>Parser.g4 become the library dotek_grammar_<Name>.
function(dotek_grammar name)
  set(out ${PROJECT_BINARY_DIR}/generated/grammar/${name})
  set(lexer ${PROJECT_SOURCE_DIR}/grammar/${name}Lexer.g4)
  set(parser ${PROJECT_SOURCE_DIR}/grammar/${name}Parser.g4)
  add_custom_command(
    OUTPUT ${out}/${name}Lexer.cpp ${out}/${name}Lexer.h ${out}/${name}Parser.cpp ${out}/${name}Parser.h
    COMMAND ${ANTLR4_TOOL} -Werror -Dlanguage=Cpp -no-listener -no-visitor -package dotek::grammar
            -Xexact-output-dir -o ${out} ${lexer}
    COMMAND ${ANTLR4_TOOL} -Werror -Dlanguage=Cpp -no-listener -no-visitor -package dotek::grammar
            -Xexact-output-dir -o ${out} -lib ${out} ${parser}
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${out}/${name}Lexer.cpp -P ${PROJECT_SOURCE_DIR}/cmake/LazyGrammar.cmake
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${out}/${name}Parser.cpp -P ${PROJECT_SOURCE_DIR}/cmake/LazyGrammar.cmake
    DEPENDS ${lexer} ${parser} ${PROJECT_SOURCE_DIR}/cmake/LazyGrammar.cmake
    VERBATIM COMMENT "ANTLR ${name}")
  add_library(dotek_grammar_${name} STATIC ${out}/${name}Lexer.cpp ${out}/${name}Parser.cpp)
  target_include_directories(dotek_grammar_${name} SYSTEM PUBLIC ${out})
  target_link_libraries(dotek_grammar_${name} PUBLIC dotek_antlr)
  set_property(GLOBAL APPEND PROPERTY DOTEK_LIBRARIES dotek_grammar_${name})
  target_compile_options(dotek_grammar_${name} PRIVATE -w)
  if(DOTEK_SANITIZE)
    target_compile_options(dotek_grammar_${name} PRIVATE -O1 -fsanitize=address)
  endif()
endfunction()
