#include "project/FormChoice.h"

#include "support/messages/Commands.h"

#include <filesystem>

namespace dotek::project {

namespace fs = std::filesystem;

namespace {

// "" where no file says it. lint reports the keys that nobody knows.
std::string formOfFile(const std::string& prog, Session& session) {
  std::error_code error;
  for (fs::path folder = fs::absolute(prog, error).lexically_normal().parent_path(); !folder.empty();
       folder = folder.parent_path()) {
    const fs::path file = folder / "dotek.toml";
    if (fs::is_regular_file(file, error)) {
      const fs::path near = file.lexically_proximate(fs::current_path(error));
      const auto id = session.read((near.empty() ? file : near).generic_string(), Encoding::Utf8);
      if (!id) return "";
      const auto document = stdlib::TomlDocument::parse(*id, session.sources(), session.diagnostics());
      return document ? formOf(*document) : "";
    }
    if (folder == folder.root_path()) break;
  }
  return "";
}

} // namespace

std::string formOf(const stdlib::TomlDocument& document) {
  const std::string form = document.root().value("form").text();
  const std::string ofLint = document.root().value("lint").table().value("form").text();
  return form.empty() ? ofLint : form;
}

FormChoice chooseForm(const SourceOptions& source, Session& session) {
  if (source.form) return {*source.form, true};
  const std::string form = source.prog ? formOfFile(*source.prog, session) : "";
  if (!form.empty()) return {form, true};
  return {std::string(kDefaultForm), false};
}

void noteForm(const FormChoice& choice, FileId prog, Session& session) {
  if (!choice.named)
    session.diagnostics().report<diag::FormTaken>({prog, 0, 0}, choice.name,
                                                  session.sources().file(prog).name());
}

} // namespace dotek::project
