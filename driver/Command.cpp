#include "driver/Command.h"

#include "frontend/compost/Check.h"
#include "frontend/gibbs/Check.h"
#include "project/Settings.h"
#include "support/messages/ComPost.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Gibbs.h"
#include "support/messages/Lint.h"
#include "support/messages/MacroB.h"
#include "support/messages/Mikroprog.h"
#include "support/messages/Nc.h"
#include "support/messages/Output.h"
#include "support/messages/Posts.h"
#include "support/messages/Sim.h"
#include "support/messages/Verify.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <new>
#include <set>
#include <tuple>

namespace dotek::driver {

namespace {

// Of findings that have one cause wherever they begin, the first one is kept. They are sorted.
void keepFirstOfCause(Diagnostics& diagnostics) {
  std::set<std::string> told;
  std::erase_if(diagnostics.all(), [&](const Diagnostic& d) {
    return d.code == diag::FormAssumed::code && !told.insert(d.message).second;
  });
}

// Of findings that a whole file has for one cause the first one stays and lists the others. They are sorted.
void joinAlike(Diagnostics& diagnostics, const SourceMap& sources) {
  constexpr std::array<std::string_view, 3> kJoined = {diag::SmallLetter::code, "position-read-at-entry",
                                                       frontend::compost::routineNeverCalledCheck.code};
  struct Others {
    std::size_t count = 0;
    SourceRange next;
    std::string text;
  };
  std::map<std::pair<std::string_view, FileId>, std::size_t> first; // place in all()
  std::map<std::size_t, Others> others;
  std::vector<Diagnostic> kept;
  for (Diagnostic& one : diagnostics.all()) {
    const bool joined = one.range.hasPlace() && std::find(kJoined.begin(), kJoined.end(),
                                                          std::string_view(one.code)) != kJoined.end();
    if (joined) {
      const auto [at, added] = first.try_emplace({one.code, one.range.file}, kept.size());
      if (!added) {
        Others& more = others[at->second];
        constexpr std::size_t kListed = 5;
        if (more.count++ == 0) more.next = one.range;
        if (more.count <= kListed)
          more.text +=
              fmt::format("{}`{}` (line {})", more.text.empty() ? "" : ", ", sources.textUtf8(one.range),
                          sources.file(one.range.file).place(one.range.begin).line);
        else if (more.count == kListed + 1)
          more.text += ", ..";
        continue;
      }
    }
    kept.push_back(std::move(one));
  }
  for (const auto& [at, more] : others)
    kept[at].note(more.next, fmt::format("and {} more in this file: {}{}", more.count, more.text,
                                         std::string_view(kept[at].code) == diag::SmallLetter::code
                                             ? "; `dotek fmt --write` writes all of them in capitals"
                                             : ""));
  diagnostics.all() = std::move(kept);
}

// The input is of a kind that the command does not take; the place only names the file.
bool isOfKind(std::string_view code) {
  return code == diag::UnknownKind::code || code == diag::WrongKind::code ||
         code == diag::OtherDialect::code || code == diag::PostNotTaken::code;
}

} // namespace

Outcome outcomeOf(Session& session, std::string output, bool keepOutput) {
  Outcome outcome;
  auto& all = session.diagnostics().all();
  // A run that stopped at a construct has said all that the note says.
  std::set<SourceRange, bool (*)(const SourceRange&, const SourceRange&)> stopped(
      [](const SourceRange& a, const SourceRange& b) {
        return std::tie(a.file, a.begin, a.end) < std::tie(b.file, b.begin, b.end);
      });
  for (const Diagnostic& d : all) {
    if (d.code == diag::UnverifiedConstructRun::code) stopped.insert(d.range);
  }
  std::erase_if(all, [&](const Diagnostic& d) {
    return d.code == frontend::gibbs::unverifiedConstructCheck.code && stopped.contains(d.range);
  });
  const bool usage = std::any_of(all.begin(), all.end(), [](const Diagnostic& d) {
    // What is in a file is an error of that input, not of the command line.
    return d.severity == Severity::Error && isUsageCode(d.code) && (!d.range.hasPlace() || isOfKind(d.code));
  });
  const bool defect = std::any_of(all.begin(), all.end(),
                                  [](const Diagnostic& d) { return d.code == diag::InternalDefect::code; });
  outcome.status = defect ? 3 : usage ? 2 : session.diagnostics().hasErrors() ? 1 : 0;
  if (outcome.status == 0 || keepOutput) outcome.output = std::move(output);
  outcome.sources = std::move(session.sources());
  outcome.diagnostics = std::move(session.diagnostics());
  outcome.diagnostics.sort();
  keepFirstOfCause(outcome.diagnostics);
  joinAlike(outcome.diagnostics, outcome.sources);
  return outcome;
}

void checkSettings(const std::vector<std::string>& inputs, Session& session) {
  if (inputs.empty()) static_cast<void>(project::settingsOf(".", session));
  for (const std::string& input : inputs)
    static_cast<void>(project::settingsOf(input, session));
}

Outcome refusalOf(Session& session) {
  keepStrongest(session.diagnostics());
  Outcome outcome = outcomeOf(session, "");
  std::vector<Diagnostic>& all = outcome.diagnostics.all();
  std::stable_partition(all.begin(), all.end(),
                        [](const Diagnostic& d) { return d.severity == Severity::Error; });
  return outcome;
}

void reportUnknownPairs(const CommonOptions& options, const std::set<std::string>& used,
                        const std::string& cycles, Diagnostics& diagnostics) {
  for (const auto& [postField, variable] : options.field)
    if (const std::string pair = postField + "=" + variable; !used.contains(pair))
      diagnostics.report<diag::UnknownName>(
          {}, "--field", pair, "pair of a field that the post prints and a variable of the macro in `",
          cycles + "`");
}

Outcome outcomeOf(const std::exception_ptr& thrown) {
  Outcome outcome;
  outcome.status = 2;
  try {
    std::rethrow_exception(thrown);
  } catch (const stdlib::DataError& error) {
    outcome.diagnostics.report<diag::DataFileDefect>({}, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    outcome.diagnostics.report<diag::FileNotReadable>({}, error.path1().string(), error.code().message());
  } catch (const std::bad_alloc&) {
    outcome.diagnostics.report<diag::OutOfMemory>({});
  } catch (const std::exception& error) {
    outcome.diagnostics.report<diag::InternalDefect>({}, error.what());
    outcome.status = 3;
  } catch (...) {
    outcome.diagnostics.report<diag::InternalDefect>({}, "something unknown was thrown");
    outcome.status = 3;
  }
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
    // Reports another thing than the warning about the digits that are there.
    if (d.code == diag::PictureDecimals::code) return false;
    return narrow(d) && d.severity < strongest.at({d.range.file, d.range.begin});
  });
}

bool isUsageCode(std::string_view code) {
  constexpr std::array kCodes = {
      diag::FileNotFound::code,      diag::FileNotReadable::code,  diag::FileNotWritable::code,
      diag::FileTooLarge::code,      diag::TooManyFiles::code,     diag::UnknownForm::code,
      diag::SettingsExist::code,     diag::FormName::code,         diag::UnknownHost::code,
      diag::NotANumber::code,        diag::GivenTwice::code,       diag::UnknownName::code,
      diag::MissingOption::code,     diag::DataFileDefect::code,   diag::UnknownKind::code,
      diag::WrongKind::code,         diag::NothingRead::code,      diag::UnknownCode::code,
      diag::UnknownList::code,       diag::NoSuchField::code,      diag::HostInputRange::code,
      diag::UnknownAssumption::code, diag::CycleWithSeveral::code, diag::CycleNameTwice::code,
      diag::NotAFolder::code,        diag::UnknownTarget::code,    diag::UnknownProfile::code,
      diag::UnknownMacroSet::code,   diag::LetterNotAllowed::code, diag::OutputForOne::code,
      diag::ArgumentUnknown::code,   diag::LetterTwice::code,      diag::VariableFlag::code,
      diag::FlagOfOtherTarget::code, diag::UnknownDatum::code,     diag::OptionOfCycles::code,
      diag::OptionOfPrograms::code,  diag::OtherDialect::code,     diag::ProgramTarget::code,
      diag::OptionOfMacroB::code,    diag::ScriptNotRun::code,     diag::BaselineUnreadable::code,
      diag::PostNotTaken::code,
  };
  return std::find(kCodes.begin(), kCodes.end(), code) != kCodes.end();
}

} // namespace dotek::driver
