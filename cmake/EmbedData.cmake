# Data files and pages become string literals: the program needs no files beside it.

# dotek_embed_folder(<folder> <output.cpp> <header> <namespace> <type> <function> <pattern>...): all files below the
# folder that match, as a table of <type>{name, text} sorted by name, and a function that gives it.
function(dotek_embed_folder folder output header namespace type function)
  set(globs ${ARGN})
  list(TRANSFORM globs PREPEND ${PROJECT_SOURCE_DIR}/${folder}/)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${globs})
  string(REPLACE ";" "|" patterns "${ARGN}")
  # A file that goes away is no newer input: the list of them is one.
  string(REPLACE ";" "\n" names "${files}")
  file(CONFIGURE OUTPUT ${output}.list CONTENT "${names}\n" @ONLY)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR}/${folder} -DOUTPUT=${output} -DPATTERNS=${patterns}
            -DHEADER=${header} -DNAMESPACE=${namespace} -DTYPE=${type} -DFUNCTION=${function}
            -P ${PROJECT_SOURCE_DIR}/cmake/EmbedScript.cmake
    DEPENDS ${files} ${output}.list ${PROJECT_SOURCE_DIR}/cmake/EmbedScript.cmake
    VERBATIM COMMENT "Embedding ${folder}")
endfunction()

# dotek_embed_files(<folder> <output.cpp> <header> <namespace> <type> <function> <file>...): the same for files that are named.
function(dotek_embed_files folder output header namespace type function)
  list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/${folder}/ OUTPUT_VARIABLE files)
  string(REPLACE ";" "|" names "${ARGN}")
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR}/${folder} -DOUTPUT=${output} -DFILES=${names}
            -DHEADER=${header} -DNAMESPACE=${namespace} -DTYPE=${type} -DFUNCTION=${function}
            -P ${PROJECT_SOURCE_DIR}/cmake/EmbedScript.cmake
    DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/EmbedScript.cmake
    VERBATIM COMMENT "Embedding pages of ${folder}")
endfunction()

# dotek_store_tables(<output.cpp>): the keyword tables in a form that needs no parser. The tool runs at build.
function(dotek_store_tables output)
  add_executable(dotek_store ${PROJECT_SOURCE_DIR}/stdlib/store/Main.cpp $<TARGET_OBJECTS:dotek_stdlib_objects>)
  target_link_libraries(dotek_store PRIVATE dotek_support dotek_options)
  add_custom_command(
    OUTPUT ${output}
    COMMAND dotek_store ${output}
    DEPENDS dotek_store
    VERBATIM COMMENT "Storing keyword tables")
endfunction()

# dotek_embed_text(<input> <output.cpp> <header> <namespace> <function>): one text file as a function that gives it.
function(dotek_embed_text input output header namespace function)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DINPUT=${PROJECT_SOURCE_DIR}/${input} -DOUTPUT=${output} -DHEADER=${header}
            -DNAMESPACE=${namespace} -DFUNCTION=${function} -P ${PROJECT_SOURCE_DIR}/cmake/EmbedTextScript.cmake
    DEPENDS ${PROJECT_SOURCE_DIR}/${input} ${PROJECT_SOURCE_DIR}/cmake/EmbedTextScript.cmake
    VERBATIM COMMENT "Embedding ${input}")
endfunction()
