#include "targets/VerifyReport.h"

#include "stdlib/HostInputs.h"
#include "support/Ascii.h"
#include "support/Decimal.h"
#include "support/messages/Verify.h"
#include "targets/Target.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <tuple>
#include <utility>

namespace dotek::targets {

namespace {

constexpr std::size_t kMostTold = 20;       // differences; more are counted
constexpr std::uint32_t kMostShrinks = 400; // runs for one of them

std::string_view pairName(CaseFinding::Pair pair) {
  switch (pair) {
  case CaseFinding::Pair::SourceAndTranslation: return "source against translation";
  case CaseFinding::Pair::PathAndTranslation: return "drawn path against translation";
  case CaseFinding::Pair::PathAndPost: return "drawn path against post";
  }
  return "";
}

std::string quoted(const std::string& text) {
  const bool plain = text.find_first_of(" '\"$&;()<>|*?\\") == std::string::npos;
  return plain ? text : "'" + text + "'";
}

void addFlag(std::string& command, std::string_view name, const std::string& value) {
  command += fmt::format(" {} {}", name, quoted(value));
}

bool isHeight(std::string_view host) {
  return host == "clearance" || host == "retract" || host == "start_z";
}

// What a text says, without its numbers, and by how much those before "against" differ from those after it.
struct Said {
  std::string words;
  double apart = 0;
};

Said saidIn(const std::string& text) {
  Said out;
  std::vector<double> numbers;
  std::size_t before = 0; // how many come before "against"
  for (std::size_t i = 0; i < text.size();) {
    const bool sign = text[i] == '-' && i + 1 < text.size() && isDigit(text[i + 1]);
    if (!sign && !isDigit(text[i])) {
      if (text.compare(i, 7, "against") == 0) before = numbers.size();
      out.words += text[i++];
      continue;
    }
    std::size_t end = i + 1;
    while (end < text.size() && (isDigit(text[end]) || text[end] == '.'))
      ++end;
    numbers.push_back(parseNumber(text.substr(i, end - i)).value_or(0));
    out.words += '0';
    i = end;
  }
  for (std::size_t i = 0; numbers.size() == 2 * before && i < before; ++i)
    out.apart = std::max(out.apart, std::abs(numbers[i] - numbers[before + i]));
  return out;
}

// The same difference, though of other values: it may have become smaller, not much larger.
bool saysTheSame(const std::string& one, const std::string& simpler) {
  constexpr double kLarger = 10;
  const Said a = saidIn(one), b = saidIn(simpler);
  return a.words == b.words && b.apart <= kLarger * a.apart;
}

// Which system or tool it is may be drawn: one statement, one difference, but for the axes.
std::string keptSubject(const CaseFinding& finding) {
  const std::string& subject = finding.subject;
  if (finding.aspect == verify::Aspect::Variable || subject.empty()) return subject;
  const std::string side = subject.starts_with("only ") ? "only " : "";
  return finding.aspect == verify::Aspect::Offset ? side + subject.back() : side;
}

bool before(const SourceRange& a, const SourceRange& b) {
  return std::pair(a.file, a.begin) < std::pair(b.file, b.begin);
}

} // namespace

VerifyReport::Key VerifyReport::keyOf(bool edge, const CaseFinding& finding) {
  return {edge,
          finding.pair,
          finding.aspect,
          finding.source.file,
          finding.source.begin,
          finding.targetLine != 0 ? finding.targetLine : finding.posted.begin,
          keptSubject(finding)};
}

void VerifyReport::add(std::uint64_t number, bool edge, verify::Case drawn, CaseResult result) {
  Counts& counts = edge ? edges_ : cases_;
  switch (result.verdict) {
  case CaseVerdict::Agrees: ++counts.agree; break;
  case CaseVerdict::Undecided: ++counts.undecided; break;
  case CaseVerdict::Differ: ++counts.differ; break;
  case CaseVerdict::Refused: ++counts.refused; break;
  case CaseVerdict::NoProgram: ++counts.none; break;
  }
  const bool ofPost = std::all_of(result.findings.begin(), result.findings.end(), [](const CaseFinding& one) {
    return one.pair == CaseFinding::Pair::PathAndPost;
  });
  std::set<const Group*> counted; // several callers of one case may see the same
  for (CaseFinding& finding : result.findings) {
    Group& group = groups_[keyOf(edge, finding)];
    if (group.count == 0 || number < group.first) {
      group.first = number;
      group.edge = edge;
      group.drawn = drawn;
      group.finding = std::move(finding);
    }
    if (!counted.insert(&group).second) continue;
    ++group.count;
    if (ofPost) ++group.alone;
  }
  partsMade_ = partsMade_ || (options_.part && result.partMade);
  const bool idles = edge ? result.verdict == CaseVerdict::NoProgram
                          : result.verdict != CaseVerdict::Agrees && result.verdict != CaseVerdict::Differ;
  if (idles) {
    Idle& idle = idle_[{edge, result.whyAt.file, result.whyAt.begin, result.why}];
    if (idle.count == 0 || number < idle.first) {
      idle.first = number;
      idle.edge = edge;
      idle.at = result.whyAt;
      idle.why = result.why;
      idle.drawn = drawn;
      idle.remedy = result.remedy;
    }
    ++idle.count;
    idle.rejected += result.rejected;
  }
  for (const SourceRange& alarm : result.alarms)
    alarms_.emplace(alarm.file, alarm.begin);
  for (const SourceRange& one : result.reached)
    reached_.emplace(one.file, one.begin);
  for (const SourceRange& alarm : result.printed)
    printed_.try_emplace({alarm.file, alarm.begin}, alarm);
  if (edge) return;
  for (auto& [at, what] : result.unstated)
    unstated_.emplace(std::pair(at.file, at.begin), std::pair(at, std::move(what)));
  for (const auto& [at, program] : result.absent)
    absent_.try_emplace({at.file, at.begin}, at, program);
  if (result.unprotected) {
    const auto [at, added] =
        unprotected_.emplace(std::pair(result.unprotected->file, result.unprotected->begin),
                             std::pair(*result.unprotected, result.spindleLater));
    if (!added) at->second.second = at->second.second || result.spindleLater;
  }
  if (result.unarmed && (!unarmed_ || before(*result.unarmed, *unarmed_))) unarmed_ = result.unarmed;
  if (result.verdict == CaseVerdict::Agrees && (!agreeing_ || number < agreeing_->first))
    agreeing_.emplace(number, std::move(drawn));
}

void VerifyReport::addReplaced(std::uint64_t number, verify::Case drawn, CaseResult result) {
  Idle& one = replaced_[{false, result.whyAt.file, result.whyAt.begin, result.why}];
  if (one.count == 0 || number < one.first) {
    one.first = number;
    one.at = result.whyAt;
    one.why = result.why;
    one.drawn = std::move(drawn);
  }
  ++one.count;
}

void VerifyReport::addStopped(std::uint64_t number, Stopped stopped) {
  if (!stopped_ || number < stopped_->first) stopped_ = {number, std::move(stopped)};
}

bool VerifyReport::tellStopped() {
  if (!stopped_) return false;
  auto& [number, stopped] = *stopped_;
  stopped.why.note({}, "with these values: " + replay(stopped.drawn));
  runner_.session().diagnostics() = Diagnostics();
  runner_.session().diagnostics().add(std::move(stopped.why));
  return true;
}

bool VerifyReport::stillDiffers(const verify::Case& drawn, const CaseFinding& finding) {
  const CaseResult result = runner_.run(drawn);
  return std::any_of(result.findings.begin(), result.findings.end(), [&](const CaseFinding& one) {
    return keyOf(false, one) == keyOf(false, finding) && saysTheSame(finding.text, one.text);
  });
}

// Simpler values as long as the same difference stays.
verify::Case VerifyReport::shrink(const Group& group) {
  verify::Case best = group.drawn;
  std::uint32_t runs = 0;
  const auto attempt = [&](const verify::Case& simpler) {
    if (runs >= kMostShrinks) return false;
    ++runs;
    if (!stillDiffers(simpler, group.finding)) return false;
    best = simpler;
    return true;
  };
  verify::Case plain = best;
  plain.error = {};
  if (!options_.partError) attempt(plain);
  // What sets the system in force moves all that follows it: another difference.
  const auto setsActive = [&](const verify::Case& one) {
    return std::any_of(plan_.fields.begin(), plan_.fields.end(), [&](const verify::DrawField& field) {
      const auto value = one.values.find(field.name);
      return field.kind == ir::Kind::WorkOffset && value != one.values.end() &&
             field.systemOf(value->second) == one.system;
    });
  };
  const auto simplify = [&](auto member, const std::string& name, std::vector<double> candidates) {
    for (const double value : candidates) {
      const double now = (best.*member).at(name);
      if (value == now || std::abs(value) > std::abs(now) || !stdlib::hostInputRefuses(name, value).empty())
        continue;
      verify::Case simpler = best;
      (simpler.*member)[name] = value;
      if (member == &verify::Case::hosts && isHeight(name)) // planes that are one stay one
        for (auto& [other, height] : simpler.hosts)
          if (isHeight(other) && height == now && !plan_.fixedHosts.contains(other)) height = value;
      if (setsActive(simpler) && !setsActive(best)) continue;
      if (attempt(simpler)) return;
    }
  };
  for (const verify::DrawField& field : plan_.fields) {
    const auto value = best.values.find(field.name);
    if (field.fixed || value == best.values.end()) continue;
    const double now = value->second;
    simplify(&verify::Case::values, field.name,
             {0.0, field.initial.value_or(now), std::round(now / 10) * 10, std::round(now), std::trunc(now)});
  }
  const std::map<std::string, double> hosts = best.hosts;
  for (const auto& [name, value] : hosts) {
    if (plan_.fixedHosts.contains(name)) continue;
    simplify(&verify::Case::hosts, name,
             {0.0, std::round(value / 10) * 10, std::round(value), std::trunc(value)});
  }
  return best;
}

std::string VerifyReport::command() const {
  std::string out = "dotek verify " + quoted(options_.inputs.front());
  const auto flag = [&](std::string_view name, const std::string& value) { addFlag(out, name, value); };
  if (options_.source.prog) flag("--prog", *options_.source.prog);
  if (options_.source.form) flag("--form", *options_.source.form);
  if (options_.source.routine) flag("--routine", *options_.source.routine);
  if (options_.source.cycle) flag("--cycle", *options_.source.cycle);
  if (!options_.to.empty()) flag("--to", options_.to);
  if (!options_.control.empty()) flag("--control", options_.control);
  if (!options_.fromControl.empty()) flag("--from-control", options_.fromControl);
  if (options_.probeMacros) flag("--probe-macros", *options_.probeMacros);
  if (!options_.datum.empty()) flag("--datum", options_.datum);
  if (options_.calls != Calls::Inline) flag("--calls", std::string(callsText(options_.calls)));
  for (const auto& [name, variable] : options_.results)
    flag("--result", name + "=" + variable);
  for (const auto& [name, value] : options_.defaults)
    flag("--default", name + "=" + value);
  if (options_.useDefaults) flag("--defaults", "use");
  if (options_.switchProbe) flag("--probe-power", "macro");
  for (const auto& [name, letter] : options_.letters)
    flag("--arg", name + "=" + letter);
  if (options_.programNumber) flag("--program-number", std::to_string(*options_.programNumber));
  if (options_.common.job) flag("--job", *options_.common.job);
  if (options_.translation) flag("--translation", *options_.translation);
  if (options_.allowEdits) out += " --allow-edits";
  if (options_.part) flag("--part", *options_.part);
  if (options_.machine) flag("--machine", *options_.machine);
  for (const std::string& assumption : options_.common.assume)
    if (!options_.switchProbe || assumption != "probe-on") flag("--assume", assumption);
  if (options_.common.recover) out += " --recover";
  if (!options_.common.probeCodes.on.empty()) flag("--probe-on", options_.common.probeCodes.on);
  if (!options_.common.probeCodes.off.empty()) flag("--probe-off", options_.common.probeCodes.off);
  for (const auto& [field, variable] : options_.common.field)
    flag("--field", field + "=" + variable);
  for (const std::string& folder : options_.common.data)
    flag("--data", folder);
  return out;
}

std::string VerifyReport::replay(const verify::Case& drawn) const {
  std::string out = command();
  const auto flag = [&](std::string_view name, const std::string& value) { addFlag(out, name, value); };
  // What the user has fixed belongs to the translation; the values of the case do not.
  const Target* target = findTarget(options_.to);
  const bool writtenForCase = target != nullptr && target->fixesValues;
  std::set<std::string> known;
  for (const auto& [name, value] : drawn.values) {
    flag(plan_.programs ? "--var" : writtenForCase ? "--set" : "--value", name + "=" + numberText(value));
    if (writtenForCase) known.insert(name);
  }
  for (const auto& [name, text] : options_.common.set)
    if (!known.contains(name)) flag("--set", name + "=" + text);
  for (const auto& [number, value] : drawn.variables)
    flag("--var", fmt::format("{}={}", number, numberText(value)));
  for (const auto& [number, text] : options_.variables)
    if (!plan_.programs) flag("--var", number + "=" + text);
  known.clear();
  const bool asHost = plan_.programs || writtenForCase;
  for (const auto& [name, value] : drawn.hosts) {
    flag(asHost ? "--host" : "--value", name + "=" + numberText(value));
    if (asHost) known.insert(name);
  }
  for (const auto& [name, text] : options_.common.host)
    if (!known.contains(name)) flag("--host", name + "=" + text);
  flag("--part-error",
       fmt::format("{},{},{},{}", numberText(drawn.error.shift.x), numberText(drawn.error.shift.y),
                   numberText(drawn.error.shift.z), numberText(drawn.error.turn)));
  flag("--active-system", std::to_string(drawn.system));
  return out + " --replay";
}

namespace {

// A line without the blanks before it.
SourceRange lineRange(const SourceMap& sources, FileId id, std::uint32_t line) {
  const SourceFile& file = sources.file(id);
  const std::string_view text = file.line(line);
  const std::size_t blank = std::min(text.find_first_not_of(" \t"), text.size());
  const std::uint32_t begin = file.lineStart(line);
  return {id, begin + static_cast<std::uint32_t>(blank), begin + static_cast<std::uint32_t>(text.size())};
}

} // namespace

void VerifyReport::tellDifference(const Group& group, std::uint64_t of) {
  Diagnostics& diagnostics = runner_.session().diagnostics();
  const verify::Case smallest = options_.replay ? group.drawn : shrink(group);
  diagnostics = std::move(told_);
  const std::string_view aspect = verify::aspectName(group.finding.aspect);
  const std::string_view which = group.edge ? " at edges" : "";
  SourceRange place = group.finding.source;
  if (!place.hasPlace()) place = sourceOfLine(group.finding.targetLine);
  const std::uint32_t targetLine = group.finding.targetLine;
  const bool post = group.finding.pair == CaseFinding::Pair::PathAndPost;
  Diagnostic& finding =
      post ? diagnostics.report<diag::VerifyPathDiffers>(place, aspect, group.finding.text, group.count, of,
                                                         which)
           : diagnostics.report<diag::VerifyDiffers>(place, aspect, group.finding.text,
                                                     pairName(group.finding.pair), group.count, of, which);
  if (post && plan_.translation && group.alone == group.count)
    finding.note({}, "the translation does the same as the post in these cases; it is the macro and the post "
                     "that disagree");
  for (const verify::DrawField& field : plan_.fields) {
    const auto value = smallest.values.find(field.name);
    if (field.kind != ir::Kind::WorkOffset || value == smallest.values.end() ||
        field.systemOf(value->second) != smallest.system)
      continue;
    finding.note({}, fmt::format("{} = {} sets G{}, the system in force: what follows it is moved by it",
                                 field.name, numberText(value->second), smallest.system));
  }
  const std::string command = replay(smallest);
  document_.differences.push_back(
      {std::string(pairName(group.finding.pair)), std::string(aspect), group.finding.text, group.count, of,
       group.edge, excerptOf(place), excerptOf(group.finding.posted),
       targetLine == 0 ? VerifyDocument::Excerpt{} : excerptOf(targetRange(targetLine)), command});
  if (group.finding.posted.hasPlace()) finding.note(group.finding.posted, "the post prints this here");
  if (targetLine != 0) finding.note(targetRange(targetLine), "of the translation");
  finding.note({}, "replay: " + command);
  told_ = std::move(diagnostics);
}

// The place of a line of the translation, whose text is kept beside the sources.
SourceRange VerifyReport::targetRange(std::uint32_t line) {
  SourceMap& sources = runner_.session().sources();
  if (!translationFile_)
    translationFile_ =
        sources.add(SourceFile(plan_.translation->name, plan_.translation->text, Encoding::Utf8));
  const SourceFile& file = sources.file(*translationFile_);
  const std::uint32_t begin = file.lineStart(line);
  return {*translationFile_, begin, begin + static_cast<std::uint32_t>(file.line(line).size())};
}

// Where a line of the translation stems from, as far as it is in a file of the source.
SourceRange VerifyReport::sourceOfLine(std::uint32_t line) const {
  if (!plan_.translation || line == 0 || line > plan_.translation->sources.size()) return {};
  const auto& places = plan_.translation->sources[line - 1];
  if (!places || places->empty()) return {};
  const auto& [name, number] = *places->begin();
  const SourceMap& sources = runner_.session().sources();
  for (FileId id = 0; id < sources.size(); ++id) {
    const SourceFile& file = sources.file(id);
    if (file.name() != name || number > file.lineCount()) continue;
    return lineRange(sources, id, number);
  }
  return {};
}

// The command that makes the document, as far as others get the same report with it.
std::string VerifyReport::wholeCommand() const {
  std::string out = command();
  if (options_.byConvert) out.replace(out.find("verify"), 6, "convert --verify --report REPORT");
  const auto pairs = [&](std::string_view flag, const project::NamedTexts& given) {
    for (const auto& [name, text] : given)
      addFlag(out, flag, name + "=" + text);
  };
  pairs("--set", options_.common.set);
  pairs("--host", options_.common.host);
  pairs("--var", options_.variables);
  if (options_.byConvert) return out;
  const VerifyOptions usual;
  if (options_.cases != usual.cases) addFlag(out, "--cases", std::to_string(options_.cases));
  if (options_.seed != usual.seed) addFlag(out, "--seed", std::to_string(options_.seed));
  if (options_.minAgreed != usual.minAgreed) addFlag(out, "--min-agreed", numberText(options_.minAgreed));
  if (options_.tolerance != usual.tolerance) addFlag(out, "--tolerance", numberText(options_.tolerance));
  return out;
}

void VerifyReport::tellIdle(const Idle& idle) {
  Diagnostic& finding = idle.edge
                            ? told_.report<diag::VerifyEdgeIdle>(idle.at, idle.count, edges_.all(), idle.why)
                            : told_.report<diag::VerifyIdle>(idle.at, idle.count, cases_.all(), idle.why);
  if (idle.rejected > 0)
    finding.note(
        {}, fmt::format("this check rejected {} draws; {} fixes what it reads", idle.rejected, idle.remedy));
  const std::string command = replay(idle.drawn);
  finding.note({}, "the first: " + command);
  document_.undecided.push_back({idle.edge, idle.count, idle.why, excerptOf(idle.at), idle.rejected,
                                 idle.rejected > 0 ? idle.remedy : "", command});
}

void VerifyReport::tellReplaced() {
  std::vector<const Idle*> all;
  for (const auto& [key, one] : replaced_)
    all.push_back(&one);
  std::sort(all.begin(), all.end(), [](const Idle* a, const Idle* b) {
    return std::tuple(b->count, a->first) < std::tuple(a->count, b->first);
  });
  constexpr std::size_t kMost = 5;
  for (std::size_t i = 0; i < std::min(all.size(), kMost); ++i) {
    const Idle& one = *all[i];
    told_.report<diag::VerifyReplaced>(one.at, one.count, cases_.all(), one.why)
        .note({}, "the first: " + replay(one.drawn));
  }
}

void VerifyReport::tellUnstated() {
  for (const auto& [place, one] : unstated_)
    told_.report<diag::VerifyUnstated>(one.first, one.second);
  for (const auto& [place, one] : absent_)
    told_.report<diag::VerifySubprogramAbsent>(one.first, one.second);
}

void VerifyReport::tellAlarms() {
  if (options_.replay || cases_.agree == 0) return;
  for (const SourceRange& alarm : runner_.alarms())
    printed_.try_emplace({alarm.file, alarm.begin}, alarm);
  for (const auto& [place, alarm] : printed_)
    if (!alarms_.contains(place)) told_.report<diag::VerifyAlarmNotMet>(alarm);
  for (const SourceRange& one : runner_.unreached(reached_))
    told_.report<diag::VerifyNotReached>(one);
}

void VerifyReport::tellProbe() {
  for (const auto& [place, what] : unprotected_)
    told_.report<diag::UnprotectedMove>(what.first,
                                        what.second ? " and before the spindle is told to stop" : "");
  if (unarmed_) told_.report<diag::ProbeNeverOn>(*unarmed_);
}

// Fields whose value may be finer than what their pictures print.
void VerifyReport::tellPictures() {
  if (!agreeing_ || options_.replay) return;
  auto dropped = runner_.droppedDigits(agreeing_->second);
  std::stable_sort(dropped.begin(), dropped.end(), [](const auto& a, const auto& b) {
    return std::tie(a.second.file, a.second.begin) < std::tie(b.second.file, b.second.begin);
  });
  std::string names;
  std::set<std::string> named;
  for (const auto& [name, range] : dropped)
    if (named.insert(name).second) names += (names.empty() ? "" : ", ") + name;
  if (!dropped.empty()) told_.report<diag::PictureDropsDigits>(dropped.front().second, names);
}

// The verdict, of drawn and of edge cases how many it is said of, and what the others come to. It agrees
// where the exit status is 0 and something was compared.
std::string VerifyReport::verdict() {
  // At edges both sides may also stop alike, or the translation before anything moves.
  const std::uint64_t edgesAlike = edges_.agree + edges_.undecided;
  const std::uint64_t undecided = cases_.undecided + cases_.refused + cases_.none;
  enum class Word : std::uint8_t { Agrees, Differs, Undecided };
  const Word word = cases_.differ + edges_.differ > 0        ? Word::Differs
                    : cases_.agree > 0 && !told_.hasErrors() ? Word::Agrees
                                                             : Word::Undecided;
  const auto part = [&](std::uint64_t agree, std::uint64_t differ, std::uint64_t open, std::uint64_t all,
                        std::string_view what) {
    const std::uint64_t said = word == Word::Agrees ? agree : word == Word::Differs ? differ : open;
    std::string out = fmt::format("{} of {}{}", said, all, what);
    if (word != Word::Agrees && agree > 0) out += fmt::format(", {} agree", agree);
    if (word != Word::Differs && differ > 0) out += fmt::format(", {} differ", differ);
    if (word != Word::Undecided && open > 0) out += fmt::format(", {} undecided", open);
    return out;
  };
  constexpr std::string_view kWords[] = {"AGREES", "DIFFERS", "UNDECIDED"};
  // What keeps them from the verdict is reported above it: a line that was edited.
  const bool allAgree = word == Word::Undecided && undecided == 0 && cases_.agree > 0;
  const std::string cases = part(cases_.agree, cases_.differ, undecided, cases_.all(), " drawn cases");
  std::string out =
      fmt::format("{}: {}", kWords[static_cast<std::size_t>(word)],
                  allAgree ? fmt::format("{} agree of {} drawn cases", cases_.agree, cases_.all()) : cases);
  if (edges_.all() > 0) {
    const std::uint64_t said = word == Word::Differs ? edges_.differ : edges_.none;
    const std::string edges = part(edgesAlike, edges_.differ, edges_.none, edges_.all(), "");
    // "0 of 10, 10 agree" would be read as none of them agreeing.
    const std::size_t comma = edges.find(", ");
    out += "; edge cases: " + (word != Word::Agrees && said == 0 && comma != std::string::npos
                                   ? fmt::format("{} of {}", edges.substr(comma + 2), edges_.all())
                                   : edges);
  }
  if (edges_.refused > 0) out += fmt::format(", {} refused", edges_.refused);
  document_.verdict = kWords[static_cast<std::size_t>(word)];
  document_.summary = out;
  document_.cases = {cases_.all(), cases_.agree, cases_.differ, undecided, 0};
  document_.edges = {edges_.all(), edgesAlike, edges_.differ, edges_.none, edges_.refused};
  return out + '\n';
}

void VerifyReport::tellMachine() {
  if (!plan_.machine) return;
  const auto& travel = plan_.machine->limits.travel;
  if (std::any_of(std::begin(travel), std::end(travel), [](const auto& span) { return span.has_value(); }))
    told_.report<diag::VerifyMachineIgnored>({}, "the travel", "the zeros of the work systems are drawn");
  if (plan_.machine->probe.noise > 0)
    told_.report<diag::VerifyMachineIgnored>({}, "the noise", "both sides get exact contacts");
}

std::string VerifyReport::finish() {
  Session& session = runner_.session();
  const bool stated = options_.source.prog || plan_.programs || plan_.cycleFile;
  if (!stated) told_.report<diag::MeasurementNotStated>(runner_.place(), cases_.undecided, cases_.all());
  if (partsMade_) told_.report<diag::PartNotUsed>({});
  tellMachine();
  tellProbe();
  if (options_.source.prog) tellPictures();
  std::size_t told = 0;
  for (const auto& [key, group] : groups_) {
    if (told++ == kMostTold) break;
    tellDifference(group, (group.edge ? edges_ : cases_).all());
  }
  // The most frequent reasons alone; a probe that is off has been reported.
  std::vector<const Idle*> reasons;
  for (const auto& [key, idle] : idle_)
    if (idle.edge || !unarmed_ || idle.at != *unarmed_) reasons.push_back(&idle);
  std::sort(reasons.begin(), reasons.end(), [](const Idle* a, const Idle* b) {
    return std::tuple(a->edge, b->count, a->first) < std::tuple(b->edge, a->count, b->first);
  });
  constexpr std::size_t kMostReasons = 5;
  for (std::size_t i = 0; i < std::min(reasons.size(), kMostReasons); ++i)
    if (stated) tellIdle(*reasons[i]);
  tellReplaced();
  tellUnstated();
  tellAlarms();
  tellEdits();
  const std::uint64_t all = cases_.all();
  if (stated && static_cast<double>(cases_.agree) < options_.minAgreed / 100 * static_cast<double>(all))
    told_.report<diag::VerifyTooFew>({}, cases_.agree, all, numberText(options_.minAgreed));
  std::string out = verdict();
  if (options_.format != ReportFormat::Text) {
    addNotes();
    describe();
    addPicture();
  }
  session.diagnostics() = std::move(told_);
  return out;
}

} // namespace dotek::targets
