#include "driver/Session.h"

#include "support/Files.h"

#include <algorithm>
#include <array>

namespace dotek::driver {

Session::Session(const CommonOptions& options) : options_(options) {
  for (const std::string& folder : options.data)
    data_.addFolder(folder, options.limits, diagnostics_);
}

const stdlib::GibbsKeywords& Session::gibbsKeywords() {
  if (!gibbs_) gibbs_.emplace(stdlib::GibbsKeywords::load(data_));
  return *gibbs_;
}

const stdlib::ComPostKeywords& Session::compostKeywords() {
  if (!compost_) compost_.emplace(stdlib::ComPostKeywords::load(data_));
  return *compost_;
}

std::optional<stdlib::Form> Session::form(const std::string& name) {
  std::optional<stdlib::Form> form = stdlib::Form::load(data_, name, compostKeywords());
  if (!form) {
    std::string known;
    for (const stdlib::DataFile* file : data_.list("forms"))
      known += (known.empty() ? "" : ", ") + file->name;
    diagnostics_.report<diag::UnknownForm>({}, name, known);
  }
  return form;
}

std::optional<FileId> Session::read(const std::string& path, Encoding fallback) {
  const auto known = read_.find(path);
  if (known != read_.end()) return known->second;
  if (read_.size() >= options_.limits.files) {
    diagnostics_.report<diag::TooManyFiles>({}, options_.limits.files);
    return std::nullopt;
  }
  const std::optional<FileId> id =
      readText(path, fallback, options_.encoding, options_.limits, sources_, diagnostics_);
  read_.emplace(path, id);
  return id;
}

Outcome Session::finish(std::string output, bool keepOutput) {
  Outcome outcome;
  const auto& all = diagnostics_.all();
  const bool usage = std::any_of(all.begin(), all.end(), [](const Diagnostic& d) {
    return d.severity == Severity::Error && isUsageCode(d.code);
  });
  outcome.status = usage ? 2 : diagnostics_.hasErrors() ? 1 : 0;
  if (outcome.status == 0 || keepOutput) outcome.output = std::move(output);
  outcome.sources = std::move(sources_);
  outcome.diagnostics = std::move(diagnostics_);
  outcome.diagnostics.sort();
  return outcome;
}

bool isUsageCode(std::string_view code) {
  constexpr std::array kCodes = {
      diag::FileNotFound::code, diag::FileNotReadable::code, diag::FileNotWritable::code,
      diag::FileTooLarge::code, diag::TooManyFiles::code,    diag::UnknownForm::code,
      diag::UnknownHost::code,  diag::NotANumber::code,      diag::GivenTwice::code,
      diag::UnknownName::code,  diag::MissingOption::code,   diag::DataFileDefect::code,
      diag::UnknownKind::code,  diag::UnknownCode::code,     diag::UnknownList::code,
      diag::NoSuchField::code,
  };
  return std::find(kCodes.begin(), kCodes.end(), code) != kCodes.end();
}

} // namespace dotek::driver
