#include "script/Engine.h"

#include "script/Protocol.h"
#include "support/Printable.h"

#include <charconv>
#include <duktape.h>
#include <unistd.h>

namespace dotek::script {

namespace {

constexpr std::size_t kMostMessage = 300; // characters of what was thrown
constexpr duk_size_t kMostTexts = 100'000;

void* take(void* arena, duk_size_t size) {
  return static_cast<Arena*>(arena)->take(size);
}
void* resize(void* arena, void* piece, duk_size_t size) {
  return static_cast<Arena*>(arena)->resize(piece, size);
}
void give(void* arena, void* piece) {
  static_cast<Arena*>(arena)->give(piece);
}
void giveUp(void* /*arena*/, const char* /*message*/) {
  _exit(kEngineGaveUp);
}

// Steps that the engine may leave by longjmp: each runs in duk_safe_call, leaves one value, and keeps nothing
// that would have to be destroyed. What it works with lies on top of the stack.
struct Text {
  std::string_view name, text;
};

duk_ret_t evaluate(duk_context* heap, void* data) {
  const auto& source = *static_cast<const Text*>(data);
  duk_push_lstring(heap, source.text.data(), source.text.size());
  duk_push_lstring(heap, source.name.data(), source.name.size());
  duk_compile(heap, 0);
  duk_call(heap, 0);
  return 1;
}

Arena& arenaOf(duk_context* heap) {
  duk_memory_functions functions;
  duk_get_memory_functions(heap, &functions);
  return *static_cast<Arena*>(functions.udata);
}

// Called for each error that is made: a script may catch those of the engine's bounds, too.
duk_ret_t noteBound(duk_context* heap) {
  if (duk_is_error(heap, 0) != 0 && duk_get_prop_string(heap, 0, "message") != 0) {
    const char* const text = duk_get_string(heap, -1);
    const std::string_view message = text == nullptr ? "" : text;
    Arena& arena = arenaOf(heap);
    if (message == "alloc failed" && arena.ranOut()) arena.threw = "alloc failed";
    if (message == "callstack limit" || message == "C stack depth limit") arena.threw = "callstack limit";
  }
  duk_set_top(heap, 1);
  return 1;
}

duk_ret_t thrownBound(duk_context* heap) {
  const char* const threw = arenaOf(heap).threw;
  if (threw == nullptr) return 0;
  duk_push_string(heap, threw);
  return 1;
}

// No host of scripts has the engine's own object: its threads and finalizers. One may ask which bound was
// met.
duk_ret_t hideEngine(duk_context* heap, void* /*data*/) {
  duk_push_global_object(heap);
  duk_get_prop_string(heap, -1, "Duktape");
  duk_push_c_function(heap, noteBound, 1);
  duk_put_prop_string(heap, -2, "errCreate");
  duk_pop(heap);
  duk_push_c_function(heap, thrownBound, 0);
  duk_put_prop_string(heap, -2, "dotekBound");
  duk_del_prop_string(heap, -1, "Duktape");
  return 1;
}

// The function lies on top of the stack.
duk_ret_t callWith(duk_context* heap, void* data) {
  const auto& json = *static_cast<const std::string_view*>(data);
  duk_push_lstring(heap, json.data(), json.size());
  duk_json_decode(heap, -1);
  duk_call(heap, 1);
  return 1;
}

duk_ret_t lengthOf(duk_context* heap, void* /*data*/) {
  if (!duk_is_array(heap, -1)) return DUK_RET_TYPE_ERROR;
  duk_push_uint(heap, static_cast<duk_uint_t>(duk_get_length(heap, -1)));
  return 1;
}

duk_ret_t itemOf(duk_context* heap, void* data) {
  duk_get_prop_index(heap, -1, *static_cast<const duk_uarridx_t*>(data));
  return 1;
}

duk_ret_t traceOf(duk_context* heap, void* /*data*/) {
  duk_get_prop_string(heap, -1, "stack");
  duk_to_string(heap, -1);
  return 1;
}

// `step` with a copy of what lies on top of the stack; its value, or what it threw, is on top afterwards.
bool protectedStep(duk_context* heap, duk_safe_call_function step, void* data) {
  duk_dup_top(heap);
  return duk_safe_call(heap, step, data, 1, 1) == DUK_EXEC_SUCCESS;
}

// UTF-8 of what is a pair of surrogates in the engine, and else as the engine has it.
std::string joinedSurrogates(std::string_view text) {
  const auto half = [&](std::size_t at, unsigned char from,
                        unsigned char to) -> std::optional<std::uint32_t> {
    if (at + 3 > text.size() || static_cast<unsigned char>(text[at]) != 0xED) return std::nullopt;
    const auto second = static_cast<unsigned char>(text[at + 1]);
    if (second < from || second > to) return std::nullopt;
    return (second & 0x0FU) << 6 | (static_cast<unsigned char>(text[at + 2]) & 0x3FU);
  };
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const auto high = half(at, 0xA0, 0xAF);
    const auto low = high ? half(at + 3, 0xB0, 0xBF) : std::nullopt;
    if (!low) {
      out.push_back(text[at++]);
      continue;
    }
    const std::uint32_t c = 0x10000 + (*high << 10) + (*low & 0x3FF);
    for (const std::uint32_t byte :
         {0xF0 | c >> 18, 0x80 | (c >> 12 & 0x3F), 0x80 | (c >> 6 & 0x3F), 0x80 | (c & 0x3F)})
      out.push_back(static_cast<char>(byte));
    at += 6;
  }
  return out;
}

std::string shortened(std::string_view text) {
  std::string out = asUtf8(joinedSurrogates(text.substr(0, 4 * kMostMessage)));
  if (out.size() <= kMostMessage && text.size() <= 4 * kMostMessage) return out;
  std::size_t end = std::min(out.size(), kMostMessage);
  while (end > 0 && end < out.size() && (static_cast<unsigned char>(out[end]) & 0xC0) == 0x80)
    --end;
  return out.substr(0, end) + " ...";
}

} // namespace

Engine::Engine(std::size_t memory) : arena_(memory) {
  if (arena_.good()) heap_ = duk_create_heap(take, resize, give, &arena_, giveUp);
}

// What the heap has outside of the arena is nothing.
Engine::~Engine() = default;

// "    at surfaceX_write (surface-x.js:12) preventsyield": the first place in one of the sources.
void Engine::placeOf(EngineFault& fault, std::string_view trace) const {
  for (std::size_t at = 0; at < trace.size();) {
    const std::size_t end = std::min(trace.find('\n', at), trace.size());
    const std::string_view line = trace.substr(at, end - at);
    at = end + 1;
    if (line.find("    at ") != 0) continue;
    for (const std::string& name : names_) {
      const std::size_t found = line.rfind("(" + name + ":");
      if (found == std::string_view::npos) continue;
      const char* const digits = line.data() + found + name.size() + 2;
      std::from_chars(digits, line.data() + line.size(), fault.line);
      fault.source = name;
      return;
    }
  }
}

EngineFault Engine::thrown() {
  EngineFault out;
  const bool error = duk_is_error(heap_, -1) != 0;
  if (error) {
    protectedStep(heap_, traceOf, nullptr);
    duk_size_t size = 0;
    if (const char* trace = duk_get_lstring(heap_, -1, &size)) placeOf(out, {trace, size});
    duk_pop(heap_);
  }
  duk_size_t size = 0;
  const char* const text = duk_safe_to_lstring(heap_, -1, &size);
  out.text = shortened({text, size});
  duk_pop(heap_);
  if (!error) out.text = out.text.empty() ? "it throws an empty text" : "it throws `" + out.text + "`";
  if (out.text.empty()) out.text = "it throws an error without a text";
  const auto says = [&](std::string_view words) { return out.text.find(words) != std::string::npos; };
  if (arena_.ranOut() && (says("alloc failed") || says("DoubleError"))) out.kind = EngineFault::Kind::Memory;
  return out;
}

std::optional<EngineFault> Engine::load(const std::vector<std::string_view>& sources) {
  if (heap_ == nullptr)
    return EngineFault{arena_.good() ? EngineFault::Kind::Memory : EngineFault::Kind::NoRoom, "", "", 0};
  if (duk_safe_call(heap_, hideEngine, nullptr, 0, 1) != DUK_EXEC_SUCCESS) return thrown();
  duk_pop(heap_);
  for (std::size_t i = 0; i + 1 < sources.size(); i += 2) {
    Text source{sources[i], sources[i + 1]};
    names_.emplace_back(source.name);
    if (duk_safe_call(heap_, evaluate, &source, 0, 1) != DUK_EXEC_SUCCESS) return thrown();
    if (i != 0) duk_pop(heap_); // the first value stays
  }
  arena_.save();
  return std::nullopt;
}

std::optional<EngineFault> Engine::run(std::string_view argument, std::size_t most,
                                       std::vector<std::string>& texts) {
  arena_.restore();
  texts.clear();
  if (!protectedStep(heap_, callWith, &argument)) return thrown();
  if (!protectedStep(heap_, lengthOf, nullptr)) return thrown();
  const duk_uint_t count = duk_get_uint(heap_, -1);
  duk_pop(heap_);
  if (count > kMostTexts) return EngineFault{EngineFault::Kind::Output, "", "", 0};
  for (duk_uarridx_t i = 0; i < count; ++i) {
    if (!protectedStep(heap_, itemOf, &i)) return thrown();
    duk_size_t size = 0;
    const char* const text = duk_get_lstring(heap_, -1, &size);
    if (text == nullptr)
      return EngineFault{EngineFault::Kind::Thrown, "its value is no list of texts", "", 0};
    if (size > most) return EngineFault{EngineFault::Kind::Output, "", "", 0};
    most -= size;
    texts.push_back(joinedSurrogates({text, size}));
    duk_pop(heap_);
  }
  return std::nullopt;
}

} // namespace dotek::script
