// A post of Fusion that runs: its text on the kernel of stdlib/fusion, in a process of its own
// (script/Script.h).
#pragma once

#include "frontend/fusion/Declared.h"
#include "posts/PostJob.h"
#include "project/Session.h"
#include "script/Script.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dotek::posts {

// Where a piece of text comes from: a line of the post, and the function there.
struct PostPlace {
  std::uint32_t line = 0;
  std::string function;
};
using PostStack = std::vector<PostPlace>; // innermost first

// What ended a run.
struct PostFault {
  enum class Kind : std::uint8_t {
    Refusal,       // the post calls error(..)
    Thrown,        // JavaScript
    Expand,        // it leaves a cycle to the engine, and nobody knows its moves
    Property,      // the job gives one that the post does not have
    PropertyValue, // or a value that it cannot have
    Output,        // more text than allowed
    Stopped,       // a limit, or the process ended
    NoWorker
  };
  Kind kind = Kind::Thrown;
  std::string text;
  std::string section;   // its number, from 1; "": outside of all
  std::string operation; // its comment
  std::string cycle;     // its type
  PostStack stack;
};

struct PostWarning {
  std::string text;
  PostStack stack;
};

// What a job says of the probe that its program runs with.
struct PostProbe {
  std::uint32_t tool = 0;
  double diameter = 0;                // mm
  std::vector<std::uint32_t> offsets; // work offsets of the job: 1 for G54
};

struct PostResult {
  std::string nc;                           // line ends LF; up to the fault where there is one
  std::vector<PostStack> lines;             // of each line of `nc`, where the job asks for it
  std::map<std::string, std::string> files; // what the post redirects, by name
  std::vector<PostWarning> warnings;
  std::vector<std::string> log;
  std::optional<PostProbe> probe;
  std::optional<PostFault> fault;
};

struct PostProperty {
  std::string name, value, title; // value: JSON
  std::string choices;            // ids, with blanks between
};

// One post in one unit. For one thread.
class PostRunner {
public:
  PostRunner(project::Session& session, script::Options options)
      : session_(session), options_(std::move(options)), runner_(options_) {}

  // Reads the post and what it includes, and evaluates its top level. false: reported.
  bool load(const std::string& path, bool inch);
  PostResult run(const std::string& job);
  std::vector<PostProperty> properties();
  // "milling", "turning", ..: what the head of the post names.
  std::vector<std::string> capabilities(); // of the post, in their order
  FileId file() const { return file_; }
  // The range of a line of the post; without a place where it has none.
  SourceRange lineRange(std::uint32_t line) const;
  // Reports what ended a run, and what the post warns of.
  void report(const PostResult& result);
  const script::Options& options() const { return options_; }

private:
  bool include(const std::string& path, std::map<std::string, std::string>& into, int depth);
  std::optional<std::string> lowered(FileId file);
  void nameFunctions(PostStack& stack) const;
  std::string setup(bool inch, const std::map<std::string, std::string>& includes) const;

  project::Session& session_;
  script::Options options_;
  script::Runner runner_;
  FileId file_ = kNoFile;
  std::vector<frontend::fusion::GivenFunction> functions_; // of that file, begin and end as lines
};

} // namespace dotek::posts
