// Jobs of `run-post` (docs/fusion-kernel.md, "Jobs"): what Fusion hands to a post.
#pragma once

#include "project/Session.h"

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::posts {

struct JobOptions {
  std::vector<std::pair<std::string, std::string>> properties; // NAME=VALUE of the command line
  bool map = false;
  std::uint32_t most = 1u << 20; // bytes of text
};

struct PostJob {
  bool inch = false;
  std::string json; // what the kernel runs
};

// Of a file. nullopt: reported.
std::optional<PostJob> readPostJob(const std::string& path, const JobOptions& options,
                                   project::Session& session);
// One operation of `--matrix`.
struct MatrixJob {
  std::string name; // of its cycle, or of what its moves do
  std::string json;
  bool isCycle = true;
};
// All of a kind, "probing", "drilling" or "turning"; empty: there is no such kind.
std::vector<MatrixJob> matrixJobs(const std::string& kind, const JobOptions& options,
                                  const project::Session& session);
std::vector<std::string> matrixKinds(const project::Session& session);

// Cycles of holes, to which the engine adds what a job of the CAM leaves out.
std::set<std::string, std::less<>> holeCycles(const stdlib::DataFiles& data);

struct PostProperty;
// The beginning of a job file, with the properties of a post. `probes`: it begins with an operation of the
// CAM's own probing, which a post that knows none refuses.
std::string newPostJob(const std::string& post, const std::vector<PostProperty>& properties,
                       const std::vector<std::string>& capabilities, bool probes);
// Whether the text of a post names a probing cycle of the CAM, or asks for one, or leaves that to what it
// includes.
bool namesProbing(std::string_view text);

} // namespace dotek::posts
