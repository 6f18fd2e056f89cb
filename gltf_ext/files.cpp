#include "gltf_ext/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

namespace tutte {
namespace {

Failure ioFailure(const std::filesystem::path& path, const std::string& what) {
  return {FailureKind::kIo, path.string(), what};
}

std::string reason() { return std::strerror(errno); }

bool writeAll(int descriptor, const std::vector<uint8_t>& bytes) {
  size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t wrote = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return false;
    done += static_cast<size_t>(wrote);
  }
  return true;
}

/// Opens a new file beside `path`; `name` receives its name.
int openTemporary(const std::filesystem::path& path, std::string& name) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    name = path.string() + ".tmp" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
  return -1;
}

/// Writes `bytes` to a new file beside the file's final place and returns its name.
Outcome<std::filesystem::path> writeTemporary(const NewFile& file) {
  std::string name;
  const int descriptor = openTemporary(file.path, name);
  if (descriptor < 0) return ioFailure(file.path, "cannot create a file here: " + reason());
  const bool written = writeAll(descriptor, file.bytes) && ::fsync(descriptor) == 0;
  const std::string why = written ? "" : reason();
  const bool closed = ::close(descriptor) == 0;
  if (written && closed) return std::filesystem::path(name);
  ::unlink(name.c_str());
  return ioFailure(file.path, "cannot write: " + (written ? reason() : why));
}

void removeAll(const std::vector<std::filesystem::path>& paths) {
  for (const auto& path : paths) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
}

}  // namespace

Outcome<std::vector<uint8_t>> readFile(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return ioFailure(path, "there is no such file");
  if (!std::filesystem::is_regular_file(path, error)) return ioFailure(path, "this is not a regular file");
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  if (!stream) return ioFailure(path, "the file cannot be opened: check its permissions");
  const std::streamoff size = stream.tellg();
  if (size < 0) return ioFailure(path, "the file cannot be read");
  std::vector<uint8_t> bytes(static_cast<size_t>(size));
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), size);
  if (stream.gcount() != size) return ioFailure(path, "the file cannot be read to its end");
  return bytes;
}

Outcome<Done> writeFiles(const std::vector<NewFile>& files) {
  std::vector<std::filesystem::path> temporaries;
  for (const NewFile& file : files) {
    std::error_code ignored;
    if (file.path.has_parent_path()) std::filesystem::create_directories(file.path.parent_path(), ignored);
    auto temporary = writeTemporary(file);
    if (!temporary) {
      removeAll(temporaries);
      return temporary.error();
    }
    temporaries.push_back(*std::move(temporary));
  }
  for (size_t i = 0; i < files.size(); ++i) {
    std::error_code error;
    std::filesystem::rename(temporaries[i], files[i].path, error);
    if (!error) continue;
    removeAll(temporaries);
    return ioFailure(files[i].path, "cannot replace the file: " + error.message());
  }
  return Done{};
}

Outcome<Done> writeFile(const std::filesystem::path& path, const std::vector<uint8_t>& bytes) {
  return writeFiles({{path, bytes}});
}

}  // namespace tutte
