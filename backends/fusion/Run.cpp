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

RunResult run(std::string_view post, const std::string& call) {
  RunResult out;
  Engine engine;
  for (const std::string_view part : {kernelText(), post, std::string_view(call)}) {
    out.failure = engine.run(part);
    if (!out.failure.empty()) return out;
  }
  out.text = engine.text("text");
  out.errors = linesOf(engine.text("errors"));
  out.warnings = linesOf(engine.text("warnings"));
  out.wroteAfterError = engine.text("afterError") == "true";
  out.failure = engine.text("failure");
  return out;
}

} // namespace

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
