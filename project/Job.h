// The job file: a whole program as a list of operations (docs/cli.md, "Job file").
#pragma once

#include "project/Session.h"
#include "stdlib/Setup.h"
#include "support/Source.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dotek::project {

struct JobValue {
  std::string name;
  double value = 0.0;
  SourceRange range; // of the name
};

struct JobOperation {
  std::string cycle; // name of a FOLDER of the command line
  SourceRange cycleRange;
  std::vector<std::pair<double, double>> at; // points of the operation, mm; empty: one run, no point
  std::map<std::string, double> hosts;       // retract and other host inputs of this operation
  std::vector<JobValue> set;
  SourceRange range;
};

struct Job {
  FileId file = kNoFile;
  std::optional<std::uint64_t> number; // O number
  SourceRange numberRange;
  std::optional<std::string> title;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> sequence; // start, step
  std::optional<std::string> startRoutine, operationRoutine, endRoutine;
  SourceRange startRange, operationRange, endRange;
  std::map<std::string, double> hosts; // [host] and [tool]
  bool lengthToCentre = false;         // `length_to` of [tool]
  std::vector<JobOperation> operations;
  stdlib::Setup setup; // what an operator sets: for sim
};

// nullopt where the file cannot be read or has an error: reported.
std::optional<Job> loadJob(const std::string& path, Session& session);

} // namespace dotek::project
