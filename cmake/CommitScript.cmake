# Run by each build: writes OUTPUT, what `dotek --version` says of the sources: the commit, with a `+` where files differ from
# it, and the version of the data. A tree without git has COMMIT, or none.
if(NOT COMMIT)
  execute_process(COMMAND git -C ${SOURCE} describe --always --dirty=+ --abbrev=10 --exclude=*
                  OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(failed OR NOT COMMIT)
    set(COMMIT "not known")
  endif()
endif()
file(SHA256 ${DATA} data)
string(SUBSTRING ${data} 0 10 data)
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#include \"cli/Build.h\"

namespace dotek::cli {

std::string_view builtCommit() {
  return \"${COMMIT}\";
}

std::string_view dataVersion() {
  return \"${data}\";
}

} // namespace dotek::cli
")
