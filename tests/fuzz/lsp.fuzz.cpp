// Any bytes as a conversation with the language server. The first byte chooses: messages as they are, each
// on its line; or a document, which is opened, edited at random places and asked about at each of them. What
// is found after the edits is what is found in the text at once.
#include "lsp/Server.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>

using namespace dotek;
using namespace dotek::lsp;

namespace {

constexpr std::array<const char*, 5> kNames = {"a.nc", "a.suf", "a.cycle", "a.cps", "CycleData.mac"};
constexpr std::array<const char*, 9> kQuestions = {
    "textDocument/hover",      "textDocument/definition",        "textDocument/references",
    "textDocument/completion", "textDocument/prepareRename",     "textDocument/documentSymbol",
    "textDocument/inlayHint",  "textDocument/documentHighlight", "textDocument/codeLens"};

class Client {
public:
  explicit Client(const std::string& uri) : uri_(uri) {
    ask("initialize", {{"capabilities", Json::object()}});
    tell("initialized", Json::object());
  }
  void open(const std::string& text) {
    tell("textDocument/didOpen",
         {{"textDocument", {{"uri", uri_}, {"languageId", "nc"}, {"version", 1}, {"text", text}}}});
  }
  void ask(const std::string& method, const Json& params) {
    const auto out = server_.receive(Json{{"id", 1}, {"method", method}, {"params", params}}.dump());
    if (out.size() != 1 || out[0].contains("result") == out[0].contains("error")) std::abort();
    if (out[0].contains("error") && out[0]["error"]["code"] == -32603) std::abort(); // a defect
    out[0].dump();
  }
  void tell(const std::string& method, const Json& params) {
    if (!server_.receive(Json{{"method", method}, {"params", params}}.dump()).empty()) std::abort();
  }
  std::string found() {
    std::string out;
    for (const Json& message : server_.idle())
      if (message["params"]["uri"] == uri_) out += message["params"]["diagnostics"].dump();
    return out;
  }
  Server& server() { return server_; }

private:
  Server server_{""};
  std::string uri_;
};

void document(std::uint8_t kind, std::string_view input) {
  const std::string uri = std::string("file:///none/such/") + kNames[kind % kNames.size()];
  Client client(uri);
  const std::size_t split = input.size() / 4;
  // A client's text is Unicode: a byte that is none becomes U+FFFD, as an editor shows it.
  std::string text =
      Json::parse(Json(input.substr(split)).dump(-1, ' ', false, Json::error_handler_t::replace));
  client.open(text);
  client.found();
  const auto place = [](unsigned line, unsigned column) {
    return Json{{"line", line % 16}, {"character", column % 32}};
  };
  for (std::size_t i = 0; i + 4 < split && i < 24; i += 4) {
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(input[i + at]); };
    const Json from = place(byte(0), byte(1)), to = place(byte(0) + byte(2) % 2, byte(1) + byte(2) % 5);
    const std::string word(byte(3) % 3, static_cast<char>(32 + byte(3) % 95));
    const auto begin = offsetOf(text, from, Units::Utf16), end = offsetOf(text, to, Units::Utf16);
    if (begin && end && *begin <= *end) {
      text.replace(*begin, *end - *begin, word);
      client.tell("textDocument/didChange",
                  {{"textDocument", {{"uri", uri}, {"version", i + 2}}},
                   {"contentChanges", {{{"range", {{"start", from}, {"end", to}}}, {"text", word}}}}});
    }
    const Json all = {{"start", place(0, 0)}, {"end", {{"line", 9999}, {"character", 0}}}};
    client.ask(kQuestions[byte(2) % kQuestions.size()], {{"textDocument", {{"uri", uri}}},
                                                         {"position", from},
                                                         {"range", all},
                                                         {"context", {{"includeDeclaration", true}}}});
  }
  const Json range = {{"start", place(0, 0)}, {"end", {{"line", 9999}, {"character", 0}}}};
  client.ask(
      "textDocument/codeAction",
      {{"textDocument", {{"uri", uri}}}, {"range", range}, {"context", {{"diagnostics", Json::array()}}}});
  client.ask("textDocument/formatting", {{"textDocument", {{"uri", uri}}}, {"options", Json::object()}});
  client.tell("textDocument/didSave", {{"textDocument", {{"uri", uri}}}});
  client.tell("textDocument/didChange",
              {{"textDocument", {{"uri", uri}, {"version", 99}}}, {"contentChanges", {{{"text", text}}}}});
  Client fresh(uri);
  fresh.open(text);
  if (client.found() != fresh.found()) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view input(reinterpret_cast<const char*>(data) + 1, size - 1);
  if ((data[0] & 1) != 0) {
    // A message of the protocol is UTF-8.
    if (isUtf8(input)) document(static_cast<std::uint8_t>(data[0] >> 1), input);
    return 0;
  }
  Server server("");
  for (std::size_t at = 0; at < input.size() && !server.ended();) {
    const std::size_t end = std::min(input.find('\n', at), input.size());
    for (const Json& answer : server.receive(input.substr(at, end - at)))
      answer.dump();
    at = end + 1;
  }
  for (const Json& message : server.idle())
    message.dump();
  return 0;
}
