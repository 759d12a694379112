#include "backends/fusion/Run.h"

#include "backends/fusion/KernelText.h"
#include "backends/fusion/Script.h"

#include <cstdlib>
#include <duktape.h>
#include <memory>

namespace dotek::backends::fusion {

namespace {

struct HeapDeleter {
  void operator()(duk_context* heap) const { duk_destroy_heap(heap); }
};

// Duktape leaves by longjmp past C++ frames where a call is not protected: only protected ones are used, and
// no callback of ours is registered.
class Engine {
public:
  Engine() : heap_(duk_create_heap_default()) {}

  // "" or the message of what was thrown. The value stays on the stack where nothing was.
  std::string run(std::string_view code) {
    if (heap_ == nullptr) return "no memory for the script engine";
    if (duk_peval_lstring(heap_.get(), code.data(), code.size()) == 0) return "";
    const std::string message = duk_safe_to_string(heap_.get(), -1);
    duk_pop(heap_.get());
    return message.empty() ? "an exception" : message;
  }

  // Reads a program, which stays at the bottom of the stack for repeat(). "" or what is wrong with it.
  std::string keep(std::string_view code) {
    if (heap_ == nullptr) return "no memory for the script engine";
    if (duk_pcompile_lstring(heap_.get(), 0, code.data(), code.size()) == 0) return "";
    const std::string message = duk_safe_to_string(heap_.get(), -1);
    duk_pop(heap_.get());
    return message.empty() ? "a syntax error" : message;
  }
  // Runs what was kept as the `index`-th.
  std::string repeat(int index) {
    duk_dup(heap_.get(), index);
    const bool good = duk_pcall(heap_.get(), 0) == 0;
    const std::string message = good ? "" : duk_safe_to_string(heap_.get(), -1);
    duk_pop(heap_.get());
    return good || !message.empty() ? message : "an exception";
  }
  void pop() { duk_pop(heap_.get()); }

  // Of the object on top of the stack.
  std::string text(const char* member) {
    duk_get_prop_string(heap_.get(), -1, member);
    std::string out = duk_safe_to_string(heap_.get(), -1);
    duk_pop(heap_.get());
    return out;
  }
  std::string top() { return duk_safe_to_string(heap_.get(), -1); }

private:
  std::unique_ptr<duk_context, HeapDeleter> heap_;
};

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

std::string object(const std::map<std::string, double>& members) {
  std::string out = "{";
  for (const auto& [name, value] : members)
    out += (out.size() > 1 ? ", " : "") + quoted(name) + ": " + numberLiteral(value);
  return out + "}";
}

std::string callText(std::string_view prefix, bool whole, const RunInput& input) {
  std::string points;
  for (const auto& point : input.points)
    points += (points.empty() ? "" : ", ") + ("[" + numberLiteral(point[0]) + ", " + numberLiteral(point[1]) +
                                              ", " + numberLiteral(point[2]) + "]");
  std::string values = object(input.properties);
  values.pop_back();
  values += std::string(input.properties.empty() ? "" : ", ") + "dotekCycle: " + quoted(prefix) + "}";
  return std::string("dotekRun({unit: ") + (input.inch ? "IN" : "MM") + ", properties: " + values +
         ", points: [" + points + "], tool: {diameter: " + numberLiteral(input.toolDiameter) +
         ", number: " + numberLiteral(input.toolNumber) +
         ", lengthOffset: " + numberLiteral(input.toolLengthOffset) + "}, cycle: " + object(input.cycle) +
         (whole ? "" : ", entry: " + quoted(std::string(prefix) + "_write")) + "})";
}

std::string postText(std::string_view fragment, std::string_view prefix) {
  std::string out;
  std::vector<EmittedLine> lines;
  for (std::string& line : linesOf(std::string(fragment)))
    lines.push_back({std::move(line), {}, ""});
  for (const EmittedLine& line : postAround({lines}, {std::string(prefix)}))
    out += line.text + "\n";
  return out;
}

// What the call left on the stack.
void take(Engine& engine, RunResult& out) {
  out.text = engine.text("text");
  out.errors = linesOf(engine.text("errors"));
  out.warnings = linesOf(engine.text("warnings"));
  out.wroteAfterError = engine.text("afterError") == "true";
  out.failure = engine.text("failure");
}

RunResult run(std::string_view post, const std::string& call) {
  RunResult out;
  Engine engine;
  for (const std::string_view part : {kernelText(), post, std::string_view(call)}) {
    out.failure = engine.run(part);
    if (!out.failure.empty()) return out;
  }
  take(engine, out);
  return out;
}

} // namespace

// The kernel and the post, one after the other, as the engine keeps them.
class Fragment::Prepared {
public:
  Prepared(std::string_view fragment, std::string_view prefix) {
    failure = engine.keep(kernelText());
    if (failure.empty()) failure = engine.keep(postText(fragment, prefix));
  }
  Engine engine;
  std::string failure;
};

Fragment::Fragment(std::string_view fragment, std::string_view prefix)
    : prefix_(prefix), prepared_(std::make_unique<Prepared>(fragment, prefix)) {}

Fragment::~Fragment() = default;

RunResult Fragment::run(const RunInput& input) const {
  RunResult out;
  Engine& engine = prepared_->engine;
  out.failure = prepared_->failure;
  for (const int part : {0, 1})
    if (out.failure.empty()) out.failure = engine.repeat(part);
  if (out.failure.empty()) out.failure = engine.run(callText(prefix_, false, input));
  if (!out.failure.empty()) return out;
  take(engine, out);
  engine.pop();
  return out;
}

RunResult runFragment(std::string_view fragment, std::string_view prefix, const RunInput& input) {
  return run(postText(fragment, prefix), callText(prefix, false, input));
}

RunResult runPost(std::string_view post, std::string_view prefix, const RunInput& input) {
  return run(post, callText(prefix, true, input));
}

std::string scriptFor(std::string_view fragment, std::string_view prefix, const RunInput& input) {
  return std::string(kernelText()) + postText(fragment, prefix) + "console.log(" +
         callText(prefix, false, input) + ".text);\n";
}

std::string evaluate(std::string_view code) {
  Engine engine;
  std::string failure = engine.run(kernelText());
  if (failure.empty()) failure = engine.run(code);
  return failure.empty() ? engine.top() : "throws: " + failure;
}

} // namespace dotek::backends::fusion
