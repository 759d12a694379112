#include "posts/CncJob.h"

#include "posts/CncCycle.h"
#include "posts/CncNames.h"
#include "posts/CncTool.h"
#include "posts/JobJson.h"
#include "support/messages/Posts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace dotek::posts {

using namespace cnc;

namespace {

// Records that follow a tool by name, and parameters before it.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kToolTexts = {
    {{"tool-description", "description"},
     {"tool-comment", "comment"},
     {"tool-vendor", "vendor"},
     {"tool-product-id", "productId"},
     {"tool-holder-description", "holderDescription"},
     {"tool-holder-comment", "holderComment"},
     {"tool-holder-vendor", "holderVendor"},
     {"tool-holder-product-id", "holderProductId"}}};
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kToolFlags = {
    {{"operation:tool_manualToolChange", "manualToolChange"},
     {"operation:tool_breakControl", "breakControl"}}};

class Builder {
public:
  Builder(const File& file, const HoleCycles& holes) : file_(file), holes_(holes) {}

  // Throws Fault.
  void build(JsonObject& job) {
    for (const Record& record : file_.records) {
      record_ = &record;
      take(record);
    }
    if (inSection_) fail("the file ends within an operation");
    flushManual();
    job.add("parameters", objectOf(globals_));
    if (stock_) job.add("workpiece", jsonList({numbers(stock_->lower), numbers(stock_->upper)}));
    job.add("sections", jsonList(sections_));
    job.add("after", jsonList(before_));
    job.add("exact", "true");
  }

private:
  [[noreturn]] void fail(std::string text) const { throw Fault{record_->offset, std::move(text)}; }

  void take(const Record& record) {
    if (const auto* named = std::get_if<Named>(&record.value))
      parameter(*named);
    else if (cycle_ && record.code != Code::Linear && record.code != Code::CycleEnd)
      fail("a cycle holds something that is neither a value nor a point");
    else
      other(record);
  }

  void other(const Record& record) {
    switch (record.code) {
    case Code::Stock:
      if (!stock_) stock_ = std::get<Box>(record.value);
      break;
    case Code::AdditiveContext:
    case Code::Extrusion: fail("jobs of additive manufacturing are not run");
    case Code::Context: context_ = &file_.contexts[std::get<std::size_t>(record.value)]; break;
    case Code::ShortTool:
    case Code::Tool:
    case Code::TurningTool:
    case Code::JetTool: tool_ = &file_.tools[std::get<std::size_t>(record.value)]; break;
    case Code::Section: begin(); break;
    case Code::SectionEnd: end(); break;
    case Code::Linear:
      if (cycle_) {
        cycle_->add(std::get<Move>(record.value));
        break;
      }
      [[fallthrough]];
    case Code::Rapid:
    case Code::ArcClockwise:
    case Code::ArcCounterclockwise:
    case Code::Rapid5:
    case Code::Linear5: move(record.code, std::get<Move>(record.value)); break;
    case Code::Cycle:
      if (!inSection_) fail("a cycle lies outside of the operations");
      cycle_.emplace(std::get<std::string>(record.value), holes_);
      break;
    case Code::CycleEnd: endCycle(); break;
    case Code::Command: command(std::get<std::uint32_t>(record.value)); break;
    case Code::Comment: texts("comment", "COMMAND_COMMENT", std::get<std::string>(record.value)); break;
    case Code::PassThrough:
      texts("passthrough", "COMMAND_PASS_THROUGH", std::get<std::string>(record.value));
      break;
    case Code::Dwell: add(step("dwell", "seconds", jsonNumber(std::get<double>(record.value)))); break;
    case Code::SpindleSpeed: add(step("spindle", "rpm", jsonNumber(std::get<double>(record.value)))); break;
    default: break; // frames, and what has no counterpart
    }
  }

  void add(std::string step) { (inSection_ ? records_ : before_).push_back(std::move(step)); }

  void parameter(const Named& named) {
    const std::string& name = named.name;
    if (name == "kind") return; // what a length is; the engine hands on neither it nor the mark
    if (name == "marker") {
      if (!inSection_) flushManual();
      return;
    }
    if (cycle_) {
      if (cycle_->hasPoints()) fail("a cycle has a value after its first point");
      cycle_->add(named);
      return;
    }
    if (std::holds_alternative<Double3>(named.value)) fail("a value with a place lies outside of a cycle");
    if (inSection_)
      add(parameterStep(name, jsonOf(named)));
    else if (tool_ != nullptr && name.starts_with("tool-"))
      toolTexts_.set(name, jsonOf(named));
    else {
      pending_.set(name, jsonOf(named));
      if (name == "operation:tool_type")
        if (const auto* text = std::get_if<std::string>(&named.value)) toolTypeText_ = *text;
    }
  }

  // Between two marks without an operation lie the parameters of the job, or manual NC.
  void flushManual() {
    if (context_ != nullptr || tool_ != nullptr) return;
    if (!marked_)
      for (const auto& [name, json] : pending_.all())
        globals_.set(name, json);
    else
      for (const auto& [name, json] : pending_.all())
        before_.push_back(parameterStep(name, json));
    marked_ = true;
    pending_.clear();
  }

  void begin() {
    if (inSection_) fail("an operation begins within another");
    if (context_ == nullptr || tool_ == nullptr) fail("an operation begins without its tool or its place");
    inSection_ = true;
    fiveAxes_ = false;
    movement_ = 0;
    compensation_ = 0;
    at_.reset();
    records_.clear();
  }

  void end() {
    if (!inSection_) fail("an operation ends that did not begin");
    sections_.push_back(section());
    inSection_ = false;
    context_ = nullptr;
    tool_ = nullptr;
    marked_ = true;
    toolTypeText_.clear();
    pending_.clear();
    toolTexts_.clear();
    before_.clear();
  }

  void before(const Move& move) {
    if (!inSection_) fail("a move lies outside of the operations");
    if (move.movement != movement_) {
      const std::string_view name = movementName(move.movement);
      if (name.empty()) fail(fmt::format("movement {} is not known to Dotek", move.movement));
      movement_ = move.movement;
      add(step("movement", "movement", jsonText(name)));
    }
    const unsigned compensation = move.flags & (kCompensationLeft | kCompensationRight);
    if (compensation != compensation_) {
      compensation_ = compensation;
      add(step("compensation", "side",
               jsonText(compensation == 0                   ? "off"
                        : compensation == kCompensationLeft ? "left"
                                                            : "right")));
    }
  }

  void move(Code code, const Move& move) {
    before(move);
    JsonObject out;
    const bool five = code == Code::Rapid5 || code == Code::Linear5;
    const bool arc = code == Code::ArcClockwise || code == Code::ArcCounterclockwise;
    out.add("record", jsonText(arc                     ? "circular"
                               : code == Code::Rapid   ? "rapid"
                               : code == Code::Rapid5  ? "rapid5"
                               : code == Code::Linear5 ? "linear5"
                                                       : "linear"));
    out.add("to", numbers(move.to));
    if (arc) {
      out.add("center", numbers(move.center));
      out.add("clockwise", code == Code::ArcClockwise ? "true" : "false");
      out.add("full", at_ && *at_ == move.to ? "true" : "false");
      out.add("normal", numbers(move.normal));
    }
    if (five) {
      fiveAxes_ = true;
      out.add("axis", numbers(move.axis));
    }
    if (code != Code::Rapid && code != Code::Rapid5)
      out.add("feed", jsonNumber(static_cast<double>(move.feed)));
    at_ = move.to;
    add(out.text());
  }

  void endCycle() {
    if (!cycle_) fail("a cycle ends that did not begin");
    CycleOfJob cycle = std::move(*cycle_);
    cycle_.reset();
    if (!cycle.hasPoints()) fail("a cycle has no points");
    try {
      for (std::string& one : cycle.parameters())
        add(std::move(one));
    } catch (const std::string& unknown) {
      fail(unknown);
    }
    before(cycle.points().front());
    movement_ = cycle.points().back().movement;
    at_.reset();
    add(cycle.record());
  }

  void command(std::uint32_t number) {
    const std::string_view name = commandName(number);
    if (name.empty()) fail(fmt::format("command {} is not known to Dotek", number));
    if (name == "COMMAND_POWER_ON" || name == "COMMAND_POWER_OFF")
      add(step("power", "on", name == "COMMAND_POWER_ON" ? "true" : "false"));
    add(step(inSection_ ? "command" : "manual", "command", jsonText(name)));
  }

  void texts(std::string_view record, std::string_view command, const std::string& text) {
    if (inSection_) {
      add(step(record, "text", jsonText(text)));
      return;
    }
    JsonObject out;
    out.add("record", jsonText("manual"));
    out.add("command", jsonText(command));
    out.add("value", jsonText(text));
    add(out.text());
  }

  std::string section() {
    JsonObject out;
    const Context& in = *context_;
    if (in.unit != 1)
      fail(fmt::format("unit {} of an operation is not known to Dotek; 1 is millimetres", in.unit));
    const std::string_view type = sectionTypeName(in.type);
    if (type.empty()) fail(fmt::format("type {} of an operation is not known to Dotek", in.type));
    if (const std::string* const strategy = pending_.find("operation-strategy"))
      out.add("strategy", *strategy);
    out.add("workOffset", std::to_string(in.workOffset));
    if (const std::string* const probes = pending_.find("probe-output-work-offset"))
      out.add("probeWorkOffset", *probes);
    out.add("type", jsonText(type));
    out.add("quality", std::to_string(in.quality));
    out.add("jetMode", std::to_string(in.jetMode));
    if (fiveAxes_) out.add("multiAxis", "true");
    if (isOne("operation:tool_isTurning") && isOne("operation:tool_useFeedPerRevolution"))
      fail("an operation with feed per revolution: whether its moves hold it is not known to Dotek");
    out.add("workPlane", planeOf(in));
    out.add("tool", tool());
    out.add("parameters", objectOf(pending_));
    out.add("before", jsonList(before_));
    out.add("records", jsonList(records_));
    return out.text();
  }

  bool isOne(std::string_view name) const {
    const std::string* const json = pending_.find(name);
    return json != nullptr && *json == "1";
  }

  // The work plane as the setup's coordinates have it.
  std::string planeOf(const Context& in) const {
    for (std::size_t i = 0; i < 3; ++i)
      if (std::abs(in.origin[i] - in.wcsOrigin[i]) > 1e-4f)
        fail(fmt::format(
            "the work plane has an origin of its own, ({}, {}, {}): how the engine turns its moves into "
            "those of the setup is not known",
            in.origin[0], in.origin[1], in.origin[2]));
    std::array<double, 9> out{1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (in.plane != in.wcsPlane)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
          out[i * 3 + k] = 0;
          for (std::size_t j = 0; j < 3; ++j)
            out[i * 3 + k] +=
                static_cast<double>(in.wcsPlane[j * 3 + i]) * static_cast<double>(in.plane[j * 3 + k]);
        }
    return numbers(out);
  }

  std::string tool() const {
    CncTool out{*tool_, toolTypeText_, {}};
    for (const auto& [name, member] : kToolTexts)
      if (const std::string* const text = toolTexts_.find(name)) out.members.emplace_back(member, *text);
    if (const std::string* const length = pending_.find("operation:tool_overallLength"))
      out.members.emplace_back("overallLength", *length);
    for (const auto& [name, member] : kToolFlags)
      if (const std::string* const flag = pending_.find(name))
        out.members.emplace_back(member, *flag == "1" ? "true" : "false");
    if (isOne("operation:tool_isTurning") && isOne("operation:tool_useConstantSurfaceSpeed"))
      out.members.emplace_back("spindleMode", jsonText("SPINDLE_CONSTANT_SURFACE_SPEED"));
    std::string fault;
    std::string json = out.json(fault);
    if (!fault.empty()) fail(fault);
    return json;
  }

  const File& file_;
  const HoleCycles& holes_;
  const Record* record_ = nullptr;
  const Context* context_ = nullptr;
  const Tool* tool_ = nullptr;
  std::optional<Box> stock_;
  Values globals_, pending_, toolTexts_;
  std::string toolTypeText_;
  std::vector<std::string> sections_, before_, records_;
  std::optional<CycleOfJob> cycle_;
  std::optional<Single3> at_;
  unsigned movement_ = 0, compensation_ = 0;
  bool inSection_ = false, fiveAxes_ = false, marked_ = false;
};

// Versions of the files that the layout was read off.
bool isKnownVersion(const std::array<std::uint8_t, 3>& version) {
  return version == std::array<std::uint8_t, 3>{1, 0, 0} ||
         (version[0] == 2 && (version[1] == 1 || version[1] == 3 || version[1] == 4) && version[2] == 0);
}

} // namespace

std::variant<std::string, Fault> cncJob(const File& file, const JobOptions& options,
                                        const HoleCycles& holes) {
  JsonObject job;
  addCommon(options, job);
  JsonObject properties;
  for (const auto& [name, value] : options.properties)
    properties.add(name, jsonOfArgument(value));
  job.add("properties", properties.text());
  try {
    Builder(file, holes).build(job);
  } catch (const Fault& fault) {
    return fault;
  }
  return job.text();
}

std::optional<PostJob> readCncJob(const std::string& path, std::string_view bytes, const JobOptions& options,
                                  project::Session& session) {
  Diagnostics& diagnostics = session.diagnostics();
  const auto read = cnc::read(bytes);
  if (const Fault* const fault = std::get_if<Fault>(&read)) {
    diagnostics.report<diag::CncUnread>({}, path, fault->offset, fault->text);
    return std::nullopt;
  }
  const File& file = std::get<File>(read);
  if (!isKnownVersion(file.version))
    diagnostics.report<diag::CncVersion>(
        {}, path, fmt::format("{}.{}.{}", file.version[0], file.version[1], file.version[2]));
  auto job = cncJob(file, options, holeCycles(session.data()));
  if (const Fault* const fault = std::get_if<Fault>(&job)) {
    diagnostics.report<diag::CncNotRun>({}, path, fault->offset, fault->text);
    return std::nullopt;
  }
  PostJob out;
  out.json = std::move(std::get<std::string>(job));
  return out;
}

} // namespace dotek::posts
