# A folder is the registry of its units: no list is edited to add one.

# dotek_rules(<output.cpp> <sources variable>): each lint/rules/<id>.cpp is the rule <id>. Stops where its
# document is missing, or where a document has no rule.
function(dotek_rules output variable)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/lint/rules/*.cpp)
  file(GLOB documents CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/docs/rules/*.md)
  set(ids "")
  foreach(source IN LISTS sources)
    get_filename_component(id ${source} NAME_WE)
    list(APPEND ids ${id})
  endforeach()
  list(SORT ids)
  set(references "")
  set(rows "")
  foreach(id IN LISTS ids)
    if(NOT EXISTS ${CMAKE_SOURCE_DIR}/docs/rules/${id}.md)
      message(FATAL_ERROR "the rule ${id} has no docs/rules/${id}.md, which documents and tests it")
    endif()
    string(REPLACE "-" "_" name ${id})
    string(APPEND references "extern const Rule ${name};\n")
    string(APPEND rows "    {\"${id}\", &rule::${name}},\n")
  endforeach()
  foreach(document IN LISTS documents)
    get_filename_component(id ${document} NAME_WE)
    if(NOT id IN_LIST ids)
      message(FATAL_ERROR "docs/rules/${id}.md documents no rule of lint/rules")
    endif()
  endforeach()
  file(CONFIGURE OUTPUT ${output} CONTENT "#include \"lint/Rule.h\"

namespace dotek::lint {
namespace rule {
@references@} // namespace rule
namespace {
const NamedRule kRules[] = {
@rows@};
} // namespace
std::span<const NamedRule> rules() { return kRules; }
} // namespace dotek::lint
" @ONLY)
  set(${variable} ${sources} ${output} PARENT_SCOPE)
endfunction()
