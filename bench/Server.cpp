#include "bench/Server.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <spawn.h>
#include <string_view>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

extern char** environ;

namespace bench {
namespace {

// Of a file's text as JSON writes it; other bytes of examples are ASCII.
std::string jsonText(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";
    else if (c == '\r')
      out += "\\r";
    else if (c == '\t')
      out += "\\t";
    else
      out += c;
  }
  return out + "\"";
}

class Server {
public:
  explicit Server(const std::string& dotek) {
    std::array<int, 2> in{}, out{};
    if (pipe(in.data()) != 0 || pipe(out.data()) != 0) return;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY,
                                     0); // the end comes unasked
    for (const int end : {in[0], in[1], out[0], out[1]})
      posix_spawn_file_actions_addclose(&actions, end);
    std::string program = dotek, command = "lsp";
    std::array<char*, 3> arguments = {program.data(), command.data(), nullptr};
    if (posix_spawn(&child_, dotek.c_str(), &actions, nullptr, arguments.data(), environ) != 0) child_ = -1;
    posix_spawn_file_actions_destroy(&actions);
    close(in[0]);
    close(out[1]);
    to_ = in[1];
    from_ = out[0];
  }
  ~Server() {
    if (to_ >= 0) close(to_);
    if (from_ >= 0) close(from_);
    if (child_ > 0) waitpid(child_, nullptr, 0);
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  bool runs() const { return child_ > 0; }

  bool send(std::string_view method, std::string_view parameters, bool request = false) {
    const std::string text = fmt::format(R"({{"jsonrpc":"2.0",{}"method":"{}","params":{}}})",
                                         request ? R"("id":1,)" : "", method, parameters);
    const std::string frame = fmt::format("Content-Length: {}\r\n\r\n{}", text.size(), text);
    for (std::size_t sent = 0; sent < frame.size();) {
      const ssize_t some = write(to_, frame.data() + sent, frame.size() - sent);
      if (some <= 0) return false;
      sent += static_cast<std::size_t>(some);
    }
    return true;
  }

  // Reads messages up to one that holds both texts. false: the server ended.
  bool receive(std::string_view first, std::string_view second) {
    for (;;) {
      std::size_t head = 0;
      while ((head = read_.find("\r\n\r\n")) == std::string::npos)
        if (!readMore()) return false;
      const std::size_t at = read_.find("Content-Length: ");
      if (at == std::string::npos) return false;
      const std::size_t length = std::stoul(read_.substr(at + 16));
      while (read_.size() < head + 4 + length)
        if (!readMore()) return false;
      const std::string message = read_.substr(head + 4, length);
      read_.erase(0, head + 4 + length);
      if (message.find(first) != std::string::npos && message.find(second) != std::string::npos) return true;
    }
  }

private:
  bool readMore() {
    std::array<char, 65536> buffer;
    const ssize_t some = read(from_, buffer.data(), buffer.size());
    if (some > 0) read_.append(buffer.data(), static_cast<std::size_t>(some));
    return some > 0;
  }

  pid_t child_ = -1;
  int to_ = -1, from_ = -1;
  std::string read_;
};

} // namespace

Figures measureChanges(const std::string& dotek, const std::string& file, const std::string& language,
                       int runs) {
  Figures figures;
  figures.status = -1;
  std::signal(SIGPIPE, SIG_IGN);
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string uri = "file://" + std::filesystem::absolute(file).lexically_normal().generic_string();
  Server server(dotek);
  if (!server.runs() || text.empty()) return figures;
  const auto found = [&] { return server.receive("publishDiagnostics", jsonText(uri)); };
  if (!server.send("initialize", R"({"processId":null,"rootUri":null,"capabilities":{}})", true) ||
      !server.receive("\"id\":1", "result") || !server.send("initialized", "{}") ||
      !server.send("textDocument/didOpen",
                   fmt::format(R"({{"textDocument":{{"uri":{},"languageId":"{}","version":0,"text":{}}}}})",
                               jsonText(uri), language, jsonText(text))) ||
      !found())
    return figures;
  std::vector<double> times;
  for (int version = 0; version <= runs; ++version) {
    const auto begin = std::chrono::steady_clock::now();
    const bool answered =
        server.send(
            "textDocument/didChange",
            fmt::format(R"({{"textDocument":{{"uri":{},"version":{}}},"contentChanges":[{{"text":{}}}]}})",
                        jsonText(uri), version + 1, jsonText(text + std::string(version % 2, '\n')))) &&
        found();
    if (!answered) return figures;
    const auto end = std::chrono::steady_clock::now();
    if (version > 0) times.push_back(std::chrono::duration<double, std::milli>(end - begin).count());
  }
  std::sort(times.begin(), times.end());
  figures.median = times[times.size() / 2];
  figures.status = 0;
  return figures;
}

} // namespace bench
