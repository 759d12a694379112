#include "project/CycleFiles.h"

#include "frontend/cycle/Check.h"
#include "frontend/cycle/Link.h"
#include "frontend/cycle/Parse.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>

namespace dotek::project {

namespace fs = std::filesystem;
namespace cycle = frontend::cycle;

namespace {

// `bore_3` is in bore-3.cycle.
std::string stemOf(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

std::string folderOf(const std::string& path) {
  return isStream(path) ? "." : fs::path(path).parent_path().generic_string();
}

} // namespace

cycle::File* CycleFiles::read(const std::string& path) {
  const auto [at, isNew] = byPath_.try_emplace(path, nullptr);
  if (!isNew) return at->second;
  const std::optional<FileId> id = session_.read(path, Encoding::Cp1250);
  if (!id) return nullptr;
  files_.push_back(cycle::parse(*id, session_.sources(), session_.limits(), session_.diagnostics()));
  at->second = &files_.back();
  return at->second;
}

cycle::File* CycleFiles::readLibrary(const std::string& name) {
  const auto [at, isNew] = byName_.try_emplace(name, nullptr);
  if (!isNew) return at->second;
  const stdlib::DataFile* data = session_.data().find("cycles", stemOf(name));
  if (data == nullptr) return nullptr;
  const std::string shown = data->builtIn() ? "library/" + data->name + ".cycle" : data->origin;
  const FileId id = session_.sources().add(SourceFile(shown, std::string(data->text), Encoding::Utf8));
  files_.push_back(cycle::parse(id, session_.sources(), session_.limits(), session_.diagnostics()));
  at->second = &files_.back();
  return at->second;
}

const cycle::File* CycleFiles::find(const std::optional<std::string>& folder, const std::string& name) {
  if (folder) {
    const std::string path = (fs::path(*folder) / (stemOf(name) + ".cycle")).generic_string();
    std::error_code error;
    if (fs::is_regular_file(path, error)) return link(read(path), folder);
  }
  return library(name);
}

const cycle::File* CycleFiles::link(cycle::File* file, const std::optional<std::string>& folder) {
  if (file != nullptr && linked_.insert(file).second)
    cycle::link(*file, [&](const std::string& name) { return find(folder, name); });
  return file;
}

const cycle::File* CycleFiles::load(const std::string& path) {
  return read(path);
}

const cycle::File* CycleFiles::linked(const std::string& path) {
  return link(read(path), folderOf(path));
}

const cycle::File* CycleFiles::library(const std::string& name) {
  return link(readLibrary(name), std::nullopt);
}

const cycle::File* CycleFiles::check(const std::string& path) {
  const cycle::File* file = linked(path);
  if (file != nullptr) cycle::check(*file, session_.sources(), session_.diagnostics());
  return file;
}

std::string cycleDraft(const std::string& name) {
  return fmt::format(R"(// What this cycle does, in one or two sentences. Where the probe is when it starts.
cycle {0} "Title as the operator reads it"

// What the caller gives. A parameter without a default must be given; `optional` ones may be left out.
parameter distance  : length               "From here to the surface in x"            require distance > 0 mm
parameter depth     : length = 5 mm        "Depth of the touch below the start"
parameter system    : work_offset optional "Work offset to set; absent: measure only"
parameter tolerance : length = 0.1 mm      "Largest deviation of the surface"

// What the caller gets.
result    position : length "Measured surface, active work offset"

spindle off
probe on
protected move by z -depth
touch x by distance -> surface
protected move to start
probe off

position = surface.at
if abs(surface.error) > tolerance then
  alarm "Surface out of tolerance"
end
if given system then
  // The surface gets the coordinate 0 in this work offset.
  set system: position becomes x 0 mm
end
)",
                     name);
}

} // namespace dotek::project
