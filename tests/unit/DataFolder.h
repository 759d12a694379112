// A folder for `--data` in tests, removed at the end.
#pragma once

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace dotek::tests {

class DataFolder {
public:
  DataFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("dotek-data-" + std::to_string(std::random_device()()))) {
    std::filesystem::create_directories(path_);
  }
  ~DataFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  DataFolder(const DataFolder&) = delete;
  DataFolder& operator=(const DataFolder&) = delete;

  std::string path() const { return path_.string(); }
  // Writes `name` ("forms/x.toml"); gives its path.
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }

private:
  std::filesystem::path path_;
};

} // namespace dotek::tests
