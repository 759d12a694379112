#include "driver/Session.h"

#include "driver/Assumptions.h"
#include "support/Files.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Gibbs.h"
#include "support/messages/Mikroprog.h"
#include "support/messages/Nc.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

namespace dotek::driver {

Session::Session(const CommonOptions& options) : options_(options) {
  checkAssumptions(options.assume, diagnostics_);
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
  auto& all = diagnostics_.all();
  // A run that stopped at a construct has said all that the note says.
  std::set<SourceRange, bool (*)(const SourceRange&, const SourceRange&)> stopped(
      [](const SourceRange& a, const SourceRange& b) {
        return std::tie(a.file, a.begin, a.end) < std::tie(b.file, b.begin, b.end);
      });
  for (const Diagnostic& d : all) {
    if (d.code == diag::UnverifiedConstructRun::code) stopped.insert(d.range);
  }
  std::erase_if(all, [&](const Diagnostic& d) {
    return d.code == diag::UnverifiedConstruct::code && stopped.contains(d.range);
  });
  const bool usage = std::any_of(all.begin(), all.end(), [](const Diagnostic& d) {
    // What stands in a file is an error of that input, not of the command line.
    return d.severity == Severity::Error && isUsageCode(d.code) && !d.range.hasPlace();
  });
  const bool defect = std::any_of(all.begin(), all.end(),
                                  [](const Diagnostic& d) { return d.code == diag::InternalDefect::code; });
  outcome.status = defect ? 3 : usage ? 2 : diagnostics_.hasErrors() ? 1 : 0;
  if (outcome.status == 0 || keepOutput) outcome.output = std::move(output);
  outcome.sources = std::move(sources_);
  outcome.diagnostics = std::move(diagnostics_);
  outcome.diagnostics.sort();
  return outcome;
}

void keepStrongest(Diagnostics& diagnostics) {
  std::map<std::pair<FileId, std::uint32_t>, Severity> strongest;
  // An empty range at the beginning stands for the whole file.
  const auto narrow = [](const Diagnostic& d) { return d.range.hasPlace() && d.range.end > d.range.begin; };
  for (const Diagnostic& d : diagnostics.all()) {
    if (!narrow(d)) continue;
    const auto [at, added] = strongest.try_emplace({d.range.file, d.range.begin}, d.severity);
    if (!added) at->second = std::max(at->second, d.severity);
  }
  std::erase_if(diagnostics.all(), [&](const Diagnostic& d) {
    // Tells of another thing than the warning about the digits that stand there.
    if (d.code == diag::PictureDecimals::code) return false;
    return narrow(d) && d.severity < strongest.at({d.range.file, d.range.begin});
  });
}

bool isUsageCode(std::string_view code) {
  constexpr std::array kCodes = {
      diag::FileNotFound::code,     diag::FileNotReadable::code, diag::FileNotWritable::code,
      diag::FileTooLarge::code,     diag::TooManyFiles::code,    diag::UnknownForm::code,
      diag::UnknownHost::code,      diag::NotANumber::code,      diag::GivenTwice::code,
      diag::UnknownName::code,      diag::MissingOption::code,   diag::DataFileDefect::code,
      diag::UnknownKind::code,      diag::UnknownCode::code,     diag::UnknownList::code,
      diag::NoSuchField::code,      diag::HostInputRange::code,  diag::UnknownAssumption::code,
      diag::CycleWithSeveral::code, diag::CycleNameTwice::code,  diag::NotAFolder::code,
      diag::UnknownTarget::code,    diag::UnknownProfile::code,  diag::UnknownMacroSet::code,
      diag::LetterNotAllowed::code, diag::OutputForOne::code,    diag::ArgumentUnknown::code,
      diag::LetterTwice::code,      diag::VariableFlag::code,    diag::FlagOfOtherTarget::code,
      diag::UnknownDatum::code,     diag::OptionOfCycles::code,  diag::OptionOfPrograms::code,
      diag::ProgramTarget::code,    diag::OptionOfMacroB::code,
  };
  return std::find(kCodes.begin(), kCodes.end(), code) != kCodes.end();
}

} // namespace dotek::driver
