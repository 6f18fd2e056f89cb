#pragma once
// Files and commands for tests: a folder that vanishes, models to put there, and the built `tutte`.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace tutte {

/// A folder of its own for one test.
class Scratch {
 public:
  Scratch() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("tutte_" + std::string(test->test_suite_name()) + "_" + test->name() + "_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~Scratch() {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }

  size_t fileCount() const {
    size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++count;
    return count;
  }

 private:
  std::filesystem::path folder_;
};

inline std::string contentsOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Finished {
  int code = -1;
  std::string out, err;
};

/// Runs the built command (beside the tests' folder, or as TUTTE_COMMAND says) with these arguments, in shell syntax.
inline Finished runTutte(const Scratch& scratch, const std::string& arguments) {
  const char* named = std::getenv("TUTTE_COMMAND");
  const auto self = std::filesystem::read_symlink("/proc/self/exe");
  const std::string command = named ? named : (self.parent_path().parent_path() / "tools" / "tutte").string();
  const auto out = scratch / ".out", err = scratch / ".err";
  const int status =
      std::system(("'" + command + "' " + arguments + " >'" + out.string() + "' 2>'" + err.string() + "'").c_str());
  Finished finished{WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentsOf(out), contentsOf(err)};
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return finished;
}

/// The folder of real models, or an empty path where it is not.
inline std::filesystem::path corpusFolder() {
  const char* named = std::getenv("TUTTE_CORPUS");
  for (std::filesystem::path folder : {std::filesystem::path(named ? named : ""),
                                       std::filesystem::path(__FILE__).parent_path() / "../../../shared/corpus"}) {
    if (!folder.empty() && std::filesystem::is_directory(folder)) return folder;
  }
  return {};
}

}  // namespace tutte
