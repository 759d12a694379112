#include "driver/Command.h"
#include "driver/Driver.h"
#include "frontend/compost/Parse.h"
#include "frontend/cycle/Parse.h"
#include "frontend/fusion/Lower.h"
#include "frontend/fusion/Parse.h"
#include "frontend/gibbs/Run.h"
#include "frontend/macrob/Parse.h"
#include "frontend/mikroprog/Lower.h"
#include "frontend/mikroprog/Parse.h"
#include "ir/Fold.h"
#include "ir/Print.h"
#include "project/Compilation.h"
#include "project/CycleChecks.h"
#include "project/CycleFiles.h"
#include "project/CycleLowering.h"
#include "project/CycleValues.h"
#include "project/Fields.h"
#include "project/Hosts.h"
#include "project/Inputs.h"
#include "project/PostShape.h"
#include "project/Prog.h"
#include "project/Programs.h"
#include "support/Decimal.h"
#include "support/Files.h"
#include "support/NearestName.h"
#include "support/Printable.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"
#include "support/messages/Posts.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace dotek::driver {

namespace fs = std::filesystem;
namespace gibbs = frontend::gibbs;
namespace compost = frontend::compost;
namespace macrob = frontend::macrob;

namespace {

class DumpCommand {
public:
  DumpCommand(const DumpOptions& options, Session& session)
      : options_(options), session_(session), compilation_(session) {}

  Outcome run() {
    if (options_.inputs.empty())
      session_.diagnostics().report<diag::MissingOption>({}, "dump", "INPUT",
                                                         "a file or the folder of a cycle");
    if (options_.stage == Stage::Ir) {
      ir();
      keepStrongest(session_.diagnostics());
      return outcomeOf(session_, std::move(out_));
    }
    for (const std::string& input : options_.inputs)
      one(input);
    if (options_.stage == Stage::Path) keepStrongest(session_.diagnostics());
    return outcomeOf(session_, std::move(out_), true);
  }

private:
  void one(const std::string& input) {
    std::error_code error;
    if (options_.stage == Stage::Path)
      path(input);
    else if (!fs::is_directory(input, error))
      file(input);
    else
      folder(input);
  }

  void folder(const std::string& input) {
    for (const char* name : {"DefineData.txt", "CycleData.dlg", "CycleData.mac", "ToolPath.mac"}) {
      const std::string path = cycleFile(input, name).value_or(fs::path(input) / name).generic_string();
      if (!refusesStream(path, {}, session_)) file(path);
    }
  }

  void file(const std::string& input) {
    const Recognition* const found = session_.kindOf(input, session_.diagnostics());
    if (found == nullptr) return;
    if (isPost(*found)) {
      if (const auto id = session_.read(input, Encoding::Cp1250)) out_ += postText(*id);
      return;
    }
    const std::optional<InputKind> kind = found->kind;
    if (!kind) {
      reportNoInput(input, *found, session_);
      return;
    }
    const std::optional<FileId> id =
        session_.read(input, *kind == InputKind::Suf ? Encoding::Cp852 : Encoding::Cp1250);
    if (!id) return;
    if (*kind == InputKind::Suf) {
      const auto program =
          frontend::mikroprog::parse(*id, session_.sources(), session_.diagnostics(), session_.limits());
      out_ += options_.stage == Stage::Tokens ? frontend::mikroprog::dumpTokens(program, session_.sources())
                                              : frontend::mikroprog::dumpAst(program, session_.sources());
      return;
    }
    if (*kind == InputKind::Cycle) {
      out_ +=
          options_.stage == Stage::Tokens
              ? frontend::cycle::dumpTokens(*id, session_.sources(), session_.limits(),
                                            session_.diagnostics())
              : frontend::cycle::dumpAst(frontend::cycle::parse(*id, session_.sources(), session_.limits(),
                                                                session_.diagnostics()),
                                         session_.sources());
      return;
    }
    const gibbs::ParseContext context{session_.sources(), session_.gibbsKeywords(), session_.limits(),
                                      session_.diagnostics()};
    if (options_.stage == Stage::Tokens) {
      if (*kind == InputKind::Nc) {
        out_ += macrob::dumpTokens(*id, session_.sources(), session_.limits(), session_.diagnostics(),
                                   textOf(*id, session_));
        return;
      }
      out_ += *kind == InputKind::Prog
                  ? compost::dumpTokens(*id, session_.sources(), session_.limits(), session_.diagnostics())
                  : gibbs::dumpTokens(*id, context);
      return;
    }
    switch (*kind) {
    case InputKind::Nc:
      out_ += macrob::dumpAst(macrob::parse(*id, session_.sources(), session_.limits(),
                                            session_.diagnostics(), textOf(*id, session_)),
                              session_.sources());
      break;
    case InputKind::Prog:
      out_ +=
          compost::dumpAst(compost::parse(*id, session_.sources(), session_.limits(), session_.diagnostics()),
                           session_.sources());
      break;
    case InputKind::Macro: out_ += gibbs::dumpAst(gibbs::parseMacro(*id, context), session_.sources()); break;
    case InputKind::Dialog:
      out_ += gibbs::dumpAst(gibbs::parseDialog(*id, context), session_.sources());
      break;
    case InputKind::Cycle:
    case InputKind::Suf: break; // above
    case InputKind::DefineData:
      out_ += gibbs::dumpAst(gibbs::parseDefineData(*id, context), session_.sources());
      break;
    }
  }

  // What the engine reads of a post: ES5, line for line.
  std::string postText(FileId id) {
    namespace fusion = frontend::fusion;
    const fusion::Tree tree = fusion::parse(id, session_.sources());
    for (const fusion::Unread& one : tree.unread)
      session_.diagnostics().report<diag::PostUnread>(one.range, one.message);
    if (!tree.unread.empty()) return "";
    fusion::Lowered lowered = fusion::lower(tree, fusion::resolve(tree));
    for (const fusion::Unread& one : lowered.refused)
      session_.diagnostics().report<diag::PostConstruct>(one.range, one.message);
    return toUtf8(lowered.text, session_.sources().file(id).encoding());
  }

  // What convert works on: fixed values are folded in.
  void ir() {
    std::vector<std::string> rest;
    for (const std::string& input : options_.inputs)
      if (!mikroprogIr(input) && !cycleIr(input)) rest.push_back(input);
    if (rest.empty() && !options_.inputs.empty()) return;
    const LoweringInputs* inputs = compilation_.load(
        options_.source, options_.control.empty() ? std::string(kDefaultControl) : options_.control);
    if (inputs == nullptr || session_.diagnostics().hasErrors()) return;
    ir::Module module;
    for (const std::string& input : rest) {
      if (isProgramFile(input, session_)) {
        if (session_.diagnostics().hasErrors()) return;
        programs(input, *inputs->control);
        continue;
      }
      CycleFolder& folder = compilation_.addFolder(input);
      if (options_.source.cycle && options_.inputs.size() == 1) folder.name = *options_.source.cycle;
      leaveFindingsToLint(session_);
      if (session_.diagnostics().hasErrors()) return;
      std::optional<LoweredCycle> lowered = compilation_.lower(folder);
      if (!lowered) return;
      if (!lowered->fixed.empty()) ir::fold(lowered->cycle, lowered->fixed);
      module.cycles.push_back(std::move(lowered->cycle));
    }
    if (!module.cycles.empty()) out_ += ir::print(module, &session_.sources());
  }

  // false: it is no program of Mikroprog. These need no control: what a code does is not part of the IR.
  bool mikroprogIr(const std::string& input) {
    std::error_code error;
    if (fs::is_directory(input, error)) return false;
    Diagnostics ignored; // the other readers report
    const Recognition* const found = session_.kindOf(input, ignored, InputKind::Nc);
    if (found == nullptr || found->kind != InputKind::Suf) return false;
    const std::optional<FileId> id = session_.read(input, Encoding::Cp852);
    if (!id) return true;
    const auto program =
        frontend::mikroprog::parse(*id, session_.sources(), session_.diagnostics(), session_.limits());
    if (const auto file = frontend::mikroprog::lower(program, session_.sources()))
      out_ += ir::print(*file, &session_.sources());
    return true;
  }

  // Puts in the values of --set and --host.
  // `file`: of a cycle of the language, whose values may be literals; nullptr: it is none.
  void fix(ir::Cycle& cycle, const std::string* file = nullptr) {
    const std::map<std::string, double> hosts = parseHosts(options_.common.host, session_.diagnostics());
    std::map<ir::VariableId, double> fixed;
    std::set<std::string> names;
    for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
      const ir::Variable& variable = cycle.variable(id);
      const auto host = hosts.find(variable.name);
      if (variable.role == ir::Role::Host && host != hosts.end()) fixed[id] = host->second;
      if (variable.role != ir::Role::Parameter) continue;
      names.insert(variable.name);
      const auto set = std::find_if(options_.common.set.begin(), options_.common.set.end(),
                                    [&](const auto& one) { return one.first == variable.name; });
      if (set == options_.common.set.end()) continue;
      if (const auto value = parseNumber(set->second))
        fixed[id] = *value;
      else if (file != nullptr)
        literal(*file, *set, id, fixed);
      else
        session_.diagnostics().report<diag::NotANumber>({}, "--set", set->first, set->second);
    }
    for (const auto& [name, text] : options_.common.set) {
      if (names.contains(name)) continue;
      const std::string near = nearestName(name, names);
      session_.diagnostics().report<diag::NoSuchField>({}, name, cycle.name,
                                                       near.empty() ? "" : "; did you mean `" + near + "`?");
    }
    if (!fixed.empty()) ir::fold(cycle, fixed);
  }

  void literal(const std::string& file, const std::pair<std::string, std::string>& given, ir::VariableId id,
               std::map<ir::VariableId, double>& fixed) {
    CycleFiles files(session_);
    const auto* const tree = files.linked(file);
    if (tree == nullptr) return;
    const auto values = cycleValues(*tree, {given}, session_.diagnostics());
    if (const auto value = values.find(given.first); value != values.end()) fixed[id] = value->second;
  }

  // false: it is no cycle of the cycle language.
  bool cycleIr(const std::string& input) {
    if (!isCycleFile(input, session_)) return false;
    std::optional<frontend::cycle::Lowered> lowered = lowerCycleFile(input, session_);
    if (!lowered) return true;
    ir::Module module;
    module.cycles.push_back(std::move(lowered->cycle));
    fix(module.cycles.front(), &input);
    out_ += ir::print(module, &session_.sources());
    return true;
  }

  void programs(const std::string& input, const stdlib::Control& control) {
    const std::optional<FileId> id = session_.read(input, Encoding::Cp1250);
    if (!id) return;
    const std::optional<ir::ProgramFile> file = loadPrograms(*id, control, session_);
    if (file) out_ += ir::print(*file, &session_.sources());
  }

  // What CycleData.mac computes beside its dialog is what the path is drawn with.
  void takeComputed(const CycleFolder& folder, FieldTable& fields,
                    const std::map<std::string, double>& hosts) {
    if (!folder.cycle->cycleData) return;
    const std::map<std::string, double> given = fields.macroValues();
    Diagnostics unsaid; // of values that the dialog rejects; `lint` and `post` say it
    gibbs::RunContext context{
        session_.sources(),
        session_.gibbsKeywords(),
        session_.limits(),
        unsaid,
        given,
        hosts,
        options_.common.assume,
        [&](const std::string& name, SourceRange where) { return folder.loader->macro(name, where); },
        [&](const std::string& name, SourceRange where) { return folder.loader->dialog(name, where); }};
    std::map<std::string, double> values = given;
    project::takeComputed(gibbs::runChecks(*folder.cycle->cycleData, context), folder, session_, values);
    for (const auto& [name, value] : values) {
      const auto was = given.find(name);
      if (was != given.end() && was->second == value) continue;
      session_.diagnostics().report<diag::FieldComputed>(
          {folder.cycle->cycleData->file, 0, 0}, name, numberText(value),
          was == given.end() ? "nothing" : numberText(was->second));
      fields.change(name, value);
    }
  }

  // The moves that ToolPath.mac writes for the given values: a dry run outside the CAM.
  void path(const std::string& input) {
    const CycleFolder& folder = compilation_.addFolder(input);
    if (!folder.complete || session_.diagnostics().hasErrors()) return;
    FieldTable fields(folder, {}, session_);
    for (const auto& [name, text] : options_.common.set) {
      const std::optional<double> value = parseNumber(text);
      if (!value) {
        session_.diagnostics().report<diag::NotANumber>({}, "--set", name, text);
      } else if (!fields.set(name, *value, {})) {
        session_.diagnostics().report<diag::NoSuchField>({}, name, folder.name, fields.hint(name));
      }
    }
    const std::map<std::string, double> hosts = parseHosts(options_.common.host, session_.diagnostics());
    if (session_.diagnostics().hasErrors()) return;
    takeComputed(folder, fields, hosts);
    gibbs::RunContext context{
        session_.sources(),
        session_.gibbsKeywords(),
        session_.limits(),
        session_.diagnostics(),
        fields.macroValues(),
        hosts,
        options_.common.assume,
        [&](const std::string& name, SourceRange where) { return folder.loader->macro(name, where); },
        [&](const std::string& name, SourceRange where) { return folder.loader->dialog(name, where); }};
    if (session_.diagnostics().hasErrors()) return;
    if (const auto moves = gibbs::runToolPath(*folder.cycle->toolPath, context))
      out_ += gibbs::pathText(*moves);
  }

  const DumpOptions& options_;
  Session& session_;
  Compilation compilation_;
  std::string out_;
};

} // namespace

Outcome dump(const DumpOptions& options) {
  Outcome outcome = guarded(options.common, options.inputs,
                            [&](Session& session) { return DumpCommand(options, session).run(); });
  // It is read by people: what is in the texts of the inputs steers no terminal.
  outcome.output = printableLines(outcome.output);
  return outcome;
}

} // namespace dotek::driver
